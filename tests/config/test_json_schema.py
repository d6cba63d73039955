"""config.schema.json accepts config.yaml and refuses mistakes in one value."""

import subprocess
import sys
from pathlib import Path

import pytest
from slowly import slowly

from pipeline.config import json_schema
from pipeline.config.reference import example
from pipeline.config.schema.kinds import KINDS
from pipeline.records.sources import ROOT


def _accepted(text: str, folder: Path) -> tuple[bool, str]:
    """Return whether check-jsonschema accepts a config, and what it prints."""
    pytest.importorskip("check_jsonschema")
    (folder / "config.yaml").write_text(text)
    command = [sys.executable, "-m", "check_jsonschema", "--schemafile", ROOT / json_schema.FILE]
    run = subprocess.run(
        [*command, folder / "config.yaml"], check=False, capture_output=True, text=True
    )
    return run.returncode == 0, run.stdout


def test_the_committed_schema_is_up_to_date():
    assert (ROOT / json_schema.FILE).read_text() == json_schema.text()


def test_the_config_and_the_example_of_each_kind_are_accepted(tmp_path):
    text = (ROOT / "tests" / "scenes.yaml").read_text()
    for kind in KINDS:
        block = "".join(f"    {line}\n" for line in example(kind).splitlines())
        text = text.replace("scenes:\n", f"scenes:\n  another_{kind}:\n{block}", 1)
    accepted, output = _accepted(text, tmp_path)
    assert accepted, output


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        ("elevation: 40", "elevatoin: 40", "elevatoin"),
        ("elevation: 40", "elevation: 400", "400"),
        *slowly(
            ("\nscenes:", "\nscnes:", "scnes"),
            ("picture: portrait", "picture: portrayed", "portrayed"),
            ("impacts: 200000", "impacts: '200000'", "200000"),
            ("scenes:\n", "scenes:\n  -x: {picture: portrait}\n", "-x"),
            ("sweeps:", "sweeps:\n  s: {k: [0.2], energy: [1], starts: 0}\nothers:", "others"),
        ),
    ],
)
def test_a_mistake_is_refused_and_named(tmp_path, old, new, named):
    text = (ROOT / "tests" / "scenes.yaml").read_text()
    assert old in text
    accepted, output = _accepted(text.replace(old, new, 1), tmp_path)
    assert not accepted
    assert named in output
