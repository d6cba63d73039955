"""The theorems: proved as they stand, and by digits that others find too."""

import re
import time
from pathlib import Path

import mpmath
import numpy as np
import pytest
from certificates import numbers
from flint import arb, ctx
from independent_solver import exact_map

from pseudorigid import Ball, symmetric_orbits
from pseudorigid.proofs import THEOREMS, search_certificate
from pseudorigid.proofs.checks import jump

BALL = Ball(k=0.2, g=0.04)
ORBITS = [n for n in THEOREMS if re.match("fixed-|six-|ten-|twelve-", n)]
HORSESHOES = ["horseshoe-outer", "horseshoe-inner"]


@pytest.fixture(scope="module")
def results():
    return {name: theorem.check() for name, theorem in THEOREMS.items()}


def test_every_theorem_is_proved_in_time(results):
    assert [r.line() for r in results.values() if r.verdict != "proved"] == []
    assert sum(r.seconds for r in results.values()) < 30
    assert all(min(r.margins.values()) > 0 for r in results.values())


def test_a_result_is_one_line_that_ends_in_its_verdict(results):
    for name, result in results.items():
        line = result.line()
        assert "\n" not in line
        assert line.startswith(f"{name}.toml: ")
        assert line.endswith(" s; proved")
    refused = THEOREMS["fixed-point"].check("nonsense")
    assert re.search(r"s; the certificate cannot be read: .*; not proved$", refused.line())


@pytest.mark.parametrize("name", THEOREMS)
def test_a_new_search_gives_a_certificate_that_holds(name):
    text = search_certificate(name)
    assert THEOREMS[name].check(text).verdict == "proved"


@pytest.mark.parametrize("name", HORSESHOES)
def test_the_search_is_reproducible(name):
    assert search_certificate(name) == THEOREMS[name].text()


# ---- digits against other methods


@pytest.mark.parametrize("name", ORBITS)
def test_orbits_close_in_an_independent_map_of_60_digits(name, results):
    surface = THEOREMS[name].bounds["surface"]
    digits = results[name].digits
    with mpmath.workdps(60):
        k, g, _ = (mpmath.mpf(a.numerator) / a.denominator for a in
                   (surface.k, surface.g, surface.energy))  # fmt: skip
        first = [mpmath.mpf(digits[n].strip("[").split()[0]) for n in ("x", "xdot", "udot")]

        def around(state):
            total = mpmath.mpf(0)
            for _ in range(THEOREMS[name].bounds["period"]):
                *state, tau = exact_map(k, g, *state)
                total += tau
            return state, total

        after, total = around(first)
        assert max(abs(a - b) for a, b in zip(after, first, strict=True)) < mpmath.mpf("1e-27")
        assert abs(total - mpmath.mpf(digits["period"].strip("[").split()[0])) < mpmath.mpf("1e-26")
        energy = first[1] ** 2 / 2 + k * first[2] ** 2 / 2 - g * first[0] + k * first[0] ** 2 / 2
        exact = mpmath.mpf(surface.energy.numerator) / surface.energy.denominator
        assert abs(energy - exact) < mpmath.mpf("1e-29")


@pytest.mark.parametrize("name", ORBITS)
def test_traces_by_differences_of_60_digits(name, results):
    theorem = THEOREMS[name]
    surface = theorem.bounds["surface"]
    x, y = numbers(theorem.text(), "points")[0]
    h = arb(2) ** -100
    with ctx.workprec(400):

        def around(a, b):
            for _ in range(theorem.bounds["period"]):
                image = surface.impact(a, b)
                a, b = image.x, image.y
            return a, b

        x, y = arb(x), arb(y)
        trace = (around(x + h, y)[0] - around(x - h, y)[0]
                 + around(x, y + h)[1] - around(x, y - h)[1]) / (2 * h)  # fmt: skip
        stated = arb(results[name].digits["trace"].strip("[").split()[0])
        assert abs(trace - stated) < arb("1e-26")


