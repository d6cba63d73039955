"""The workflow files for GitHub are valid by the published schema, and pin their actions."""

import re

import pytest
from project import ROOT, check_jsonschema

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
