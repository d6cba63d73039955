"""The table of guarantees names tests that exist."""

import re

from project import ROOT

TESTS = ROOT / "tests"
TABLE = (TESTS / "README.md").read_text(encoding="utf-8").partition("| Guarantee |")[2]
ROWS = [line.strip("| ").split(" | ") for line in TABLE.splitlines()[2:] if line.startswith("|")]
NAMED = re.compile(r"`((?:\w+/)+test_\w+\.py)(?:::(\w+))?`")


def test_each_row_names_tests_that_exist():
    assert len(ROWS) > 25
    for guarantee, tests in ROWS:
        named = NAMED.findall(tests)
        assert named, guarantee
        for file, test in named:
            if file.startswith("extensions/") and not (TESTS / "extensions").is_dir():
                continue
            text = (TESTS / file).read_text(encoding="utf-8")
            assert f"\ndef {test}(" in text if test else "\ndef test_" in text, (file, test)
            slow = "mark.slow" in text or "slowly(" in text
            assert "slow:" not in tests.partition(file)[0] or slow, file