def test_the_paper_s_numbers(results):
    six = results["six-hyperbolic"].digits
    assert 0.21 < float(six["x"][1:].split()[0]) < 0.2116
    assert 0.0925 < float(six["xdot"][1:].split()[0]) < 0.0932


def rotation(surface_energy, x, impacts=40_000):
    """Rotation number (of a turn an impact) about the fixed point of the orbit from (x, 0)."""
    state = [np.array([a]) for a in BALL.state_xy(x, 0.0, surface_energy)]
    out = np.empty((1, impacts, 4))
    BALL.map.history(*state, BALL.k, BALL.g, out)
    return out[0, :, 0], out[0, :, 1] - BALL.k * out[0, :, 2]


def frequency(energy, fixed, frame, q):
    """(action, angle an impact) of the orbit at q along the first axis of the normal frame."""
    beta, delta = frame
    x, y = rotation(energy, fixed + beta * q)
    first, second = (x - fixed) / beta, beta * (y - delta * (x - fixed) / beta)
    angle = np.unwrap(np.arctan2(second, first))
    share = np.linspace(0.0, 1.0, angle.size + 1)[1:-1]
    weight = np.exp(-1.0 / (share * (1.0 - share)))  # smooth, so that the mean converges fast
    return np.mean(first**2 + second**2) / 2, np.sum(np.diff(angle) * weight) / weight.sum()


@pytest.mark.parametrize(("name", "energy"), [("twist-fixed-point", 0.01),
                                              ("twist-fixed-point-low", 0.001)])  # fmt: skip
def test_the_twist_is_that_of_measured_rotation_numbers(name, energy, results):
    """How the angle of rotation grows with the enclosed area, along double-precision orbits."""
    orbit = "fixed-point" if energy == 0.01 else "fixed-point-low"
    fixed = float(results[orbit].digits["x"][1:].split()[0])
    state = BALL.state_xy(fixed, 0.0, energy)
    (a, b), (_, d) = BALL.chart_jacobian(*state)
    sine = np.copysign(np.sqrt(1 - ((a + d) / 2) ** 2), b)
    beta = np.sqrt(b / sine)
    frame = beta, beta * ((a + d) / 2 - a) / b
    actions, angles = zip(*(frequency(energy, fixed, frame, q) for q in (0.002, 0.006)),
                          strict=True)  # fmt: skip
    turn = np.arccos((a + d) / 2)
    assert angles[0] == pytest.approx(-turn, rel=1e-3)  # clockwise: the rotation number falls
    slope = (angles[1] - angles[0]) / (actions[1] - actions[0])
    stated = float(results[name].digits["twist"][1:].split()[0])
    assert slope == pytest.approx(stated, rel=0.02)


def test_the_rotation_number_has_a_minimum_below_the_zero_of_the_twist():
    """In turns, as a positive number, along y = 0 from the fixed point at E = 0.026."""
    found = symmetric_orbits(BALL, 0.026, 1).isel(orbit=0)
    fixed = found["x"].values[0]
    turns = [-frequency(0.026, fixed, (1.0, 0.0), q)[1] / (2 * np.pi) for q in (0.04, 0.09, 0.13)]
    assert turns[1] == pytest.approx(0.226881, abs=1e-6)
    assert turns[1] < min(turns[0], turns[2]) - 5e-5


def test_one_sided_images_are_those_of_nearby_orbits(results):
    digits = {n: float(v[1:].split()[0]) for n, v in results["jump-set"].digits.items()}
    seen = set()
    for angle in np.linspace(0, 2 * np.pi, 16, endpoint=False):
        x = digits["point x"] + 1e-9 * np.cos(angle)
        y = digits["point y"] + 1e-9 * np.sin(angle)
        after = BALL.impact(*BALL.state_xy(x, y, 0.01))
        place = after[0], after[1] - BALL.k * after[2]
        for side in ("near", "far"):
            image = digits[f"{side} image x"], digits[f"{side} image y"]
            if np.hypot(place[0] - image[0], place[1] - image[1]) < 1e-3:
                seen.add(side)
                break
        else:
            pytest.fail(f"{place} is neither image")
    assert seen == {"near", "far"}


