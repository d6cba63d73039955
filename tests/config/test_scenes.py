"""config.yaml: every mistake ends in one line that names the key, the value and what is allowed."""

import copy
import json
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from pipeline import config

ROOT = Path(__file__).parents[1]
AXES = {"limits": [-1, 1], "ticks": [0]}
SECTION = {"x": AXES, "xdot": AXES, "udot": AXES}
VIEW = {"elevation": 40, "azimuth": 115}
RESOLUTION = {"distance": 0.01, "bend": 10}

SCENES = {
    "a_portrait": {
        "picture": "portrait",
        "energy": 0.01,
        "starts": [-0.5, 0.5],
        "impacts": [10, 20],
        "sea": [1],
        "view": VIEW,
        "axes": SECTION,
    },
    "a_motion": {
        "picture": "motion",
        "energy": 0.01,
        "period": 6,
        "type": "elliptic",
        "duration": 16,
        "formats": ["png", "svg", "pdf"],
        "axes": {"t": {"limits": [0, 16], "ticks": [0, 16]}, "displacement": AXES},
    },
    "a_tangle": {
        "picture": "tangle",
        "energy": 0.01,
        "period": 6,
        "type": "hyperbolic",
        "branches": {"outer": {"length": 2}},
        "resolution": RESOLUTION,
        "starts": [0.5],
        "impacts": [10],
        "view": VIEW,
        "axes": SECTION,
    },
    "a_closeup": {
        "picture": "closeup",
        "energy": 0.01,
        "period": 6,
        "type": "hyperbolic",
        "point": 5,
        "window": {"x": [-0.1, 0.1], "xdot": [-0.1, 0.1]},
        "length": 2,
        "resolution": RESOLUTION,
        "axes": {"x": AXES, "xdot": AXES},
    },
    "exponents": {
        "picture": "exponents",
        "energy": 0.01,
        "starts": [0.5, 0.6],
        "impacts": 1000,
        "records": 10,
        "axes": {"impact": {"limits": [0, 1000], "ticks": [0, 1000]}, "exponent": AXES},
    },
}
GOOD = {"ball": {"k": 0.2, "g": 0.04}, "scenes": SCENES}


def changed(path, value):
    """A copy of GOOD with the value at a dotted path replaced, or the key removed by `...`."""
    document = copy.deepcopy(GOOD)
    block = document
    *parents, last = (int(key) if key.isdigit() else key for key in path.split("."))
    for key in parents:
        block = block[key]
    if value is ...:
        del block[last]
    else:
        block[last] = value
    return document


def complaint(document):
    with pytest.raises(config.ConfigError) as raised:
        config.check(document)
    line = str(raised.value)
    assert line.count("\n") == 0
    return line


def test_a_good_config_comes_back_complete():
    checked = config.check(copy.deepcopy(GOOD))
    assert list(checked["scenes"]) == list(SCENES)
    portrait = checked["scenes"]["a_portrait"]
    assert portrait["ball"] == {"k": 0.2, "g": 0.04}
    assert portrait["formats"] == ["png"]


def test_the_committed_config_is_good():
    assert set(config.load(ROOT / "config.yaml")["scenes"]) >= {f"fig{n}" for n in range(2, 9)}


