"""Any file named config.yaml is a correct config or is refused in lines that name it."""

import json
import os
import re
import sys

import pytest
import yaml
from hypothesis import example, given, settings
from hypothesis import strategies as st

from helpers.documents import changed, complaint, complaints, good
from helpers.project import SHIPPED, run, shipped
from helpers.random_documents import FUZZ, JSON, edited, in_yaml, spoilt
from pipeline import config
from pipeline.config.schema.parts import MAIN, SETS
from pipeline.config.validation import document
from pipeline.declaration import ONLY_SET, SRC


@pytest.mark.parametrize("document", [None, [], "text", 3, {}, {"ball": {}, "scenes": []}])
def test_something_else_than_a_config_is_refused(document):
    assert complaints(document)


@pytest.mark.parametrize(("text", "part"), [
    (b"", "is empty"),
    (b"\n# only a comment\n", "is empty"),
    (b"---\n", "nothing is not allowed"),
    (b"ball:\n\tk: 0.2", "config.yaml: line 2: begins with a tab: indent it with spaces"),
    (b"ball: {k: 0.2\nscenes: [", "line 2, column"),
    (b"ball: {k: 0.2}\nball: {k: 0.3}", "line 2, column 1: not valid YAML: the key ball"),
    (b"ball: \xff", "not UTF-8"),
    (b"ball: !!python/object:os.system x", "not valid YAML"),
    (b"ball: 2001-99-99", "not valid YAML"),
    (b"--- 1\n--- 2\n", "not valid YAML"),
    (b"ball: &a [*a]\nscenes: {}", "ball: "),
    (b"? {a: 1}\n: 3", "line 1, column 3: not valid YAML: found unhashable key"),
    (b"ball: " + b"{k: " * 3000, "config.yaml: nested too deeply"),
    (None, "config.yaml: cannot be read: No such file"),
])  # fmt: skip
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


# The variant's view overrides a key that it merges, and a scene merges it, which is read before it.
OVERRIDING = """
ball: {k: 0.2, g: 0.04}
variants: {low: {scenes: {a: {view: &v {<<: {elevation: 9}, elevation: 1, azimuth: 2}}}}}
scenes:
  a: &a {picture: portrait, energy: 0.01, starts: [0.5], impacts: 9}
  b: {<<: *a, view: {<<: *v}}
"""


def test_anchors_merges_and_tags_say_what_they_stand_for(tmp_path):
    path, meant = tmp_path / "config.yaml", yaml.safe_load(OVERRIDING)

    @settings(FUZZ, max_examples=10)
    @example(text=OVERRIDING)
    @given(text=in_yaml(meant))
    def trial(text):
        path.write_text(text)
        assert config.load(path).scenes == config.check(meant).scenes

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


@pytest.mark.parametrize(
    ("text", "value"),
    [("012", 10), ("-0_7", -7), ("00", 0), ("1:30", 90), ("1:30.5", 90.5)]
    + [(word, str(word.lower() in ("yes", "on")).lower()) for word in ("yes", "No", "ON", "off")],
)
def test_a_value_that_yaml_takes_for_another_one_is_refused_with_a_hint(tmp_path, text, value):
    """Also in a list and in a block of a part; in quotes it is a text, as in `formats`."""
    path = tmp_path / "config.yaml"
    for line in ("ball: {k: %s, g: 0.04}", "ball: {k: 0.2, g: 0.04}\nclaims: {a: [%s]}"):
        path.write_text(f"{line % text}\nscenes: {{}}\n")
        with pytest.raises(config.ConfigError) as raised:
            config.load(path)
        words = f"{text} means {value} in YAML 1.1: write {value} or what you mean; a text is"
        pattern = rf"config\.yaml: line [12], column \d+: {re.escape(words)} '{text}', in quotes"
        assert re.fullmatch(pattern, str(raised.value))
    path.write_text(f"ball: {{k: '{text}', g: 0.04}}\nscenes: {{}}\n")
    with pytest.raises(config.ConfigError, match=f"ball.k: '{text}' is not allowed"):
        config.load(path)


@pytest.mark.parametrize("key", ["yes", "NO", "012", "1", "1:30", "null", "~", "2001-01-01", "1.5"])
def test_a_key_that_is_no_text_to_yaml_is_refused_with_a_hint(tmp_path, key):
    path = tmp_path / "config.yaml"
    path.write_text(f"ball: {{k: 0.2, g: 0.04}}\nscenes:\n  {key}: {{picture: motion}}\n")
    words = f"line 3, column 3: the key {key} is no text in YAML 1.1: write '{key}'"
    with pytest.raises(config.ConfigError, match=re.escape(words)):
        config.load(path)


DOCUMENT = """\
ball: {k: 0.2, g: 0.04}
scenes:
  fig2: &fig2
    picture: portrait
    energy: 0.01
    starts: [0.1,
             0.2,
             STARTS]
    impacts: 10
    view: {elevation: 40,
           azimuth: AZIMUTH}
  again:
    <<: *fig2
    impacts: IMPACTS
variants:
  low:
    energy: ENERGY
    scenes:
      fig2:
        impacts: VARIED
      SCENE: {impacts: 3}
KEY:
  SPREAD: {picture: spread, ENERGIES: 0.01}
"""
VALUES = {
    "STARTS": 0.3, "AZIMUTH": 115, "IMPACTS": 10, "ENERGY": 0.009, "VARIED": 20, "SCENE": "again",
    "KEY": "variants2", "\n  SPREAD: {picture: spread, ENERGIES: 0.01}": "",
}  # fmt: skip


