"""The curve where the map jumps: its length by quadrature, and the map on both its sides."""

import math

import numpy as np
import pytest
from mpmath import mp, mpf

from extensions.claims.analyses.jumps import jumps
from extensions.claims.figures.jumps import MAP, draw
from helpers import independent_solver as judge
from helpers.legible import frames_of
from helpers.sections import BALL
from pseudorigid import Ball
from pseudorigid.dynamics.orbits import scene_orbits
from pseudorigid.figures.canvas import style

ENERGY = 0.01


def test_the_length_is_that_of_gaussian_quadrature():
    """The integrand is the curve's speed, from an independent map in 60 digits."""
    k, g = mpf("0.2"), mpf("0.04")
    centre = g / k
    radius = mp.sqrt(2 * mpf(repr(ENERGY)) / k + g * g / (k * k))
    high = mp.sqrt(k * (1 + k)) * radius
    end = mp.acos((centre + g) / radius)

    def curve(angle):
        x, y = centre - radius * mp.cos(angle), high * mp.sin(angle)
        after = judge.exact_map(k, g, x, y / (1 + k), -y / (1 + k))
        return after[0], after[1] - k * after[2]

    step = mpf(10) ** -20
    nodes, weights = np.polynomial.legendre.leggauss(120)
    length = mpf(0)
    for node, weight in zip(nodes, weights, strict=True):
        angle = end * mpf(float(node))
        (x0, y0), (x1, y1) = curve(angle - step), curve(angle + step)
        length += end * mpf(float(weight)) * mp.hypot(x1 - x0, y1 - y0) / (2 * step)
    data = jumps(BALL, ENERGY, [], 4000)
    assert float(data["length"].values[0]) == pytest.approx(float(length), abs=1e-12)
    assert 0.0 < float(data["length_error"].values[0]) < 1e-12


def test_the_map_jumps_across_the_curve():
    curve = jumps(BALL, ENERGY, [], 400).isel(energy=0)
    x, y = curve["x"].values, -curve["y"].values  # the mirror image, where the map jumps
    for i in (60, 200, 300):
        dx, dy = x[i + 1] - x[i - 1], y[i + 1] - y[i - 1]
        size = math.hypot(dx, dy)
        ends = []
        for side in (1e-9, -1e-9):
            state = BALL.state_xy(x[i] - side * dy / size, y[i] + side * dx / size, ENERGY)
            after = BALL.impact(*state)
            ends.append((after[0], after[1] - 0.2 * after[2]))
        rim = curve["rim_x"].values[i], -curve["rim_y"].values[i]
        beyond = x[400 - i], -y[400 - i]
        ends.sort(key=lambda end: math.dist(end, rim))
        assert math.dist(ends[0], rim) < 1e-3 and math.dist(ends[1], beyond) < 1e-3
        assert math.dist(*ends) > 0.01


def test_the_image_has_a_gap_where_the_map_jumps_across_the_arc():
    """Sides of a finer polygon are shorter, since the gap is none of them."""
    ball = Ball(1 / 3, 0.02)
    longest, lengths = [], []
    for sides in (400, 4000):
        data = jumps(ball, 0.01, [], sides)
        x, y = data["x"].values[0], data["y"].values[0]
        assert np.isnan(x).sum() == 1
        longest.append(np.nanmax(np.hypot(np.diff(x), np.diff(y))))
        lengths.append(float(data["length"].values[0]))
    assert longest[1] < 0.5 * longest[0]
    assert lengths[0] == pytest.approx(lengths[1], rel=0.03)  # the chord is 0.33 long
    assert lengths[1] < 0.8


def test_no_curve_below_the_first_energy():
    data = jumps(BALL, 0.00175, [0.00177], 100)
    assert float(data["length"].values[0]) == 0.0 and 0.0 < float(data["length"].values[1]) < 0.02
    assert data.attrs["first_energy"] == pytest.approx(0.00176, rel=1e-12)


def test_symmetric_flights_are_symmetric():
    data = jumps(BALL, ENERGY, [], 400)
    x, y = data["flight_x"].values.ravel(), data["flight_y"].values.ravel()
    x, y = x[~np.isnan(x)], y[~np.isnan(x)]
    assert x.size > 200
    # Fix RP: reflecting the next impact gives the state back
    back = BALL.reflect(*BALL.impact(*BALL.state_xy(x, y, ENERGY))[:3])
    np.testing.assert_allclose(back[0], x, atol=1e-9)
    np.testing.assert_allclose(back[1] - 0.2 * back[2], y, atol=1e-9)


@pytest.mark.parametrize(("k", "g", "energy"), [(1 / 3, 0.02, 0.132), (0.1, 0.01, 0.036)])
@pytest.mark.parametrize("sides", [4, 16])
def test_a_side_across_a_jump_is_no_part_of_a_curve_whatever_the_number_of_sides(
    k, g, energy, sides
):
    few, many = (jumps(Ball(k, g), energy, [], n) for n in (sides, 200 * sides))
    broken = np.isnan(many["x"].values[0, 1:]).reshape(sides, -1).any(axis=1)
    x = few["x"].values[0]
    drawn = np.isfinite(x[1:]) & np.isfinite(x[:-1])
    assert broken.any() and not (broken & drawn).any()


@pytest.mark.parametrize("sides", [4, 4000])
def test_the_symmetry_line_is_whole(sides):
    """Its two branches meet, and both ends of it are those of the whole line."""
    orbits = scene_orbits(BALL, ENERGY, [0.1], 50)
    scene = {"ball": {"k": 0.2, "g": 0.04}, "energy": ENERGY}
    data = jumps(BALL, ENERGY, [], sides).assign_attrs(k=0.2, g=0.04)
    lines = [a for a in draw(scene, data, orbits).artists if a.get_ls() == "--"]
    lines = [a.get_xydata() * style.DPI for a in lines if np.ptp(a.get_ydata()) > 0.0]
    assert sum(map(len, lines)) > 30
    ends = np.concatenate([line[[0, -1]] for line in lines])
    apart = np.abs(ends[:, None] - ends).max(axis=2)
    free = ends[np.sum(apart < 1.0, axis=1) == 1]
    assert len(free) == 2


def test_panels_of_further_energies_follow_one_another_with_falling_energy():
    orbits = scene_orbits(BALL, ENERGY, [0.1], 50)
    scene = {"ball": {"k": 0.2, "g": 0.04}, "energy": ENERGY}
    further = [0.004, 0.001, 0.009, 0.0018, 0.003]  # at 0.001 there is no curve
    data = jumps(BALL, ENERGY, further, 40).assign_attrs(k=0.2, g=0.04)
    figure = draw(scene, data, orbits)
    for frame in frames_of(figure)[1:]:  # a curve along the rim is told from it
        spans = [np.ptp(a.get_ydata()) for a in figure.artists if a.get_color() == MAP
                 and frame.contains(*a.get_xydata()[-1] * style.DPI)]  # fmt: skip
        assert spans and max(spans) * style.DPI > 0.7 * frame.height
    found = [text for text in figure.texts if text.get_text().startswith("$E$")]
    found = sorted(
        (text.get_position()[0], text.get_text()) for text in found if text.get_position()[1] < 2
    )
    assert [text for _, text in found] == [f"$E$ = {energy}" for energy in (0.004, 0.003, 0.0018)]
