"""Orbits of exact starts: against independent orbits of many digits, and refusals."""

from fractions import Fraction

import mpmath
import numpy as np
import pytest
from flint import arb, arb_mat, ctx

from extensions.proofs import Surface, true_orbit
from extensions.proofs.enclosure.surface import ball_of
from extensions.proofs.true_orbits import enclosed_run
from extensions.proofs.true_orbits import orbit as orbit_module
from extensions.proofs.true_orbits.enclosed_run import Run, ShortOfBitsError, Start
from extensions.proofs.true_orbits.orbit import true_scene_orbits
from helpers.exact_orbits import state_at
from helpers.independent_solver import flight
from helpers.sections import BALL
from pseudorigid.dynamics.orbits import scene_orbits

PAPER = {"k": "1/5", "g": "1/25", "energy": "1/100"}
NAMES = ("x", "xdot", "udot", "tau")


def independent(impacts, digits):
    """The orbit of (2/5, 0) as rows of x, xdot, udot, tau, from `digits` decimal digits down to 60.

    The kernel says which root it is, and Newton's method gives its digits.
    """
    rows = []
    with mpmath.workdps(digits):
        k, g, energy, x = (mpmath.mpf(a) / b for a, b in ((1, 5), (1, 25), (1, 100), (2, 5)))
        state = state_at(k, g, energy, x, 0)
    for i in range(impacts):
        level = digits - (digits - 60) * i // impacts
        with mpmath.workdps(level):
            gap, b, c = flight(k, g, *state)
            t, known = mpmath.mpf(BALL.time_to_impact(*map(float, state))), 12
            while known < level:
                known *= 2
                with mpmath.workdps(min(known, level) + 10):
                    t -= gap(t) / gap.slope(t)
            cosine, sine = mpmath.cos_sin(t)
            state = gap.x * cosine - c * sine, b + g * t, gap.x * sine + c * cosine
            rows.append((*state, t))
    return rows


@pytest.mark.parametrize(
    ("impacts", "digits"), [(600, 130), pytest.param(2000, 450, marks=pytest.mark.slow)]
)
def test_each_value_is_the_nearest_double(impacts, digits):
    data = true_orbit(**PAPER, x="2/5", y="0", impacts=impacts)
    expected = np.array([[float(a) for a in row] for row in independent(impacts, digits)])
    for name, column in zip(NAMES, expected.T, strict=True):
        np.testing.assert_array_equal(data[name].values, column)


@pytest.mark.parametrize("bits", [3000, 100])
def test_a_run_with_more_or_too_few_bits_gives_the_same_orbit(bits, monkeypatch):
    data = true_orbit(**PAPER, x="2/5", impacts=300)
    monkeypatch.setattr(orbit_module, "_bits_needed", lambda *_: bits)
    other = true_orbit(**PAPER, x="2/5", impacts=300)
    assert other.attrs["bits"] == bits if bits == 3000 else other.attrs["bits"] > 150
    assert data.equals(other)


@pytest.mark.parametrize(("starts", "impacts"), [
    ([0.534522, -0.440981], [40, 25]),
    ([{"x": 0.1, "xdot": 0.05}, {"x": 0.3, "y": -0.02}, 0.5], 25),
])  # fmt: skip
def test_starts_of_a_scene_may_be_fractions_of_the_radius_or_points(starts, impacts):
    data = true_scene_orbits(BALL, 0.01, starts, impacts)
    doubles = scene_orbits(BALL, 0.01, starts, impacts)
    assert data.sizes == doubles.sizes and set(data.variables) == set(doubles.variables)
    for name in data.variables:
        assert data[name].attrs == doubles[name].attrs
        if name == "type":
            assert data[name].equals(doubles[name])
        else:
            assert np.nanmax(np.abs(data[name] - doubles[name])) < 1e-7


# ---- bad input


@pytest.mark.parametrize(("match", "change"), [
    ("k = 0.2", {"k": 0.2}), ("impacts = 2.5", {"impacts": 2.5}),
    ("x and y, or start", {"x": None}), ("x and y, or start", {"start": "0.5"}),
    ("fraction", {"x": None, "start": {"x": "0.1", "z": "0"}}),
    ("x = 3/5, y = 0 is not inside", {"x": "3/5"}),
    ("is not inside", {"energy": "0", "x": "2/5"}),  # exactly on the rim: 2 g x = k x^2
    ("[0-9]+ GB", {"impacts": 10**12}),
])  # fmt: skip
def test_bad_input_is_refused_in_one_line(match, change):
    with pytest.raises((ValueError, MemoryError), match=match) as error:
        true_orbit(**{**PAPER, "x": "2/5", "impacts": 10} | change)
    assert "\n" not in str(error.value)


def test_a_start_that_grazes_is_refused(monkeypatch):
    # a point of the jump set to 28 digits: 64 bits cannot tell its touch from a miss
    monkeypatch.setattr(orbit_module, "_bits_needed", lambda *_: 90)
    x, y = "0.1500343560691206835267020387", "-0.1446215630131739871189398710"
    with pytest.raises(ValueError, match=r"impact 0: .* touch"):
        true_orbit(**PAPER, x=x, y=y, impacts=10)


# ---- the bound on the error


