"""The list of planted faults fits the sources and the tests; tests/faults/run.py plants them."""

import ast
import tomllib

import pytest

from helpers.project import ROOT

FAULTS = tomllib.loads((ROOT / "tests/faults/faults.toml").read_text(encoding="utf-8"))["fault"]
# Those of a deleted part are not looked at.
HERE = [
    f for f in FAULTS if all((ROOT / f[at].partition("::")[0]).is_file() for at in ("file", "test"))
]


@pytest.mark.parametrize("name", sorted({fault["file"] for fault in HERE}))
def test_each_fault_has_its_place_and_its_test(name):
    text = (ROOT / name).read_text(encoding="utf-8")
    for fault in (fault for fault in HERE if fault["file"] == name):
        assert text.count(fault["old"]) == 1 and fault["new"] != fault["old"], fault
        if name.endswith(".py"):  # a fault that breaks the syntax shows nothing
            ast.parse(text.replace(fault["old"], fault["new"]))
        file, _, function = fault["test"].partition("::")
        assert f"def {function.partition('[')[0]}" in (ROOT / file).read_text(encoding="utf-8"), (
            fault
        )
