"""Committed files of code for other processors: made from this kernel, and the same made again."""

import hashlib
import json

import pytest

from extensions.processors.build import compiled
from pipeline.declaration import parts

FILES = {}
if "atlas" in parts():
    from extensions.atlas.gpu import run

    FILES["kernel.ptx"] = run.KERNEL
if "explorer" in parts():
    from extensions.explorer import page

    FILES["kernel.wasm"] = page.KERNEL


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
