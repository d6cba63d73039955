"""Examples in docstrings are true, and docstrings name the parameters of the code."""

import ast
import doctest
import importlib
import pkgutil
import re

import pytest
from project import ROOT
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
    """Public ones have parameters and returned values; a stage has an example."""
    module, _, name = path.rpartition(".")
    function = getattr(load(module), name)
    if callable(function) and path in PUBLIC:
        sections = ["Parameters\n"] if isinstance(function, type) else ["Parameters\n", "Returns\n"]
        assert all(section in function.__doc__ for section in sections)
    if path in STAGE_FUNCTIONS:
        assert any(test.examples for test in doctest.DocTestFinder().find(function))


def signatures(tree):
    """Yield (name, parameters, docstring) of functions; a class has the parameters of __init__."""
    for node in ast.walk(tree):
        body = node.body if isinstance(node, ast.ClassDef) else [node]
        for function in body:
            initial = getattr(function, "name", "") == "__init__"
            if isinstance(function, ast.FunctionDef) and (initial or function is node):
                args = function.args
                every = [*args.posonlyargs, *args.args, args.vararg, *args.kwonlyargs, args.kwarg]
                names = [a.arg for a in every if a and a.arg not in ("self", "cls")]
                yield node.name, names, ast.get_docstring(node) or ""


def test_docstrings_name_the_parameters_of_the_code():
    wrong, seen = [], 0
    for file in sorted((ROOT / "src").rglob("*.py")):
        for name, names, text in signatures(ast.parse(file.read_text())):
            if section := PARAMETERS.search(text):
                seen += 1
                rows = re.findall(r"^(\S.*?)(?: :|$)", section[1], re.MULTILINE)
                documented = ", ".join(rows).replace("*", "").split(", ")
                if documented != names:
                    wrong.append(f"{file.name}: {name}: {documented}, not {names}")
    assert seen > 10
    assert not wrong, "\n".join(wrong)
