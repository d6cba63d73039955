"""The workflow file for GitHub is valid by the published schema, and runs our commands."""

import yaml
from project import ROOT, check_jsonschema

FILE = ROOT / ".github" / "workflows" / "reproduce.yml"


def test_it_is_valid():
    status, output = check_jsonschema("--builtin-schema", "vendor.github-workflows", FILE)
    assert status == 0, output


def test_the_job_runs_what_the_readme_says():
    steps = yaml.safe_load(FILE.read_text(encoding="utf-8"))["jobs"]["reproduce"]["steps"]
    commands = [step["run"] for step in steps if "run" in step]
    assert commands == ["./reproduce", "./reproduce verify", "./reproduce test"]
