"""The picture of families of periodic orbits: legible, reproducible, and each datum shows."""

import numpy as np
import pytest
from legible import assert_text_is_whole_and_apart

from pseudorigid import Ball
from pseudorigid.analyses.families import families
from pseudorigid.figures.canvas.render import pixels, render
from pseudorigid.figures.kinds.families import draw
from pseudorigid.sweep.shares import shares

BALL = Ball(0.2, 0.04)
SCENE = {
    "picture": "families", "ball": {"k": 0.2, "g": 0.04}, "energy": 0.01, "parameter": "energy",
    "span": [0.004, 0.02], "period": 6, "levels": 8, "drawn": 6, "step": 0.002, "starts": 40,
    "impacts": 1000,
}  # fmt: skip


@pytest.fixture(scope="module")
def data():
    held = families(BALL, 0.01, "energy", SCENE["span"], 6, 8)
    along = shares(BALL, 0.01, held, "energy", SCENE["span"], 0.002, 40, 1000)
    return held, along


def test_the_text_is_whole_and_apart(data):
    assert_text_is_whole_and_apart(draw(SCENE, *data), margin=1, slack=5)


def test_the_picture_is_reproducible(data):
    assert render(draw(SCENE, *data), "png") == render(draw(SCENE, *data), "png")


@pytest.mark.parametrize(
    ("index", "name", "change"),
    [
        (0, "x", lambda v: v + 0.02),
        (0, "trace", lambda v: v + 0.2),
        (0, "type", lambda v: np.full(v.shape, "hyperbolic", dtype=object)),
        (0, "event_x", lambda v: v + 0.03),
        (0, "end_kind", lambda v: np.full(v.shape, "range", dtype=object)),
        (1, "regular", lambda v: 0.5 * v),
    ],
)
def test_a_change_of_the_data_shows(data, index, name, change):
    changed = [part.copy(deep=True) for part in data]
    variable = changed[index][name]
    changed[index][name] = variable.dims, change(variable.values)
    assert np.any(pixels(draw(SCENE, *changed)) != pixels(draw(SCENE, *data)))


def test_families_above_the_largest_drawn_period_are_left_out(data):
    few = pixels(draw(SCENE | {"drawn": 1}, *data))
    assert np.any(few != pixels(draw(SCENE, *data)))


def test_a_line_over_k_is_drawn():
    held = families(BALL, 0.01, "k", [0.18, 0.22], 6, 4)
    along = shares(BALL, 0.01, held, "k", [0.18, 0.22], 0.01, 20, 500)
    scene = SCENE | {"parameter": "k", "span": [0.18, 0.22], "step": 0.01}
    assert_text_is_whole_and_apart(draw(scene, held, along), margin=1, slack=5)
