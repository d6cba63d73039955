"""From the file to a config: what is no config at all, and what each scene needs computed."""

import json
import subprocess
import sys

import pytest
from documents import complaints, good
from project import ROOT, SHIPPED, shipped

from pipeline import config
from pipeline.config import paths


@pytest.mark.parametrize("document", [None, [], "text", 3, {}, {"ball": {}, "scenes": []}])
def test_something_else_than_a_config_is_refused(document):
    assert complaints(document)


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
        (b"#" * 500_001, "config.yaml: has 500001 bytes: expected at most 500000"),
        (b"[" * 3000, "config.yaml: nested too deeply"),
        (b"ball: " + b"{k: " * 3000, "config.yaml: nested too deeply"),
        (b"ball: !!bool x", "not valid YAML"),
        (b"ball: !!int ''", "not valid YAML"),
        (b"ball: !!timestamp x", "not valid YAML"),
        (b"ball: !!map [1]", "not valid YAML"),
    ],
)
def test_a_file_that_is_no_config_is_refused(tmp_path, text, part):
    path = tmp_path / "config.yaml"
    path.write_bytes(text)
    with pytest.raises(config.ConfigError) as raised:
        config.load(path)
    lines = str(raised.value).splitlines()
    assert all(line.startswith("config.yaml: ") for line in lines)
    assert part in lines[0]


def test_a_missing_file_is_refused_in_one_line(tmp_path):
    with pytest.raises(config.ConfigError, match=r"config\.yaml: cannot be read: No such file"):
        config.load(tmp_path / "config.yaml")


def test_an_added_scene_changes_no_path():
    document = good()
    before = paths.artifact_paths(config.check(document)["variants"])
    assert before["paper", "a_closeup", "periodic"] == "results/paper/periodic_a_closeup.nc"
    twin = {"a": document["scenes"]["a_closeup"]}
    document["scenes"] = twin | document["scenes"] | {"z": twin["a"]}
    after = paths.artifact_paths(config.check(document)["variants"])
    assert after["paper", "a", "periodic"] == "results/paper/periodic_a.nc"
    assert before.items() <= after.items()


def test_drawing_does_not_decide_data():
    block = config.check(good())["scenes"]["exponents"]
    other = block | {"axes": {}, "formats": ["png", "pdf"]}
    assert paths.stages(block) == paths.stages(other)
    assert json.dumps(paths.stages(block))


def test_reading_the_config_imports_nothing_heavy():
    program = (
        "import sys\nfrom pipeline import config\n"
        f"config.load({str(SHIPPED)!r})\n"
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


def test_numbers_in_the_shipped_file_are_numbers():
    def texts(value):
        if isinstance(value, dict):
            return [text for item in value.values() for text in texts(item)]
        if isinstance(value, list):
            return [text for item in value for text in texts(item)]
        return [value] if isinstance(value, str) else []

    assert not [text for text in texts(shipped()) if text[0].isdigit()]


def test_the_shipped_config_is_good():
    assert set(config.load(SHIPPED)["scenes"]) == {f"fig{n}" for n in range(2, 9)}
