"""Scenes of config.yaml: a mistake is one line with the key, the value and what is allowed."""

import json

import pytest

from helpers.documents import AXES, SCENES, changed, complaint, complaints, good
from pipeline import config


def test_a_scene_is_completed_with_defaults():
    document = good()
    for field in ("view", "axes"):
        del document["scenes"]["a_portrait"][field]
    scenes = config.check(document).scenes
    assert list(scenes) == list(SCENES)
    given = document["scenes"]["a_portrait"]
    added = {"view": {"elevation": 40, "azimuth": 115}, "formats": ["png"]}
    assert scenes["a_portrait"].as_mapping() == given | {"ball": {"k": 0.2, "g": 0.04}} | added


def test_numbers_are_recorded_as_they_were_written():
    """As 1 and 1.0 differ in records, another form of a number would outdate results."""
    written = {"impact": {"limits": [0, 1000.0], "ticks": [0, 1e3]}}
    document = changed("scenes.exponents.axes", written)
    document["scenes"]["exponents"]["starts"] = [0, {"x": 0, "y": 0.0}]
    block = config.check(document).scenes["exponents"].as_mapping()
    assert json.dumps(block["axes"]) == json.dumps(written)
    assert json.dumps(block["starts"]) == '[0, {"x": 0, "y": 0.0}]'


@pytest.mark.parametrize(("start", "words"), [
    (0.1, None),
    ({"x": 0.1, "xdot": 0.05}, None),
    ({"x": 0.1, "y": 0.02}, None),
    ({"x": 0.1, "y": -0.02}, None),
    ({"x": 0.5739, "y": 0}, None),  # the section ends at 0.2 + sqrt(0.14) = 0.57417
    ({"x": 0.5742, "y": 0}, "starts[0]: {'x': 0.5742, 'y': 0} is not allowed"),
    ({"x": 0.2, "xdot": 0.17}, "xdot^2 < 2E + 2gx - kx^2"),  # sqrt(0.028) = 0.1673
    ({"x": 0.2, "xdot": -0.16}, "xdot + udot > 0"),
    ({"x": 0.2, "y": 0.19}, "y^2/(1+k) + k (x - g/k)^2 < 2E + g^2/k"),  # sqrt(0.0336) = 0.1833
    ({"x": 0.1}, "a point {x, xdot} or {x, y}"),
    ({"x": 0.1, "y": 0, "xdot": 0}, "a point {x, xdot} or {x, y}"),
    ({"x": 0.1, "z": 0}, "starts[0].z: unknown key: allowed here: x, xdot, y"),
    ({"y": 0.1}, "starts[0].x: missing: expected a number"),
])  # fmt: skip
def test_a_start_is_a_fraction_or_a_point_on_the_section(start, words):
    document = changed("scenes.a_portrait.starts", [start, 0.5])
    if words is None:
        assert config.check(document).scenes["a_portrait"].as_mapping()["starts"][0] == start
    else:
        line = complaint(document)
        assert line.startswith("scenes.a_portrait.starts[0]")
        assert words in line


def test_all_mistakes_of_a_file_are_reported_at_once():
    document = good()
    document["scenes"]["a_motion"] |= {"period": 0, "type": "eliptic"}
    document["scenes"]["exponents"]["record"] = 3
    document["scenes"]["a_tangle"]["energy"] = 0.9
    # Values of the right type hide no mistake between fields.
    document["scenes"]["a_portrait"] |= {"formats": ["svg"], "energy": 9, "impacts": [1] * 9}
    assert [line.split(": ")[0].removeprefix("scenes.") for line in complaints(document)] == [
        *("a_portrait.formats", "a_portrait.energy", "a_portrait.impacts"),
        *("a_motion.period", "a_motion.type", "a_tangle.energy", "exponents.record"),
    ]


