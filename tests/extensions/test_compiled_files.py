"""Committed files of code for other processors: made from this kernel, and the same made again."""

import hashlib
import json
import re

import pytest

from extensions.atlas.gpu import run
from extensions.explorer import page
from pipeline.processors.build import compiled

FILES = {file.path.name: file for file in (page.KERNEL, run.KERNEL)}


@pytest.mark.parametrize("name", FILES)
def test_a_file_is_the_recorded_one(name):
    """Renew both by .venv/bin/python -m pipeline.renew."""
    file = FILES[name]
    recorded = json.loads(file.record_path.read_text())
    assert recorded["sources"] == file.record()["sources"] and file.is_current()
    assert recorded["sha256"] == hashlib.sha256(file.path.read_bytes()).hexdigest()


@pytest.mark.slow
@pytest.mark.parametrize("name", FILES)
def test_a_file_is_compiled_again_to_the_same_bytes(name):
    file = FILES[name]
    if json.loads(file.record_path.read_text())["environment"] != file.record()["environment"]:
        pytest.skip("other versions of numba or llvmlite made the file")
    assert compiled(file.module, file.target) == file.path.read_bytes()


def test_arithmetic_on_a_card_is_rounded_once_and_calls_nothing_from_elsewhere():
    code = run.KERNEL.path.read_text()
    assert not re.search(
        r"\bfma|\.approx|\.ftz|\.extern|\bmad\.\S*f64|picklebuf|/", re.sub("//.*", "", code)
    )
    rounded = re.findall(r"\s((?:add|sub|mul|div|rcp|sqrt)\.\S*f64)\s", code)
    assert len(rounded) > 500 and all(each.split(".")[1] == "rn" for each in rounded)
    known = {"abs", "neg", "selp", "setp", "cvt", *(each.split(".")[0] for each in rounded)}
    assert {each.split(".")[0] for each in re.findall(r"\s([a-z]\S*\.f64)\s", code)} <= known
    called = {*re.findall(r"call.*?\), (\S+),", code)}
    assert called <= {*re.findall(r"\.func .*?\) (\S+)\(", code)}
    assert {*re.findall(r"\.entry (\w+)", code)} == {"classify", "advance", "elementary"}
