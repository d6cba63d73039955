"""The page on Python is the long description of the package, and its examples run."""

import doctest
import re

import pseudorigid
from helpers.pages import blocks, text_of

PAGE = "docs/python.md"


def test_its_examples_run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = {}
    for block in blocks(PAGE):
        if ">>> " in block:
            test = doctest.DocTestParser().get_doctest(block, names, PAGE, PAGE, 0)
            assert doctest.DocTestRunner().run(test).failed == 0
        elif not block.startswith("pip "):
            exec(block, names)
    assert names["picture"]._repr_png_()[1:4] == b"PNG"
    assert (tmp_path / "orbits.nc").stat().st_size > 0
    assert names["family"]["energy"].values.tolist() == [0.008, 0.009, 0.01]


def test_it_names_each_function():
    assert all(re.search(rf"\b{name}\b", text_of(PAGE)) for name in pseudorigid.__all__)


def test_it_has_no_link_that_leads_nowhere_on_an_index_of_packages():
    assert not re.search(r"\]\(|<img|!\[", text_of(PAGE))