def test_the_true_point_stays_in_the_set_of_a_run():
    """z + C e, |e_i| <= r_i: from exact starts too, and where roundings of z dominate."""
    surface = Surface(**PAPER)
    for start, bits in (({"x": "1/4", "y": "0"}, 130), ({"x": "2/5", "y": "1/100"}, 300)):
        run, true = (Run(Start(surface, start), 40, n) for n in (bits, 2000))
        for _ in range(40):
            try:
                run.step()
            except ShortOfBitsError:
                break
            true.step()
            with ctx.workprec(2000):
                off = [(a - b) for a, b in zip(true.centre, run.centre, strict=True)]
                sides = run.frame.inv() * arb_mat([[a] for a in off])
                for side, radius in zip((sides[0, 0], sides[1, 0]), run.radii, strict=True):
                    assert abs(side) <= radius + arb(2) ** -1500
                for z, ball in zip(true.centre, run._box(bits), strict=True):
                    assert ball.contains(z)
        assert run.count > 10 and 0 < max(run.radii) < arb(2) ** -70


@pytest.mark.parametrize("side", [0, 1])
def test_a_start_at_the_edge_of_a_set_stays_in_it(side):
    """The set is a segment along x or along y at first."""
    surface, width = Surface(**PAPER), Fraction(1, 2**120)
    at = [Fraction(1, 4), Fraction(1, 64)]
    run = Run(Start(surface, dict(zip("xy", at, strict=True))), 5, 300)
    run.radii[side] = ball_of(width)
    at[side] += width
    edge = Run(Start(surface, dict(zip("xy", at, strict=True))), 5, 300)
    for _ in range(3):
        run.step()
        edge.step()
        with ctx.workprec(300):
            off = [[a - b] for a, b in zip(edge.centre, run.centre, strict=True)]
            sides = run.frame.inv() * arb_mat(off)
            assert all(abs(sides[i, 0]) <= run.radii[i] for i in (0, 1))


def test_a_frame_is_orthogonal_along_the_longer_column():
    columns = arb_mat([[3, 1], [4, 2]])
    for radii, direction in (((1, 1), (3, 4)), ((0.01, 1), (1, 2))):
        frame, inverse = enclosed_run._orthogonal_frame(columns, list(map(arb, radii)))
        a, b = frame[0, 0], frame[1, 0]
        assert abs(a * direction[1] - b * direction[0]) < 1e-14
        assert (frame[0, 1], frame[1, 1]) == (-b, a) and abs(a * a + b * b - 1) < 1e-14
        unit = frame * inverse
        assert all(unit[i, j].contains(int(i == j)) for i in (0, 1) for j in (0, 1))


@pytest.mark.parametrize(("row", "radii", "bound"), [
    ((1, -2), (3, 4), 11), ((-1, 2), (-3, 4), 11), ((0, 1), (5, 0.5), 0.5), ((1, 1), (0, 0), 0),
])  # fmt: skip
def test_a_bound_takes_each_side_at_its_worst(row, radii, bound):
    assert enclosed_run._bound(list(map(arb, row)), list(map(arb, radii))) == bound


TINY = Fraction(1, 2**1080)


@pytest.mark.parametrize(("value", "width", "nearest"), [
    (Fraction(1, 10), 0, 0.1), (1, Fraction(1, 2**60), 1.0), (-3, 0, -3.0),
    (0, Fraction(1, 2**90), 0.0), (Fraction(1, 2**91), Fraction(1, 2**90), 0.0),
    (1 + Fraction(1, 2**53) + TINY, 0, 1 + 2.0**-52), (1 + Fraction(1, 2**53) - TINY, 0, 1.0),
    (1 + Fraction(1, 2**53), TINY, None), (0, Fraction(1, 2**70), None),
    (1, Fraction(1, 2**50), None), (Fraction(1, 2**100), Fraction(1, 2**140), None),
])  # fmt: skip
def test_a_value_is_rounded_only_if_the_whole_ball_is(value, width, nearest):
    """The midpoint between two doubles is not decided, nor a small number away from zero."""
    with ctx.workprec(2000):
        ball = ball_of(Fraction(value)) + arb(0, 1) * ball_of(Fraction(width))
        if nearest is None:
            with pytest.raises(ShortOfBitsError):
                enclosed_run._nearest(ball)
        else:
            assert enclosed_run._nearest(ball) == nearest


@pytest.mark.parametrize(("start", "inside"), [
    ("0.999", True), ("-0.999", True), ("1", False), ("-1", False), ("2", False),
    ({"x": "0.1", "y": "0.17"}, True), ({"x": "0.1", "y": "-0.18"}, False),
    ({"x": "0.6", "y": "0"}, False), ({"x": "0.2", "y": "-0.2"}, False),
    ({"x": "0.1", "xdot": "0.1"}, True), ({"x": "0.1", "xdot": "-0.1"}, True),
    ({"x": "0.1", "xdot": "-0.155"}, False), ({"x": "0.1", "xdot": "0.155"}, True),
    ({"x": "0.1", "xdot": "0.17"}, False), ({"x": "0.1", "xdot": "-0.17"}, False),
])  # fmt: skip
def test_a_start_is_inside_the_rim_exactly_where_the_contact_speed_is_positive(start, inside):
    surface = Surface(**PAPER)
    if not inside:
        with pytest.raises(ValueError, match="is not inside the section's rim"):
            Start(surface, start)
        return
    x, y = Start(surface, start).balls()
    v, w = surface.velocities(x, y)
    assert v + w > 0
    if isinstance(start, str):
        centre, size = BALL.section(0.01)
        assert (float(x), float(y)) == (pytest.approx(centre + float(start) * size), 0)
    else:
        assert x.overlaps(arb(start["x"]))
        which, value = [*start.items()][1]
        assert {"y": y, "xdot": v}[which].overlaps(arb(value))


def test_a_run_that_needs_too_many_bits_is_refused():
    with pytest.raises(ValueError, match="3 impacts of this orbit need 1000001 bits"):
        Run(Start(Surface(**PAPER), "0.5"), 3, enclosed_run.MOST_BITS + 1)
