"""Docstrings: their examples are true, each stage has one, and parameters are those of the code."""

import ast
import doctest
import importlib
import pkgutil
import re

import pytest
from project import ROOT

import pseudorigid
from pipeline.config.schema.stages import STAGES
from pseudorigid import proofs

# What only the study's own packages bring.
RIVALS = {"heyoka", "pynamicalsys"}
MODULES = [found.name for found in pkgutil.walk_packages(pseudorigid.__path__, "pseudorigid.")]
STAGE_FUNCTIONS = {
    f"{place[0]}.{place[1]}"
    for stage in STAGES.values()
    for place in ((stage.module, stage.function), stage.exact)
    if place
}
EXPORTED = {
    f"{package.__name__}.{name}" for package in (pseudorigid, proofs) for name in package.__all__
}
PARAMETERS = re.compile(r"^Parameters\n-+\n(.*?)(?=\n\n\w+\n-+\n|\Z)", re.MULTILINE | re.DOTALL)


def loaded(name):
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        if error.name in RIVALS:
            pytest.skip(f"{name} needs {error.name}: ./reproduce study installs it")
        raise


def named(path):
    """What a dotted path names."""
    module, _, name = path.rpartition(".")
    return getattr(loaded(module), name)


@pytest.mark.parametrize("name", MODULES)
def test_examples_are_true(name):
    found = doctest.testmod(loaded(name), optionflags=doctest.NORMALIZE_WHITESPACE)
    assert found.failed == 0


@pytest.mark.parametrize("path", sorted(STAGE_FUNCTIONS))
def test_each_stage_has_an_example(path):
    assert any(test.examples for test in doctest.DocTestFinder().find(named(path)))


@pytest.mark.parametrize("path", sorted(STAGE_FUNCTIONS | EXPORTED))
def test_what_others_call_says_what_it_takes_and_returns(path):
    thing = named(path)
    if callable(thing):
        sections = ("Parameters\n",) if isinstance(thing, type) else ("Parameters\n", "Returns\n")
        assert all(section in thing.__doc__ for section in sections)


def signatures(tree):
    """(name, parameters, docstring) of the functions in a tree; a class has those of __init__."""
    for node in ast.walk(tree):
        inside = getattr(node, "body", ()) if isinstance(node, ast.ClassDef) else (node,)
        for one in inside:
            start = getattr(one, "name", "") == "__init__"
            if isinstance(one, ast.FunctionDef) and (start or one is node):
                given = one.args
                every = [*given.posonlyargs, *given.args, given.vararg, *given.kwonlyargs]
                names = [a.arg for a in (*every, given.kwarg) if a and a.arg not in ("self", "cls")]
                yield node.name, names, ast.get_docstring(node) or ""


def test_docstrings_name_the_parameters_of_the_code():
    wrong, seen = [], 0
    for file in sorted((ROOT / "src").rglob("*.py")):
        for name, names, text in signatures(ast.parse(file.read_text())):
            if section := PARAMETERS.search(text):
                seen += 1
                rows = re.findall(r"^\S.*", section[1], re.MULTILINE)
                said = (
                    ", ".join(row.partition(" :")[0] for row in rows).replace("*", "").split(", ")
                )
                wrong += [f"{file.name}: {name}: {said}, not {names}"] * (said != names)
    assert seen > 100
    assert not wrong, "\n".join(wrong)
