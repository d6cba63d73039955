"""The workflow file for GitHub is valid by the published schema, and runs our commands."""

import re

import pytest
import yaml
from project import ROOT, check_jsonschema

FILE = ROOT / ".github" / "workflows" / "reproduce.yml"


def test_it_is_valid():
    status, output = check_jsonschema("--builtin-schema", "vendor.github-workflows", FILE)
    assert status == 0, output


@pytest.mark.parametrize(("job", "more"), [("reproduce", []), ("nightly", ["test -m slow"])])
def test_a_job_runs_what_the_readme_says(job, more):
    steps = yaml.safe_load(FILE.read_text(encoding="utf-8"))["jobs"][job]["steps"]
    commands = [step["run"] for step in steps if "run" in step]
    options = ["", " verify", " test", *(f" {each}" for each in more)]
    assert commands == [f"./reproduce{option}" for option in options]


def test_every_action_is_one_commit():
    uses = re.findall(r"uses: (\S+)(.*)", FILE.read_text(encoding="utf-8"))
    assert len(uses) >= 5
    assert all(re.fullmatch(r"[\w/-]+@[0-9a-f]{40}", a) and "# v" in b for a, b in uses)
