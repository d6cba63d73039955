"""Examples in docstrings are true."""

import doctest
import importlib
import pkgutil
from pathlib import Path

import pytest

import pseudorigid
from helpers.slowly import slowly
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
DEAR = {"extensions.families.dataset", "extensions.families.shares"}
DEAR |= {"extensions.claims.analyses.control", "extensions.proofs.theorems.scenes"}
DEAR &= {*MODULES}


@pytest.mark.parametrize("name", [*(n for n in MODULES if n not in DEAR), *slowly(*sorted(DEAR))])
def test_examples_are_true(name):
    """Those of the Python API are as a user types them: they import what they use."""
    module = importlib.import_module(name)
    runner = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE)
    for test in doctest.DocTestFinder(exclude_empty=True).find(module, name):
        documented = test.name.removeprefix(f"{name}.").partition(".")[0]
        if getattr(pseudorigid, documented, None) is getattr(module, documented, ...):
            test.globs.clear()
        runner.run(test)
    assert runner.tries > 0 and runner.failures == 0
