"""Scenes of config.yaml: a mistake is one line with the key, the value and what is allowed."""

import pytest
import yaml
from documents import AXES, SCENES, changed, complaint, complaints, good
from project import shipped

from pipeline import config
from pipeline.config.reference import example
from pipeline.config.schema.kinds import KINDS


def test_a_scene_is_completed_with_defaults():
    document = good()
    for field in ("sea", "view", "axes"):
        del document["scenes"]["a_portrait"][field]
    scenes = config.check(document)["scenes"]
    assert list(scenes) == list(SCENES)
    given = document["scenes"]["a_portrait"]
    added = {"sea": [], "view": {"elevation": 40, "azimuth": 115}, "formats": ["png"]}
    assert scenes["a_portrait"] == given | {"ball": {"k": 0.2, "g": 0.04}} | added


def test_axes_and_view_of_jumps_are_refused():
    block = yaml.safe_load(example("jumps"))
    for field in ("axes", "view"):
        line = complaint(good() | {"claims": {"a": block | {field: {}}}})
        assert line.startswith(f"claims.a.{field}: unknown key")


@pytest.mark.parametrize("impacts", [30, [30, 40]])
def test_impacts_are_a_number_or_a_list(impacts):
    document = changed("scenes.a_portrait.impacts", impacts)
    assert config.check(document)["scenes"]["a_portrait"]["impacts"] == impacts


@pytest.mark.parametrize(
    ("start", "words"),
    [
        (0.1, None),
        ({"x": 0.1, "xdot": 0.05}, None),
        ({"x": 0.1, "xdot": -0.02}, None),
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
        ({"x": "0.1", "y": 0}, "write 0.1"),
    ],
)
def test_a_start_is_a_fraction_or_a_point_on_the_section(start, words):
    document = changed("scenes.a_portrait.starts", [start, 0.5])
    if words is None:
        assert config.check(document)["scenes"]["a_portrait"]["starts"][0] == start
    else:
        line = complaint(document)
        assert line.startswith("scenes.a_portrait.starts[0]")
        assert words in line


def test_all_mistakes_of_a_file_are_reported_at_once():
    document = good()
    document["scenes"]["a_motion"] |= {"period": 0, "type": "eliptic"}
    document["scenes"]["exponents"]["record"] = 3
    document["scenes"]["a_tangle"]["energy"] = 0.9
    assert [line.split(": ")[0] for line in complaints(document)] == [
        "scenes.a_motion.period",
        "scenes.a_motion.type",
        "scenes.a_tangle.energy",
        "scenes.exponents.record",
    ]


def test_values_of_the_right_type_hide_no_mistake_between_fields():
    document = good()
    document["scenes"]["a_portrait"] |= {"formats": ["svg"], "energy": 9, "impacts": [1] * 9}
    assert [line.split(": ")[0] for line in complaints(document)] == [
        "scenes.a_portrait.formats",
        "scenes.a_portrait.energy",
        "scenes.a_portrait.impacts",
    ]


@pytest.mark.parametrize(
    ("scene", "fields", "lines"),
    [
        ("fig3", {"duration": 16}, []),
        ("fig3", {"duration": 30}, ["duration 30 lies outside axes.t.limits [0, 16]"]),
        ("fig3", {"duration": 30, "axes": {}}, []),
        ("fig7", {"impacts": [9, 300_000, 9]}, ["impacts 300000 lies outside axes.impact.limits"]),
        ("fig7", {"impacts": 1000}, []),
        ("twist", {"energies": [0.01, 0.07]}, ["energies 0.07 lies outside axes.energy.limits"]),
        (
            "fig6",
            {"window": {"x": [-0.1, 0.1], "xdot": [0, 0.001]}},
            ["window.x [-0.1, 0.1] is wider than axes.x.limits [0.21, 0.2116]"],
        ),
    ],
)
def test_values_outside_the_axes_are_reported(scene, fields, lines):
    document = shipped()
    blocks = document["scenes"] | document["proofs"]
    kind = KINDS[blocks[scene]["picture"]]
    block = {"ball": document["ball"]} | blocks[scene]
    assert not [*kind.hidden(block)]
    for line, start in zip(kind.hidden(block | fields), lines, strict=True):
        assert line.startswith(start)


def test_a_key_that_is_no_text_is_unknown():
    document = good()
    document["scenes"]["a_portrait"][3] = 4
    assert complaint(document).startswith("scenes.a_portrait[3]: unknown key: allowed here: ")


