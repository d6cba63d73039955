"""Text in pictures is not clipped, does not cover other text, and is large enough to read."""

import pytest

from helpers.legible import assert_legible
from helpers.samples import DATA, KINDS, SCENES, VIEW, drawn, module
from helpers.slowly import slowly
from pseudorigid import Ball
from pseudorigid.dynamics.orbits import scene_orbits
from pseudorigid.figures.canvas import style


@pytest.mark.parametrize("kind", KINDS)
def test_text_is_whole_apart_and_legible_at_a_columns_width(kind):
    figure = drawn(kind)
    assert_legible(figure)
    shrink = min(1, style.COLUMN / figure.bbox.width)
    assert min(text.get_size() for text in figure.texts) * shrink >= 7


def with_scaled_lengths(data, scale):
    """Return the data in another unit of length; times and exponents stay."""
    names = {"x", "xdot", "udot", "position", "strain", "impact_position"} & set(data.variables)
    attributes = {name: scale * data.attrs[name] for name in data.attrs if name.startswith("point")}
    attributes |= {"g": scale * data.attrs["g"]}
    attributes |= {"window_x": [scale * 0.2101, scale * 0.2116]}
    attributes |= {"window_xdot": [scale * 0.0925, scale * 0.0932]}
    return data.assign({name: scale * data[name] for name in names}).assign_attrs(attributes)


@pytest.mark.parametrize("scale", [5000.0, *slowly(0.37, 1.0, 2.0, 0.1)])
@pytest.mark.parametrize("kind", KINDS)
def test_a_picture_without_axes_has_those_of_its_data(kind, scale):
    scene = {key: value for key, value in SCENES[kind].items() if key != "axes"}
    scene |= {"duration": 15.5, "impacts": 200_000}
    scene |= {"ball": {"k": 0.2, "g": scale * 0.04}, "energy": scale * scale * 0.01}
    data = [with_scaled_lengths(part, scale) for part in DATA[kind]()]
    assert_legible(module(kind).draw(scene, *data))


@pytest.mark.parametrize("ball, energy", [((1 / 3, 0.01), -0.0001), ((0.05, 0.02), 0.004)])
def test_a_long_setting_and_short_axes_leave_the_text_of_a_box_apart(ball, energy):
    ball = Ball(*ball)
    scene = {"energy": energy, "ball": {"k": ball.k, "g": ball.g}, "view": VIEW}
    data = scene_orbits(ball, energy, [-0.3, 0.2, 0.7], 300)
    assert_legible(module("portrait").draw(scene, data))
