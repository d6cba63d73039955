"""Examples in docstrings are true, and docstrings name the parameters of the code."""

import doctest
import importlib
import inspect
import pkgutil
import re

import pytest
from slowly import slowly

import pseudorigid
import study
from pipeline.config.schema.kinds import KINDS
from pipeline.config.schema.stages import METHODS, STAGES, upstream
from pipeline.declaration import extensions

STUDY_PACKAGES = {"heyoka", "pynamicalsys"}
EXTENSIONS = [importlib.import_module(f"extensions.{name}") for name in extensions()]
MODULES = [
    info.name
    for package in (pseudorigid, study, *EXTENSIONS)
    for info in pkgutil.walk_packages(package.__path__, f"{package.__name__}.")
]
DRAWN = [kind for kind in KINDS.values() if kind.model_fields["formats"].default]
STAGE_FUNCTIONS = {STAGES[name].function for kind in DRAWN for name in upstream(kind.stages)}
STAGE_FUNCTIONS |= {function for stages in METHODS.values() for function in stages.values()}
PUBLIC = {
    f"{package.__name__}.{name}"
    for package in (pseudorigid, *EXTENSIONS)
    for name in getattr(package, "__all__", ())
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
DEAR = {"study.bench", "extensions.families.shares", "extensions.proofs.theorems.scenes"}
DEAR &= {*MODULES}


@pytest.mark.parametrize("name", [*(n for n in MODULES if n not in DEAR), *slowly(*sorted(DEAR))])
def test_examples_are_true(name):
    assert doctest.testmod(load(name), optionflags=doctest.NORMALIZE_WHITESPACE).failed == 0


@pytest.mark.parametrize("path", sorted(STAGE_FUNCTIONS | PUBLIC))
def test_stages_and_public_functions_are_documented(path):
    """Public ones have parameters, which are the code's, and returned values.

    Stages of pictures that a ball decides have an example.
    """
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
    if path in STAGE_FUNCTIONS and "ball" in inspect.signature(function).parameters:
        assert any(test.examples for test in doctest.DocTestFinder().find(function))
