"""The workflow files for GitHub are valid by the published schema, and pin their actions."""

import re

import pytest
import yaml

from helpers.project import ROOT, check_jsonschema, run

FILES = sorted((ROOT / ".github" / "workflows").glob("*.yml"))


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_it_is_valid(file):
    status, output = check_jsonschema("--builtin-schema", "vendor.github-workflows", file)
    assert status == 0, output


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_every_action_is_one_commit(file):
    uses = re.findall(r"uses: (\S+)(.*)", file.read_text(encoding="utf-8"))
    assert len(uses) >= 3
    assert all(re.fullmatch(r"[\w/-]+@[0-9a-f]{40}", a) and "# v" in b for a, b in uses)


def test_each_push_tries_the_newest_python_and_a_mac_blocks_nothing():
    """`reproduce` says which Pythons there are."""
    newest = re.search(r"needs Python 3\.\d+ to (3\.\d+)", (ROOT / "reproduce").read_text())[1]
    jobs = yaml.safe_load((ROOT / ".github/workflows/reproduce.yml").read_text())["jobs"]
    machines = jobs["reproduce"]["strategy"]["matrix"]["include"]
    assert newest in [machine.get("python") for machine in machines]
    assert all(m.get("may_fail", False) == m["runner"].startswith("macos") for m in machines)
    assert newest == jobs["pythons"]["strategy"]["matrix"]["python"][-1]
    assert {"run": ".ci/run"} in jobs["nightly"]["steps"]


@pytest.mark.parametrize(("skipped", "status"), [("needs the extension atlas", 0), ("no fish", 1)])
def test_the_check_of_everything_fails_on_an_unexpected_skip(tmp_path, skipped, status):
    end = (ROOT / ".ci/run").read_text().partition("say 'skipped tests")[2]
    (tmp_path / "tests").write_text(f"SKIPPED [1] tests/pipeline/cli/test_a.py:3: {skipped}\n")
    program = f"set -euo pipefail\nscratch={tmp_path}\nsay() {{ :; }}\nsay 'skipped tests{end}"
    result = run("bash", "-c", program)
    assert (result.returncode, skipped in result.stdout) == (status, bool(status)), result.stdout
