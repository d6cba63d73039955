"""Names, keys and limits follow the data of a scene, not its config or the shipped scenes."""

import pytest

from helpers.keys import SCENE, texts
from helpers.samples import SCENES, module, motion
from helpers.sections import BALL
from pseudorigid.dynamics.lyapunov import scene_exponents
from pseudorigid.dynamics.orbits import scene_orbits
from pseudorigid.figures.axes import section
from pseudorigid.figures.canvas import style

VIEW = {"elevation": 40, "azimuth": 115}
REGULAR, CHAOTIC = [0.1, -0.2], 0.6  # starts at SCENE


def test_an_orbit_is_called_chaotic_by_its_growth():
    data = scene_orbits(BALL, 0.01, [*REGULAR, CHAOTIC], [200, 200, 900])
    assert data["type"].values.tolist() == ["regular", "regular", "chaotic"]
    portrait = module("portrait").draw(SCENE | {"view": VIEW}, data)
    assert {"chaotic orbit, start 3", "regular orbits, numbered by start"} <= {*texts(portrait)}
    sizes = [len(line.get_xdata()) for line in portrait.artists if line.get_color() == style.SEA]
    assert max(sizes) > 400
    _, regular, chaotic = section.over_orbits(SCENE, data)
    assert (regular[0], chaotic[0]) == ("regular orbits", "chaotic orbit")


def test_a_key_has_no_orbits_that_are_not_there():
    data = scene_orbits(BALL, 0.01, REGULAR, 200)
    portrait = module("portrait").draw(SCENE | {"view": VIEW}, data)
    assert not any("chaotic" in text for text in texts(portrait))
    curve = scene_orbits(BALL, 0.001, [0.5], 1000)  # of the example of `curves`
    _, regular, chaotic = section.over_orbits(SCENE | {"energy": 0.001}, curve)
    assert regular[0] == "regular orbit" and chaotic is None
    slow = scene_orbits(BALL, 0.01, [0.9999999999, CHAOTIC], 9)  # the first on the far side
    assert "chaotic orbit" in texts(module("portrait").draw(SCENE | {"view": VIEW}, slow))
    behind = VIEW | {"azimuth": -120}
    both = texts(module("portrait").draw(SCENE | {"view": behind}, slow))
    assert "chaotic and undecided orbits" in both
    few = scene_orbits(BALL, 0.01, [CHAOTIC], 5)
    _, regular, chaotic = section.over_orbits(SCENE, few)
    assert chaotic[0] == "chaotic orbit" and regular is None


@pytest.mark.parametrize("others", [[-0.2], [-0.2, -0.1, 0.1, 0.15, -0.3, -0.4, 0.05]])
def test_orbits_of_exponents_are_named_by_their_starts_and_types(others):
    starts = [*others, {"x": 0.4, "y": 0.0}]
    data = scene_exponents(BALL, 0.01, starts, 4000, 40)
    figure = module("exponents").draw(SCENE | {"starts": starts, "impacts": 4000}, data)
    names = [text for text in texts(figure) if text.endswith((": regular", ": chaotic"))]
    assert len(names) == len(starts) and "start \N{MINUS SIGN}0.2: regular" in names
    assert "$x$ 0.4, y 0: chaotic" in names


def test_one_orbit_has_no_key_and_hidden_exponents_no_name():
    data = scene_exponents(BALL, 0.01, [0.6], 2000, 40)
    narrow = {"exponent": {"limits": [-0.1, 0.1], "ticks": [0]}}
    scene = SCENE | {"starts": [0.6], "impacts": 2000, "axes": narrow}
    figure = module("exponents").draw(scene, data)
    names = [text for text in texts(figure) if "lambda" in text or "start" in text]
    assert names == [r"$\lambda_2$"]
    assert len([text for text in texts(figure) if text == "0"]) == 2  # of two axes


def test_orbits_of_one_type_are_named_by_their_starts_and_coinciding_lines_are_said():
    starts = [0.6, 0.62, 0.65]
    data = scene_exponents(BALL, 0.01, starts, 20_000, 40)
    exponent = {"limits": [-0.3, 0.3], "ticks": [0]}
    scene = SCENE | {"starts": starts, "impacts": 20_000, "axes": {"exponent": exponent}}
    found = texts(module("exponents").draw(scene, data))
    assert [text for text in found if "start" in text] == [f"start {at}" for at in starts]
    assert found.count("3 lines lie on one another") == 1  # those of lambda_2
    exponent["limits"] = [-0.3, 0.003]  # they are apart on this axis
    assert "3 lines lie on one another" not in texts(module("exponents").draw(scene, data))
    many = scene_exponents(BALL, 0.01, [0.6] * 13, 300, 3)
    figure = module("exponents").draw(scene | {"starts": [0.6] * 13, "axes": {}}, many)
    assert not [text for text in texts(figure) if "start" in text]


def test_no_mark_of_a_chart_lies_outside_its_frame():
    height = {"limits": [-0.1, 0.1], "ticks": [0]}
    axes = {"t": {"limits": [4, 10], "ticks": [5]}, "displacement": height}
    figure = module("motion").draw(SCENES["motion"] | {"axes": axes}, motion())
    dots = [len(line.get_xdata()) for line in figure.artists if line.get_marker() == "o"]
    assert sorted(dots) == [1, 2]  # the key's, and those at 6.2 and 9.3
    axes["t"] = {"limits": [4, 6], "ticks": [5]}
    figure = module("motion").draw(SCENES["motion"] | {"axes": axes}, motion())
    assert "impact" not in texts(figure)
