"""The examples in docstrings, run; each stage has one."""

import doctest
import importlib
import pkgutil

import pytest

import pseudorigid
from pipeline.config.declared.stages import STAGES

# What only the study's own packages bring.
RIVALS = {"heyoka", "pynamicalsys"}
MODULES = [found.name for found in pkgutil.walk_packages(pseudorigid.__path__, "pseudorigid.")]


def loaded(name):
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        if error.name in RIVALS:
            pytest.skip(f"{name} needs {error.name}: ./reproduce study installs it")
        raise


@pytest.mark.parametrize("name", MODULES)
def test_examples_are_true(name):
    found = doctest.testmod(loaded(name), optionflags=doctest.NORMALIZE_WHITESPACE)
    assert found.failed == 0


@pytest.mark.parametrize("stage", STAGES)
def test_each_stage_has_an_example(stage):
    module = loaded(STAGES[stage].module)
    examples = [test for test in doctest.DocTestFinder().find(module) if test.examples]
    assert examples
