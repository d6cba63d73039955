"""Examples in docstrings are true, and docstrings name the parameters of the code."""

import doctest
import importlib
import inspect
import pkgutil
import re

import pytest
from slowly import slowly

import pseudorigid
from pipeline.config.schema.stages import STAGES
from pseudorigid import proofs

STUDY_PACKAGES = {"heyoka", "pynamicalsys"}
MODULES = [info.name for info in pkgutil.walk_packages(pseudorigid.__path__, "pseudorigid.")]
STAGE_FUNCTIONS = {
    ".".join(function)
    for stage in STAGES.values()
    for function in ((stage.module, stage.function), stage.exact)
    if function
}
PUBLIC = {
    f"{package.__name__}.{name}" for package in (pseudorigid, proofs) for name in package.__all__
}
PARAMETERS = re.compile(r"^Parameters\n-+\n(.*?)(?=\n\n\w+\n-+\n|\Z)", re.MULTILINE | re.DOTALL)


def load(name):
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        if error.name in STUDY_PACKAGES:
            pytest.skip(f"{name} needs {error.name}: ./reproduce study installs it")
        raise


# Examples that take longest; the stages behind them have tests of their own.
DEAR = {f"pseudorigid.{name}" for name in ("proofs.theorems.scenes", "study.bench", "sweep.shares")}


@pytest.mark.parametrize("name", [*(n for n in MODULES if n not in DEAR), *slowly(*sorted(DEAR))])
def test_examples_are_true(name):
    assert doctest.testmod(load(name), optionflags=doctest.NORMALIZE_WHITESPACE).failed == 0


@pytest.mark.parametrize("path", sorted(STAGE_FUNCTIONS | PUBLIC))
def test_stages_and_public_functions_are_documented(path):
    """Public ones have parameters, which are the code's, and returned values; stages an example."""
    module, _, name = path.rpartition(".")
    function = getattr(load(module), name)
    if callable(function) and path in PUBLIC:
        sections = ["Parameters\n"] if isinstance(function, type) else ["Parameters\n", "Returns\n"]
        assert all(section in function.__doc__ for section in sections)
    if section := PARAMETERS.search(inspect.getdoc(function) or ""):
        rows = re.findall(r"^(\S.*?)(?: :|$)", section[1], re.MULTILINE)
        documented = ", ".join(rows).replace("*", "").split(", ")
        names = inspect.signature(function).parameters
        assert documented == [name for name in names if not name.startswith("_")]
    if path in STAGE_FUNCTIONS:
        assert any(test.examples for test in doctest.DocTestFinder().find(function))
