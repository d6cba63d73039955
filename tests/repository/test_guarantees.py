"""The table of guarantees names tests that exist."""

import re

import pytest
from project import ROOT

TESTS = ROOT / "tests"
TABLE = (TESTS / "README.md").read_text(encoding="utf-8").partition("| Guarantee |")[2]
NAMED = re.findall(r"`((?:\w+/)+test_\w+\.py)(?:::(\w+))?`", TABLE)


@pytest.mark.parametrize(("file", "test"), sorted(set(NAMED)))
def test_a_named_test_exists(file, test):
    if file.startswith("extensions/") and not (TESTS / "extensions").is_dir():
        pytest.skip("no extensions here")
    assert f"\ndef test_{test.removeprefix('test_')}" in (TESTS / file).read_text(encoding="utf-8")