@pytest.mark.parametrize(
    ("path", "value", "parts"),
    [
        ("ball", ..., ["ball: missing"]),
        ("ball.k", ..., ["ball.k: missing"]),
        ("ball.k", 0, ["ball.k: 0 is not allowed", "0 < k <= 1"]),
        ("ball.k", 1.01, ["ball.k: 1.01", "0 < k <= 1"]),
        ("ball.k", "0.2", ["ball.k: '0.2'", "write 0.2"]),
        ("ball.k", True, ["ball.k: true", "0 < k <= 1"]),
        ("ball.k", None, ["ball.k: nothing"]),
        ("ball.k", float("nan"), ["ball.k: nan"]),
        ("ball.k", [0.2], ["ball.k: [0.2]"]),
        ("scenes.a_portrait.method", {"scan": 0}, ["a_portrait.method.tolerance: missing"]),
        ("scenes.a_portrait.method", "scan", ["method: 'scan'", "the keys scan and tolerance"]),
        *(
            (f"scenes.{scene}.method", {"scan": scan, "tolerance": 1e-12}, [f"method.scan: {scan}"])
            for scene in SCENES
            for scan in (0, -0.1, 1e-4, 1.5, float("nan"), float("inf"))
        ),
        *(
            (f"scenes.{scene}.method", {"scan": 0.1, "tolerance": tolerance}, ["method.tolerance"])
            for scene in SCENES
            for tolerance in (0, -1e-9, 1e-16, 0.01, float("nan"))
        ),
        (
            "scenes.a_tangle.method",
            {"scan": 0.1, "tolerance": 1e-6},
            ["a_tangle.method.tolerance: 1e-06", "from 1e-15 to 1e-12, for manifolds"],
        ),
        (
            "scenes.a_closeup.method",
            {"scan": 0.1, "tolerance": 1e-6},
            ["a_closeup.method.tolerance: 1e-06", "from 1e-15 to 1e-12, for manifolds"],
        ),
        (
            "scenes.exponents.method",
            {"scan": 0.1, "tolerance": "1e-6"},
            ["exponents.method.tolerance: '1e-6'", "this is text to YAML, write 1.0e-06"],
        ),
        ("ball.g", 0, ["ball.g: 0", "0 < g < k"]),
        ("ball.g", -1e-9, ["ball.g: -1e-09", "0 < g < k"]),
        ("ball.g", 0.2, ["ball.g: 0.2", "0 < g < k = 0.2"]),
        ("ball.g", "1e-3", ["ball.g: '1e-3'", "text to YAML", "write 0.001"]),
        ("ball.g", "1e-9", ["write 1.0e-09"]),
        ("ball.gravity", 0.04, ["ball.gravity: unknown key", "k, g"]),
        ("scene", {}, ["scene: unknown key", "did you mean scenes?"]),
        ("scenes", {}, ["scenes: {}", "at least one"]),
        ("scenes", None, ["scenes: nothing"]),
        ("scenes.fig 2", SCENES["a_motion"], ["scenes: 'fig 2'", "letters, digits, - and _"]),
        ("scenes.fig/2", SCENES["a_motion"], ["scenes: 'fig/2'"]),
        ("scenes.2", SCENES["a_motion"], ["scenes: 2 is not allowed", "letters"]),
        ("scenes.new", None, ["scenes.new: nothing"]),
        ("scenes.new", {"energy": 1}, ["scenes.new.picture: missing"]),
        ("scenes.a_motion.picture", "movie", ["scenes.a_motion.picture: 'movie'", "motion"]),
        ("scenes.a_motion.energie", 1, ["scenes.a_motion.energie: unknown", "mean energy?"]),
        ("scenes.a_motion.starts", [0.1], ["scenes.a_motion.starts: unknown key"]),
        ("scenes.a_motion.energy", ..., ["scenes.a_motion.energy: missing"]),
        ("scenes.a_motion.energy", "low", ["scenes.a_motion.energy: 'low'", "a number"]),
        ("scenes.a_motion.energy", float("inf"), ["scenes.a_motion.energy: inf"]),
        ("scenes.a_motion.energy", 10**400, ["scenes.a_motion.energy: 1000"]),
        ("scenes.a_motion.energy", 0.9, ["energy: 0.9", "below k/2 - g = 0.06"]),
        ("scenes.a_motion.energy", 0.06, ["energy: 0.06", "below k/2 - g = 0.06"]),
        ("scenes.a_motion.energy", -0.004, ["energy: -0.004", "above -g^2/(2k) = -0.004"]),
        ("scenes.a_motion.ball", {"k": 0.1, "g": 0.1}, ["scenes.a_motion.ball.g: 0.1"]),
        ("scenes.a_motion.ball", {"k": 0.1, "g": 0.045}, ["energy: 0.01", "0.005"]),
        ("scenes.a_motion.period", 0, ["period: 0", "from 1 to 12"]),
        ("scenes.a_motion.period", 13, ["period: 13", "from 1 to 12"]),
        ("scenes.a_motion.period", 6.0, ["period: 6.0", "whole number"]),
        ("scenes.a_motion.period", "6", ["period: '6'", "text to YAML, write 6"]),
        ("scenes.a_motion.period", True, ["period: true", "whole number"]),
        ("scenes.a_motion.type", "eliptic", ["type: 'eliptic'", "elliptic"]),
        ("scenes.a_tangle.type", "elliptic", ["type: 'elliptic'", "no manifolds"]),
        ("scenes.a_motion.duration", 0, ["duration: 0", "0 < duration"]),
        ("scenes.a_motion.formats", ["svg"], ["formats: ['svg']", "png"]),
        ("scenes.a_motion.formats", ["png", "gif"], ["formats[1]: 'gif'", "png, svg, pdf"]),
        ("scenes.a_motion.formats", ["png", "png"], ["formats: ['png', 'png']", "twice"]),
        ("scenes.a_motion.formats", "png", ["formats: 'png'", "a list"]),
        ("scenes.a_motion.axes.t.limits", [16, 0], ["axes.t.limits: [16, 0]", "increasing"]),
        ("scenes.a_motion.axes.t.limits", [0], ["axes.t.limits: [0]", "two increasing"]),
        ("scenes.a_motion.axes.t.ticks", [0, 17], ["axes.t.ticks: 17", "limits [0, 16]"]),
        ("scenes.a_motion.axes.t.ticks", [], ["axes.t.ticks: []", "1 to 50 numbers"]),
        ("scenes.a_motion.axes.x", AXES, ["axes.x: unknown key"]),
        ("scenes.a_portrait.starts", [-0.5, 1], ["starts[1]: 1", "-1 < start < 1"]),
        ("scenes.a_portrait.starts", [-1.0, 0], ["starts[0]: -1.0", "-1 < start < 1"]),
        ("scenes.a_portrait.starts", [], ["starts: []"]),
        ("scenes.a_portrait.starts", [0.1, "0.2"], ["starts[1]: '0.2'", "write 0.2"]),
        ("scenes.a_portrait.impacts", [10], ["impacts: [10]", "each of the 2 starts"]),
        ("scenes.a_portrait.impacts", 10, ["impacts: 10", "a list"]),
        ("scenes.a_portrait.impacts", [10, 0], ["impacts[1]: 0"]),
        ("scenes.a_portrait.impacts", [10, -5], ["impacts[1]: -5"]),
        ("scenes.a_portrait.impacts", [10, 2.5], ["impacts[1]: 2.5", "whole number"]),
        ("scenes.a_portrait.impacts", [6_000_000, 6_000_000], ["at most 10000000 impacts"]),
        ("scenes.a_portrait.impacts", ["1e3", 1], ["impacts[0]: '1e3'", "write 1000"]),
        ("scenes.a_portrait.sea", [2], ["sea: 2", "from 0 to 1"]),
        ("scenes.a_portrait.view.elevation", 90, ["view.elevation: 90", "elevation < 90"]),
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
        ("scenes.exponents.impacts", 0, ["impacts: 0"]),
        ("scenes.exponents.impacts", [1, 2], ["impacts: [1, 2]", "whole number"]),
        ("scenes.exponents.impacts", 6_000_000, ["impacts: 6000000", "over all its starts"]),
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
        ("scenes.exponents.impacts", "1e9", ""),  # above what is allowed
        ("scenes.exponents.impacts", "2.5", ""),
        ("scenes.exponents.energy", "inf", ""),
        ("scenes.exponents.energy", "nan", ""),
        ("scenes.5 6", SCENES["a_motion"], ""),
    ],
)
def test_what_is_said_to_be_written_instead_is_taken(path, value, advice):
    line = complaint(changed(path, value))
    assert line.partition("; this is text to YAML, write ")[2] == advice
    if advice:
        config.check(changed(path, yaml.safe_load(advice)))


