"""The table of guarantees names tests that exist."""

import re

import pytest
from project import ROOT

TESTS = ROOT / "tests"
TABLE = (TESTS / "README.md").read_text(encoding="utf-8").partition("| Guarantee |")[2]
NAMED = re.findall(r"`((?:\w+/)+test_\w+\.py)(?:::(\w+))?`", TABLE)


def test_each_guarantee_names_a_test():
    rows = [line for line in TABLE.splitlines()[2:] if line.startswith("|")]
    assert [row for row in rows if "/test_" not in row and "`.ci/" not in row] == []


@pytest.mark.parametrize(("file", "test"), sorted(set(NAMED)))
def test_a_named_test_exists(file, test):
    if file.startswith("extensions/") and not (TESTS / "extensions").is_dir():
        pytest.skip("no extensions here")
    assert f"\ndef test_{test.removeprefix('test_')}" in (TESTS / file).read_text(encoding="utf-8")
