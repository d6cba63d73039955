"""Examples in docstrings are true."""

import doctest
import importlib
import pkgutil
from pathlib import Path

import pytest
from slowly import slowly

import pseudorigid
from pipeline.declaration import files
from pipeline.records.sources import SRC

PARTS = [importlib.import_module(package) for package in files("__init__.py")]
MODULES = [
    info.name
    for package in (pseudorigid, *PARTS)
    for info in pkgutil.walk_packages(package.__path__, f"{package.__name__}.")
    if not info.ispkg and ">>> " in Path(SRC, *info.name.split(".")).with_suffix(".py").read_text()
]
# Examples that take longest; the stages behind them have tests of their own.
DEAR = {"extensions.families.families", "extensions.families.shares"}
DEAR |= {"extensions.claims.analyses.control", "extensions.proofs.theorems.scenes"}
DEAR &= {*MODULES}


@pytest.mark.parametrize("name", [*(n for n in MODULES if n not in DEAR), *slowly(*sorted(DEAR))])
def test_examples_are_true(name):
    module = importlib.import_module(name)
    assert doctest.testmod(module, optionflags=doctest.NORMALIZE_WHITESPACE).failed == 0