@pytest.mark.parametrize(
    ("path", "value", "parts"),
    [
        ("ball", ..., ["ball: missing: expected a mapping with the keys k and g"]),
        ("ball.k", ..., ["ball.k: missing: expected a number with 0 < k <= 1"]),
        ("ball.k", 0, ["ball.k: 0 is not allowed", "0 < k <= 1"]),
        ("ball.k", 1.01, ["ball.k: 1.01", "0 < k <= 1"]),
        ("ball.k", "0.2", ["ball.k: '0.2'", "write 0.2"]),
        ("ball.k", True, ["ball.k: true", "0 < k <= 1"]),
        ("ball.k", float("nan"), ["ball.k: nan"]),
        ("scenes.a_portrait.method", {"scan": 0.1}, ["tolerance: missing", "1e-15 to 0.001"]),
        (
            "scenes.a_portrait.method",
            "scan",
            ["method: 'scan'", "the keys scan and tolerance, or {exact"],
        ),
        *(
            ("scenes.a_motion.method", {"scan": scan, "tolerance": 1e-12}, [f"method.scan: {scan}"])
            for scan in (0, 1e-4, 1.5, float("nan"))
        ),
        *(
            (f"scenes.{scene}.method", {"scan": 0.1, "tolerance": tolerance}, ["method.tolerance"])
            for scene in SCENES
            for tolerance in (1e-16, 0.01)
        ),
        (
            "scenes.a_tangle.method",
            {"scan": 0.1, "tolerance": 1e-6},
            ["a_tangle.method.tolerance: 1e-06", "from 1e-15 to 1e-12, for manifolds"],
        ),
        ("ball.g", -1e-9, ["ball.g: -1e-09", "0 < g < k"]),
        ("ball.g", 0.2, ["ball.g: 0.2", "0 < g < k = 0.2"]),
        ("ball.gravity", 0.04, ["ball.gravity: unknown key", "k, g"]),
        ("scene", {}, ["scene: unknown key", "did you mean scenes?"]),
        ("scenes", {}, ["scenes: {}", "at least one"]),
        ("scenes", None, ["scenes: nothing"]),
        ("scenes.fig 2", SCENES["a_motion"], ["scenes: 'fig 2'", "letters, digits, - and _"]),
        ("scenes.2", SCENES["a_motion"], ["scenes: 2 is not allowed", "letters"]),
        ("scenes.new", None, ["scenes.new: nothing"]),
        ("scenes.new", {"energy": 1}, ["scenes.new.picture: missing: expected one of"]),
        ("scenes.a_motion.picture", "movie", ["scenes.a_motion.picture: 'movie'", "motion"]),
        ("scenes.a_motion.energie", 1, ["scenes.a_motion.energie: unknown", "mean energy?"]),
        ("scenes.a_motion.starts", [0.1], ["scenes.a_motion.starts: unknown key"]),
        ("scenes.a_motion.energy", ..., ["a_motion.energy: missing: expected a number"]),
        ("scenes.a_motion.energy", "low", ["scenes.a_motion.energy: 'low'", "a number"]),
        ("scenes.a_motion.energy", float("inf"), ["scenes.a_motion.energy: inf"]),
        ("scenes.a_motion.energy", 10**400, ["scenes.a_motion.energy: 1000"]),
        ("scenes.a_motion.energy", 0.06, ["energy: 0.06", "below k/2 - g = 0.06"]),
        ("scenes.a_motion.energy", -0.004, ["energy: -0.004", "above -g^2/(2k) = -0.004"]),
        ("scenes.a_motion.ball", {"k": 0.1, "g": 0.1}, ["scenes.a_motion.ball.g: 0.1"]),
        ("scenes.a_motion.ball", {"k": 0.1, "g": 0.045}, ["energy: 0.01", "0.005"]),
        ("scenes.a_motion.period", 0, ["period: 0", "from 1 to 12"]),
        ("scenes.a_motion.period", 13, ["period: 13", "from 1 to 12"]),
        ("scenes.a_motion.period", 6.0, ["period: 6.0", "whole number"]),
        ("scenes.a_motion.period", True, ["period: true", "whole number"]),
        ("scenes.a_motion.type", "eliptic", ["type: 'eliptic'", "elliptic"]),
        ("scenes.a_tangle.type", "elliptic", ["type: 'elliptic'", "no manifolds"]),
        ("scenes.a_motion.duration", 0, ["duration: 0", "0 < duration"]),
        ("scenes.a_motion.formats", ["svg"], ["formats: ['svg']", "png"]),
        ("scenes.a_motion.formats", ["png", "gif"], ["formats[1]: 'gif'", "png, svg, pdf"]),
        ("scenes.a_motion.formats", ["png", "png"], ["formats: ['png', 'png']", "twice"]),
        ("scenes.a_motion.formats", "png", ["formats: 'png'", "a list"]),
        ("scenes.a_motion.axes.t.limits", [16, 0], ["axes.t.limits: [16, 0]", "increasing"]),
        ("scenes.a_motion.axes.t.ticks", [0, 17], ["axes.t.ticks: 17", "limits [0, 16]"]),
        ("scenes.a_motion.axes.t.ticks", [], ["axes.t.ticks: []", "1 to 50 numbers"]),
        ("scenes.a_motion.axes.x", AXES, ["axes.x: unknown key: allowed here: t, displacement"]),
        ("scenes.a_motion.axes.y", {}, ["axes.y: unknown key"]),
        ("scenes.a_motion.axes.display", 3, ["axes.display: unknown", "mean displacement?"]),
        ("scenes.a_motion.axes", [], ["axes: []", "the keys t and displacement, or some of them"]),
        ("scenes.a_portrait.starts", [-0.5, 1], ["starts[1]: 1", "-1 < start < 1"]),
        ("scenes.a_portrait.starts", [], ["starts: []"]),
        ("scenes.a_portrait.impacts", [10], ["impacts: [10]", "each of the 2 starts"]),
        ("scenes.a_portrait.impacts", "many", ["impacts: 'many'", "a whole number"]),
        ("scenes.a_portrait.impacts", 6_000_000, ["at most 10000000 impacts"]),
        ("scenes.a_portrait.impacts", [10, 0], ["impacts[1]: 0"]),
        ("scenes.a_portrait.impacts", [10, 2.5], ["impacts[1]: 2.5", "whole number"]),
        ("scenes.a_portrait.impacts", [6_000_000, 6_000_000], ["at most 10000000 impacts"]),
        ("scenes.a_portrait.sea", [2], ["sea: 2", "from 0 to 1"]),
        ("scenes.a_portrait.view.elevation", 90, ["view.elevation: 90", "from 0.1 to 89.9"]),
        ("scenes.a_tangle.branches", {}, ["branches: {}"]),
        ("scenes.a_tangle.branches", {"upper": {"length": 1}}, ["branches.upper: unknown"]),
        ("scenes.a_tangle.branches.outer.length", 0, ["outer.length: 0", "positive"]),
        ("scenes.a_tangle.branches.outer.length", 1e6, ["outer.length: 1000000.0", "at most"]),
        ("scenes.a_tangle.resolution.distance", 0, ["resolution.distance: 0"]),
        ("scenes.a_tangle.resolution.bend", 100, ["resolution.bend: 100"]),
        ("scenes.a_closeup.point", 6, ["point: 6", "period - 1 = 5"]),
        ("scenes.a_closeup.point", -1, ["point: -1"]),
        ("scenes.a_closeup.length", 1e300, ["a_closeup.length: 1e+300", "at most 10000000 times"]),
        ("scenes.a_closeup.window.x", [0.1, 0.1], ["window.x: [0.1, 0.1]", "increasing"]),
        ("scenes.exponents.impacts", [99, 9], ["records: 10", "at most impacts = 9"]),
        ("scenes.exponents.records", 1001, ["records: 1001", "at most impacts = 1000"]),
    ],
)
def test_a_bad_value_is_refused_in_one_line(path, value, parts):
    document = changed(path, value)
    if path == "scenes.2":
        document["scenes"] = {2: SCENES["a_motion"]}
    line = complaint(document)
    for part in parts:
        assert part in line


