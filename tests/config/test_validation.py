"""Any file named config.yaml is a correct config or is refused in lines that name it."""

import json

import pytest
import yaml
from documents import complaints, good
from hypothesis import given, settings
from hypothesis import strategies as st
from project import SHIPPED, shipped
from random_documents import FUZZ, JSON, edited, spoilt

from pipeline import config
from pipeline.config.validation import document


@pytest.mark.parametrize("document", [None, [], "text", 3, {}, {"ball": {}, "scenes": []}])
def test_something_else_than_a_config_is_refused(document):
    assert complaints(document)


@pytest.mark.parametrize(
    ("text", "part"),
    [
        (b"", "nothing is not allowed"),
        (b"ball: {k: 0.2\nscenes: [", "line 2, column"),
        (b"ball: {k: 0.2}\nball: {k: 0.3}", "line 2, column 1: not valid YAML: the key ball"),
        (b"ball: \xff", "not UTF-8"),
        (b"ball: !!python/object:os.system x", "not valid YAML"),
        (b"ball: 2001-99-99", "not valid YAML"),
        (b"--- 1\n--- 2\n", "not valid YAML"),
        (b"ball: &a [*a]\nscenes: {}", "ball: "),
        (b"? {a: 1}\n: 3", "line 1, column 3: not valid YAML: found unhashable key"),
        (b"#" * 500_001, "config.yaml: has 500001 bytes: expected at most 500000"),
        (b"ball: " + b"{k: " * 3000, "config.yaml: nested too deeply"),
        (None, "config.yaml: cannot be read: No such file"),
    ],
)
def test_a_file_that_is_no_config_is_refused(tmp_path, text, part):
    path = tmp_path / "config.yaml"
    if text is not None:
        path.write_bytes(text)
    with pytest.raises(config.ConfigError) as raised:
        config.load(path)
    lines = str(raised.value).splitlines()
    assert all(line.startswith("config.yaml: ") for line in lines)
    assert part in lines[0]


@pytest.mark.slow
def test_any_file_is_a_config_or_is_refused(tmp_path):
    path = tmp_path / "config.yaml"
    documents = (edited(shipped()) | JSON).map(lambda found: yaml.safe_dump(found).encode())

    @settings(FUZZ, max_examples=100)
    @given(data=documents | spoilt(SHIPPED.read_bytes()) | st.binary(max_size=200))
    def trial(data):
        path.write_bytes(data)
        try:
            checked = config.load(path)
        except config.ConfigError as error:
            assert all(line.startswith("config.yaml: ") for line in str(error).splitlines())
            return
        for result in checked.build_specs(["paper"]):
            assert (tmp_path / result).resolve().is_relative_to(tmp_path / "results" / "paper")

    trial()


def test_a_scene_of_a_shipped_file_has_its_own_ball_or_that_of_the_file(tmp_path, monkeypatch):
    file = tmp_path / "scenes.yaml"
    own = {"ball": {"k": 0.3, "g": 0.01}, "energy": 0.02}
    scenes = {"own": own, "of_file": {"energy": 0.01}, "without": {"cells": 3}}
    file.write_text(json.dumps({"ball": {"k": 0.2, "g": 0.04}, "found": scenes}))
    monkeypatch.setattr(document, "files", lambda name: {"part": file} if name == file.name else {})
    found = document.with_shipped({})["found"]
    assert found["own"] == own and found["without"] == scenes["without"]
    assert found["of_file"]["ball"] == {"k": 0.2, "g": 0.04}


def test_a_number_with_an_exponent_needs_no_point(tmp_path):
    path = tmp_path / "config.yaml"
    path.write_text(json.dumps(good()).replace('"energy": 0.01', '"energy": 1e-2'))
    assert config.load(path).scenes == config.check(good()).scenes


def test_an_added_scene_changes_no_path():
    document = good()
    before = config.check(document).datasets
    assert before["paper", "a_closeup", "periodic"] == "results/paper/periodic_a_closeup.nc"
    twin = {"a": document["scenes"]["a_closeup"]}
    document["scenes"] = twin | document["scenes"] | {"z": twin["a"]}
    after = config.check(document).datasets
    assert after["paper", "a", "periodic"] == "results/paper/periodic_a.nc"
    assert before.items() <= after.items()
