"""Colours of the pictures, as readers with each colour vision see them, and names of curves."""

import numpy as np
import pytest

from helpers.colours import APART, SHADES, VISIONS, distance, lightness
from helpers.keys import texts
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.names import name_curves
from pseudorigid.figures.canvas.sheet import Sheet

FRAME = 0, 0, 900, 900


def test_the_scale_goes_from_dark_to_light_apart_from_the_sea_for_every_vision():
    hues = style.ordered(256)
    assert len(hues) == 256 and style.ordered(2) == [hues[0], hues[-1]]
    assert style.ordered(1) == hues[:1] and style.ordered(0) == []
    assert all(np.diff([lightness(hue) for hue in hues]) >= 0.0)
    for grey in (style.SEA, style.BACKDROP):
        assert min(distance(hue, grey, vision) for hue in hues for vision in VISIONS) > APART
    steps = np.diff([lightness(hue) for hue in style.ordered(5)])
    assert steps.min() > SHADES


def circle(radius, middle=450):
    angle = np.linspace(0.0, 2.0 * np.pi, 2000)
    return middle + radius * np.array([np.cos(angle), np.sin(angle)])


def test_a_name_stands_nearest_to_its_own_curve():
    curves = [circle(radius) for radius in (20, 120, 220, 320)]
    sheet = Sheet(900, 900)
    name_curves(sheet, curves, list("1234"), style.ordered(4), FRAME, 10.0)
    assert sorted(texts(sheet.figure)) == list("1234")
    for text in sheet.figure.texts:
        at = np.array([text.get_position()]).T * style.DPI
        near = [np.abs(curve - at).max(axis=0).min() for curve in curves]
        assert np.argmin(near) == int(text.get_text()) - 1
        assert text.get_color() == style.ink(style.ordered(4)[int(text.get_text()) - 1])
    assert sum(np.abs(line.get_linewidth()) > 5 for line in sheet.figure.artists) == 4  # white


def test_a_name_without_room_is_left_out_and_a_small_curve_stays_whole():
    crowd = [circle(radius) for radius in range(100, 200, 12)]
    sheet = Sheet(900, 900)
    name_curves(sheet, crowd, ["10"] * len(crowd), style.ordered(len(crowd)), FRAME, 10.0)
    assert len(sheet.figure.texts) < len(crowd)
    islet = circle(12)
    sheet = Sheet(900, 900)
    name_curves(sheet, [islet, np.empty((2, 0))], ["1", "2"], style.ordered(2), FRAME, 10.0)
    (text,) = sheet.figure.texts
    at = np.array([text.get_position()]).T * style.DPI
    assert np.abs(islet - at).max(axis=0).min() > 10


@pytest.mark.parametrize("seed", range(8))
def test_names_of_nested_islands_are_at_the_same_island(seed):
    random, flat = np.random.default_rng(seed), circle(1.0, 0) * [[1.0], [0.3]]
    grid = 150 + 300 * np.array([[i, j] for i in range(3) for j in range(3)])
    middles = random.permutation(grid)[:5] + random.uniform(-50, 50, (5, 2))
    radii = random.uniform(15, 25, 5)  # of flat islands, beside which a name fits
    outer, inner = (
        np.hstack([part * r * flat + at[:, None] for r, at in zip(radii, middles, strict=True)])
        for part in (1.0, 0.7)
    )
    sheet = Sheet(900, 900)
    curves = [outer, inner, circle(430)]
    name_curves(sheet, curves, list("12"), style.ordered(2), FRAME, 10.0)
    at = [np.array(text.get_position()) * style.DPI for text in sheet.figure.texts]
    islands = {int(np.argmin(np.abs(middles - place).max(axis=1))) for place in at}
    assert len(at) == 2 and len(islands) == 1