@pytest.mark.parametrize(
    ("path", "value", "advice"),
    [
        ("scenes.a_motion.period", "6", "6"),
        ("scenes.a_motion.duration", "16.0", "16"),
        ("scenes.a_motion.energy", "1e-3", "0.001"),
        ("scenes.a_tangle.resolution.distance", "1e-5", "1.0e-05"),
        ("scenes.a_tangle.branches.outer.length", "1e3", "1000"),
        ("scenes.exponents.impacts", "1e3", "1000"),
        ("scenes.a_portrait.impacts", ["1e3", 1], "1000"),
        ("scenes.exponents.impacts", "1e9", ""),  # above what is allowed
        ("scenes.exponents.impacts", "2.5", ""),
        ("scenes.exponents.energy", "inf", ""),
        ("scenes.exponents.energy", "nan", ""),
        ("scenes.5 6", SCENES["a_motion"], ""),
    ],
)
def test_the_suggested_number_is_accepted(path, value, advice):
    line = complaint(changed(path, value))
    assert line.partition("; this is text to YAML, write ")[2] == advice
    if advice and isinstance(value, str):
        config.check(changed(path, yaml.safe_load(advice)))


@pytest.mark.parametrize(("g", "bound"), [(0.01, "0.14, "), (0.0100000003, "0.1399999997, ")])
def test_a_bound_is_printed_with_all_its_digits(g, bound):
    document = good()
    document["scenes"]["a_motion"] |= {"ball": {"k": 0.3, "g": g}, "energy": 0.15}
    assert f"below k/2 - g = {bound}" in complaint(document)