# A path, of a scene unless it begins otherwise, a value that is refused there, and how the line
# goes on. `config.schema.json`, which `test_renew` compares, holds the bounds of single values.
BAD = [
    ("ball", ..., ": missing: expected a mapping with the keys k and g"),
    ("ball.k", 0, ": 0 is not allowed: expected a number with 0 < k <= 1"),
    ("ball.k", "0.2", ": '0.2' is not allowed"),
    ("ball.g", 0.2, ": 0.2 is not allowed: expected 0 < g < k = 0.2"),
    ("ball.gravity", 0.04, ": unknown key: allowed here: k, g"),
    ("scene", {}, ": unknown key: did you mean scenes?"),
    ("scenes", {}, ": {} is not allowed: expected a mapping from names to scenes, at least one"),
    ("scenes.new", {"energy": 1}, ".picture: missing: expected one of"),
    ("a_portrait.method", {"scan": 0.1}, ".tolerance: missing: expected a number from 1e-15"),
    ("a_tangle.method", {"scan": 0.1, "tolerance": 1e-6},
     ".tolerance: 1e-06 is not allowed: expected a number from 1e-15 to 1e-12, for manifolds"),
    ("a_motion.picture", "movie", ": 'movie' is not allowed: expected one of"),
    ("a_motion.starts", [0.1], ": unknown key"),
    ("a_motion.energy", ..., ": missing: expected a number with"),
    ("a_motion.energy", float("inf"), ": inf is not allowed: expected a number with"),
    ("a_motion.energy", 0.06, ": 0.06 is not allowed: expected a number below k/2 - g = 0.06,"),
    ("a_motion.energy", -0.004, ": -0.004 is not allowed: expected a number above -g^2/(2k)"),
    ("a_motion.period", 6.0, ": 6.0 is not allowed: expected a whole number from 1 to 12"),
    ("a_motion.type", "eliptic", ": 'eliptic' is not allowed: expected one of elliptic"),
    ("a_motion.formats", ["svg"], ": ['svg'] is not allowed: expected a list of png"),
    ("a_motion.formats", ["png", "gif"], "[1]: 'gif' is not allowed: expected one of png, svg"),
    ("a_motion.axes.t.limits", [16, 0], ": [16, 0] is not allowed: expected a list of two incr"),
    ("a_motion.axes.t.ticks", [0, 17], ": 17 is not allowed: expected numbers within the limit"),
    ("a_motion.axes.x", AXES, ": unknown key: allowed here: t, displacement"),
    ("a_motion.axes", 3, ": 3 is not allowed: expected a mapping with the keys t and displacement, "
     "or one of them"),
    ("a_closeup.window", 3, ": 3 is not allowed: expected a mapping with the keys x and xdot"),
    ("a_motion.axes.display", 3, ": unknown key: did you mean displacement?"),
    ("a_portrait.starts", [-0.5, 1], "[1]: 1 is not allowed: expected a fraction of"),
    ("a_portrait.impacts", [10], ": [10] is not allowed: expected one number for each of the 2"),
    ("a_portrait.impacts", 6_000_000, ": 6000000 is not allowed: expected at most 10000000"),
    ("a_portrait.impacts", [10, 2.5], "[1]: 2.5 is not allowed: expected a whole number"),
    ("a_portrait.sea", [1], ": no key any more: which orbits are chaotic is computed. Delete it."),
    ("a_portrait.axes.udot", {"limits": [0, 100], "ticks": [0]},
     ".limits: [0, 100] is not allowed: expected limits that make the box in this view 0.1 to"),
    ("a_tangle.branches.outer.length", 4167, ": 4167 is not allowed: expected at most 10000000 "
     "times resolution.distance, shared by 24 branches = 4166.666666666667"),
    ("a_closeup.point", 6, ": 6 is not allowed: expected a whole number from 0 to period - 1"),
    ("a_closeup.length", 1e300, ": 1e+300 is not allowed: expected at most 10000000 times"),
    ("exponents.records", 1001, ": 1001 is not allowed: expected at most impacts = 1000"),
]  # fmt: skip


@pytest.mark.parametrize(("path", "value", "words"), BAD)
def test_a_bad_value_is_refused_in_one_line(path, value, words):
    full = path if path.startswith(("ball", "scene")) else f"scenes.{path}"
    assert complaint(changed(full, value)).startswith(f"{full}{words}")


def test_a_value_of_any_size_is_shortened_to_a_line():
    value = "x"
    for _ in range(9):  # 10^9 values, and more as text than memory holds
        value = [value] * 10
    document = good()
    document["scenes"]["a_portrait"] |= {"starts": value, "impacts": 16**5000}
    lines = complaints(document)
    assert len(lines) == 11 and all(len(line) < 250 for line in lines)


def test_a_misspelt_key_is_one_mistake():
    document = good()
    document["scenes"]["a_motion"]["perod"] = document["scenes"]["a_motion"].pop("period")
    line = "scenes.a_motion.perod: unknown key: did you mean period?"
    assert complaint(document) == line


def test_keys_are_texts_and_a_name_has_no_spaces():
    document = good()
    document["scenes"]["a_portrait"][3] = 4
    document["scenes"] |= {key: SCENES["a_motion"] for key in ("fig 2", 2)}
    first, second, third = complaints(document)
    name = "expected a name of letters, digits, - and _ that does not begin with -"
    assert first == f"scenes: 'fig 2' is not allowed: {name}"
    assert second == f"scenes: 2 is not allowed: {name}"
    assert third.startswith("scenes.a_portrait[3]: unknown key: allowed here: ")


def test_a_k_that_no_sphere_has_gives_one_line():
    assert config.check(good()).warning() == ""
    document = good() | {"variants": {"wide": {"ball": {"k": 0.4}}}}
    document["scenes"]["a_motion"]["ball"] = {"k": 0.35, "g": 0.04}
    words = "config.yaml: k = 0.35, 0.4: no sphere has a k above 1/3, which is that of a thin shell"
    assert config.check(document).warning() == words
    document["ball"]["k"] = 1 / 3
    del document["variants"], document["scenes"]["a_motion"]["ball"]
    assert config.check(document).warning() == ""
