"""The workflow file for GitHub is valid by the published schema, pinned, and runs our commands."""

import re

import yaml
from project import ROOT, check_jsonschema

FILE = ROOT / ".github" / "workflows" / "reproduce.yml"
JOB = yaml.safe_load(FILE.read_text(encoding="utf-8"))["jobs"]["reproduce"]


def test_it_is_valid():
    status, output = check_jsonschema("--builtin-schema", "vendor.github-workflows", FILE)
    assert status == 0, output


def test_the_job_runs_on_two_processors_what_the_readme_says():
    assert JOB["strategy"]["matrix"]["runner"] == ["ubuntu-24.04", "ubuntu-24.04-arm"]
    assert JOB["runs-on"] == "${{ matrix.runner }}"
    commands = [step["run"] for step in JOB["steps"] if "run" in step]
    assert commands == ["./reproduce", "./reproduce verify", "./reproduce test"]


def test_downloads_and_results_are_cached():
    caches = [step["with"] for step in JOB["steps"] if "actions/cache@" in step.get("uses", "")]
    assert [cache["path"] for cache in caches] == [JOB["env"]["UV_CACHE_DIR"], "results"]
    for cache in caches:
        hashed = re.findall(r"'([^']+)'", cache["key"])
        assert hashed and all(list(ROOT.glob(pattern)) for pattern in hashed)


def test_actions_are_pinned_to_commits():
    used = re.findall(r"uses: (\S+)(.*)", FILE.read_text(encoding="utf-8"))
    assert len(used) == 3
    for action, comment in used:
        assert re.fullmatch(r"actions/\w+@[0-9a-f]{40}", action), action
        assert re.fullmatch(r"  # v\d+\.\d+\.\d+", comment), comment
