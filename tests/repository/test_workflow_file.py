"""The workflow file for GitHub is valid by the published schema, and pins its actions."""

import re

from project import ROOT, check_jsonschema

FILE = ROOT / ".github" / "workflows" / "reproduce.yml"


def test_it_is_valid():
    status, output = check_jsonschema("--builtin-schema", "vendor.github-workflows", FILE)
    assert status == 0, output


def test_every_action_is_one_commit():
    uses = re.findall(r"uses: (\S+)(.*)", FILE.read_text(encoding="utf-8"))
    assert len(uses) >= 5
    assert all(re.fullmatch(r"[\w/-]+@[0-9a-f]{40}", a) and "# v" in b for a, b in uses)