@pytest.mark.parametrize("document", [None, [], "text", 3, {}, {"ball": {}, "scenes": []}])
def test_something_else_than_a_config_is_refused(document):
    complaint(document)


@pytest.mark.parametrize(
    ("text", "part"),
    [
        (b"", "nothing is not allowed"),
        (b"ball: {k: 0.2\nscenes: [", "line 2, column"),
        (b"ball: {k: 0.2, g: 0.04, k: 0.3}", "the key k is given twice"),
        (b"ball: {k: 0.2}\nball: {k: 0.3}", "line 2, column 1: not valid YAML: the key ball"),
        (b"\tball: 1", "not valid YAML"),
        (b"ball: \xff", "not UTF-8"),
        (b"ball: !!python/object:os.system x", "not valid YAML"),
        (b"ball: 2001-99-99", "not valid YAML"),
        (b"--- 1\n--- 2\n", "not valid YAML"),
        (b"ball: &a [*a]\nscenes: {}", "ball: "),
        (b"? {a: 1}\n: 3", "line 1, column 3: not valid YAML: found unhashable key"),
        (b"ball: {[1, 2]: 3}", "line 1, column 8: not valid YAML: found unhashable key"),
        (b"? [a]\n: 3\n? [a]\n: 4", "found unhashable key"),
        (b"[" * 3000, "config.yaml: nested too deeply"),
        (b"ball: " + b"{k: " * 3000, "config.yaml: nested too deeply"),
        (b"ball: !!bool x", "not valid YAML"),
        (b"ball: !!int ''", "not valid YAML"),
        (b"ball: !!timestamp x", "not valid YAML"),
        (b"ball: !!map [1]", "not valid YAML"),
    ],
)
def test_a_file_that_is_no_config_is_refused_in_one_line(tmp_path, text, part):
    path = tmp_path / "config.yaml"
    path.write_bytes(text)
    with pytest.raises(config.ConfigError) as raised:
        config.load(path)
    line = str(raised.value)
    assert line.startswith("config.yaml: ")
    assert part in line
    assert "\n" not in line