@pytest.mark.parametrize(("mark", "value", "words"), [
    ("STARTS", 3, "line 8: scenes.fig2.starts[2]: 3 is not allowed"),
    ("AZIMUTH", "x", "line 11: scenes.fig2.view.azimuth: 'x' is not allowed"),
    ("IMPACTS", "-1", "line 14: scenes.again.impacts: -1 is not allowed"),
    ("    energy: 0.01\n", "", "line 3: scenes.fig2.energy: missing"),
    ("fig2: &fig2", "a b: &fig2", "line 3: scenes: 'a b' is not allowed"),
    ("  again:", "  list:", "line 12: scenes: 'list' is not allowed"),
    ("ENERGY", 9, "line 17: variants.low.energy: 9 is not allowed"),
    ("VARIED", 0, "line 20: variants.low.scenes.fig2.impacts: 0 is not allowed"),
    ("SCENE", "fog2", "line 21: variants.low.scenes.fog2: no scene fog2"),
    ("  low:", "  paper:", "line 16: variants: 'paper' is not allowed"),
    ("energy: ENERGY", "values: {ball.g: [0.03,\n    0.3]}",
     "line 18: variants.low.values.ball.g[1]: 0.3 is not allowed"),
    ("KEY", "scnes", "line 22: scnes: unknown key: did you mean scenes?"),
    ("ball: {k: 0.2, g: 0.04}", "", "ball: missing"),
    (DOCUMENT, "[]", "[] is not allowed: expected a mapping with the keys ball and scenes\n"),
])  # fmt: skip
def test_a_mistake_names_the_line_of_its_key(tmp_path, mark, value, words):
    """In mappings, lists, variants and what `<<` repeats."""
    text = DOCUMENT.replace(mark, str(value))
    for name, good_value in VALUES.items():
        text = text.replace(name, str(good_value))
    if mark != "KEY":
        text = text.replace("variants2:", "")
    path = tmp_path / "config.yaml"
    path.write_text(text)
    try:
        lines = [line for lines in config.load(path).faulty.values() for line in lines]
    except config.ConfigError as error:
        lines = error.lines
    assert f"{lines[0]}\n".startswith(f"config.yaml: {words}")
    if mark == "STARTS":  # repeated below
        assert lines[1].startswith("config.yaml: line 8: scenes.again.starts[2]")


def test_a_mistake_in_a_block_of_a_part_says_what_it_concerns(tmp_path, monkeypatch):
    """It stops every command. Shipped blocks have files of their own."""
    sets = [each for name, each in SETS.items() if each.key and name != MAIN]
    path = tmp_path / "config.yaml"
    for each in sets:
        path.write_text(f"{SHIPPED.read_text()}{each.key}:\n  mine: {{picture: nothing}}\n")
        with pytest.raises(config.ConfigError) as raised:
            config.load(path)
        (line,) = raised.value.lines
        number = len(path.read_text().splitlines())
        assert line.startswith(f"config.yaml: line {number}: {each.key}.mine.picture: 'nothing'")
        assert line.endswith(f" (this concerns {each.command} alone)")
        shipped_file = tmp_path / "scenes.yaml"
        shipped_file.write_text(f"{each.key}:\n  mine: {{picture: nothing}}\n")
        monkeypatch.setattr(document, "files", lambda name, file=shipped_file: {"part": file})
        with pytest.raises(config.ConfigError, match=r"scenes\.yaml: line 2: \w+\.mine\.picture"):
            config.load(SHIPPED)
        monkeypatch.undo()


def test_a_run_of_the_paper_reads_its_set_alone_with_the_same_specifications(tmp_path):
    program = (
        "import json, sys; from pipeline.config import MAIN, load; made = load(sys.argv[1])\n"
        "parts = [name for name in sys.modules if name.endswith('.kinds')]\n"
        "print(json.dumps([made.build_specs([MAIN]), [*made.variants], parts]))"
    )

    def loaded(document, **environment):
        (file := tmp_path / "config.yaml").write_text(json.dumps(document))
        environment = os.environ | environment | {"PYTHONPATH": str(SRC)}
        return run(sys.executable, "-P", "-c", program, file, env=environment)

    given = yaml.safe_load(SHIPPED.read_text())
    whole, alone = (json.loads(loaded(given, **env).stdout) for env in ({}, {ONLY_SET: MAIN}))
    assert alone[0] == whole[0] and {*alone[1]} < {*whole[1]}
    assert {"pipeline.config.schema.kinds", "paper.kinds"} == {*alone[2]} <= {*whole[2]}
    others = [each.key for each in SETS.values() if each.key and each.key != "scenes"]
    wrong = given | {key: {"x": {"picture": "y"}} for key in others}  # what a user wrote
    refused = loaded(wrong, **{ONLY_SET: MAIN}).stderr
    assert all(f"{key}.x.picture: 'y' is not allowed" in refused for key in others)


def test_a_long_value_is_cut_to_sixty_characters_and_no_shorter_one():
    for size, shown in ((58, f"'{'x' * 58}'"), (59, f"'{'x' * 56}...")):
        words = f"scenes.a_portrait.energy: {shown} is not allowed"
        assert complaint(changed("scenes.a_portrait.energy", "x" * size)).startswith(words)