def test_the_jump_set_s_polygon_lies_where_flights_just_touch():
    surface = THEOREMS["jump-set"].bounds["surface"]
    with ctx.workprec(jump.BITS):
        for x, y in jump.curve(surface, 12)[1:-1]:
            sides = set()
            for dx, dy in 1e-7 * np.array([(1, 0), (-1, 0), (0, 1), (0, -1)]):
                after = BALL.impact(*BALL.state_xy(float(x) + dx, float(y) + dy, 0.01))
                sides.add(bool(after[1] + after[2] < 0.02))
            assert sides == {True, False}


def test_the_length_of_the_jump_set_is_one_lower_bound_everywhere(results):
    theorem = THEOREMS["jump-set"]
    bound = f"{float(theorem.bounds['length']):g}"
    assert "length" not in results["jump-set"].digits
    root = Path(__file__).resolve().parents[2]
    for text in (
        theorem.statement,
        *((root / n).read_text() for n in ("README.md", "docs/proofs.md")),
    ):
        assert f"longer than {bound}" in text
    with ctx.workprec(jump.BITS):
        few, many = (jump._polygon(theorem.bounds["surface"], count) for count in (400, 1600))
        assert arb(bound) < few < many < arb("0.404858179457")  # computed: CLAIMS.md


def test_coverings_hold_for_points_in_doubles():
    """Corners and edges of the outer horseshoe's sets, mapped in double precision."""
    theorem = THEOREMS["horseshoe-outer"]
    edge = np.linspace(-1, 1, 21)
    for source, target in theorem.prove(theorem.text()).parts["edges"]:
        ends = []
        for p in (-1.0, 1.0):
            x, y = (
                float(source.centre[i]) + p * float(source.u[i]) + edge * float(source.s[i])
                for i in (0, 1)
            )
            image = BALL.impact(*BALL.state_xy(x, y, 0.01))
            dx = image[0] - float(target.centre[0])
            dy = image[1] - BALL.k * image[2] - float(target.centre[1])
            (ux, uy), (sx, sy) = ([float(a) for a in side] for side in (target.u, target.s))
            area = ux * sy - uy * sx
            assert np.abs((ux * dy - uy * dx) / area).max() < 1
            ends.append((dx * sy - dy * sx) / area)
        assert np.abs(np.concatenate(ends)).min() > 1
        assert np.all(np.sign(ends[0]) == -np.sign(ends[1]))


def test_the_entropy_solves_its_equation(results):
    for name in HORSESHOES:
        loop = THEOREMS[name].prove(THEOREMS[name].text()).parts["loop"]
        entropy = float(results[name].digits["entropy"][1:].split()[0])
        assert np.exp(-6 * entropy) + np.exp(-loop * entropy) == pytest.approx(1, abs=1e-12)
    assert float(results["horseshoe-outer"].digits["entropy"][1:].split()[0]) > 0.0146
    assert float(results["horseshoe-inner"].digits["entropy"][1:].split()[0]) > 0.0071


def test_the_time_is_that_of_the_check():
    begin = time.perf_counter()
    result = THEOREMS["six-elliptic"].check()
    assert 0 < result.seconds <= time.perf_counter() - begin


@pytest.mark.parametrize("name", ["twist-six", "twist-ten", "twist-twelve"])
def test_the_twist_of_the_search_is_found_another_way(name):
    """The closed formula and the normal form: two derivations, one number."""
    from pseudorigid.proofs.search import approximate_orbits
    from pseudorigid.proofs.search import twist as formula
    from pseudorigid.proofs.search.periodic import polished

    theorem = THEOREMS[name]
    found = theorem.prove(theorem.text()).digits["twist"]
    surface = theorem.bounds["surface"]
    with ctx.workprec(160):
        points = polished(
            surface, approximate_orbits.points(surface, theorem.bounds["period"], "elliptic")
        )
        assert abs(formula.estimate(surface, points) - found) < arb("1e-25")