def test_a_missing_file_is_refused_in_one_line(tmp_path):
    with pytest.raises(config.ConfigError, match=r"config\.yaml: cannot be read: No such file"):
        config.load(tmp_path / "config.yaml")


def test_equal_stages_are_computed_once():
    scenes = copy.deepcopy(SCENES)
    scenes["again"] = scenes["a_closeup"] | {"energy": 0.02}
    serves = config.served(config.check({"ball": GOOD["ball"], "scenes": scenes})["variants"])
    assert serves["paper", "a_tangle", "periodic"] == "results/paper/periodic_a_motion.nc"
    assert serves["paper", "a_closeup", "periodic"] == "results/paper/periodic_a_motion.nc"
    assert serves["paper", "a_closeup", "manifolds"] == "results/paper/manifolds_a_closeup.nc"
    assert serves["paper", "again", "periodic"] == "results/paper/periodic_again.nc"


def test_drawing_does_not_decide_data():
    block = config.check(copy.deepcopy(GOOD))["scenes"]["exponents"]
    other = block | {"axes": {}, "formats": ["png", "pdf"]}
    assert config.stages(block) == config.stages(other)
    assert json.dumps(config.stages(block))


def test_reading_the_config_imports_nothing_heavy():
    program = (
        "import sys, pseudorigid.config, pseudorigid.sources\n"
        f"pseudorigid.config.load({str(ROOT / 'config.yaml')!r})\n"
        "print(*{'numpy', 'numba', 'xarray', 'matplotlib', 'netCDF4'} & set(sys.modules))"
    )
    command = [sys.executable, "-c", program]
    environment = {"PYTHONPATH": str(ROOT / "src")}
    assert (
        subprocess.run(
            command, env=environment, capture_output=True, text=True, check=True
        ).stdout.split()
        == []
    )


def test_numbers_in_the_committed_file_are_numbers():
    def texts(value):
        if isinstance(value, dict):
            return [text for item in value.values() for text in texts(item)]
        if isinstance(value, list):
            return [text for item in value for text in texts(item)]
        return [value] if isinstance(value, str) else []

    document = yaml.safe_load((ROOT / "config.yaml").read_text())
    assert not [text for text in texts(document) if text[0].isdigit()]
