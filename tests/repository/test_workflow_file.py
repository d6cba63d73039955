"""The workflow file for GitHub: valid by the published schema, pinned, and our two commands."""

import copy
import json
import re

import jsonschema
import pytest
import yaml
from project import ROOT

FILE = ROOT / ".github" / "workflows" / "reproduce.yml"
SCHEMA = json.loads((ROOT / "tests" / "schemas" / "github-workflows.json").read_text())


def parsed():
    """The file; YAML 1.1 takes its key `on` for a truth value."""
    document = yaml.safe_load(FILE.read_text(encoding="utf-8"))
    return {"on" if key is True else key: value for key, value in document.items()}


def valid(document):
    validator = jsonschema.validators.validator_for(SCHEMA)
    validator.check_schema(SCHEMA)
    return validator(SCHEMA).is_valid(document)


def test_it_is_valid():
    assert valid(parsed())


@pytest.mark.parametrize("spoil", ["runs-on", "steps", "timeout-minutes", "strategy"])
def test_what_is_not_valid_is_seen(spoil):
    document = copy.deepcopy(parsed())
    document["jobs"]["reproduce"][spoil] = {"runs-on": 3, "steps": [], "strategy": []}.get(
        spoil, "x"
    )
    assert not valid(document)


def test_one_job_on_two_processors_runs_what_the_readme_says():
    (job,) = parsed()["jobs"].values()
    assert job["strategy"]["matrix"]["runner"] == ["ubuntu-24.04", "ubuntu-24.04-arm"]
    assert job["runs-on"] == "${{ matrix.runner }}"
    assert [step["run"] for step in job["steps"] if "run" in step] == [
        "./reproduce",
        "./reproduce verify",
    ]
    (cache,) = (step for step in job["steps"] if "actions/cache@" in step.get("uses", ""))
    assert cache["with"]["path"].split() == ["results", job["env"]["UV_CACHE_DIR"]]
    hashed = re.findall(r"'([^']+)'", cache["with"]["key"])
    assert hashed and all(list(ROOT.glob(pattern)) for pattern in hashed)


def test_actions_are_pinned_to_commits():
    used = re.findall(r"uses: (\S+)(.*)", FILE.read_text(encoding="utf-8"))
    assert len(used) == 2
    for action, comment in used:
        assert re.fullmatch(r"actions/\w+@[0-9a-f]{40}", action), action
        assert re.fullmatch(r"  # v\d+\.\d+\.\d+", comment), comment
