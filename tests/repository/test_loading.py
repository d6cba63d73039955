"""Modules are loaded from their text: a cached .pyc is never run, whatever the times say."""

import hashlib
import os
import py_compile
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from project import NO_CACHES, ROOT

import pseudorigid
from pseudorigid.kernel import arithmetic


@pytest.fixture
def src(tmp_path):
    """A copy of the packages."""
    return shutil.copytree(ROOT / "src", tmp_path / "src", ignore=NO_CACHES)


def says(src, code, **environment):
    """What a new interpreter prints."""
    result = subprocess.run(
        [sys.executable, "-P", "-c", code],
        env=os.environ | {"PYTHONPATH": str(src)} | environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode == 0, result.stderr
    return result.stdout.strip()


def edit_unseen(file, old, new):
    """Edit a file that Python has cached, keeping its size and its times."""
    py_compile.compile(str(file), invalidation_mode=py_compile.PycInvalidationMode.TIMESTAMP)
    text, then = file.read_text(), file.stat()
    assert len(old) == len(new) and text.count(old) == 1
    file.write_text(text.replace(old, new))
    os.utime(file, ns=(then.st_atime_ns, then.st_mtime_ns))


@pytest.mark.parametrize(
    ("module", "name", "old", "new"),
    [
        ("pseudorigid.figures.axes.box", "NEAR", "NEAR = 1", "NEAR = 2"),
        ("pipeline.checks.manifest", "BLOCK", "BLOCK = 1024", "BLOCK = 4096"),
    ],
)
def test_a_stale_pyc_is_not_run(src, module, name, old, new):
    file = src / f"{module.replace('.', '/')}.py"
    if old not in file.read_text():
        file.write_text(f"{file.read_text()}\n{old}\n")
    show = f"import {module} as m; print(m.{name})"
    assert says(src, show) == old.split()[-1]
    edit_unseen(file, old, new)
    assert says(src, show) == new.split()[-1]


def test_a_stale_pyc_does_not_reach_the_machine_code(src, tmp_path):
    """Nor does machine code that was compiled by a process that had loaded an earlier text."""
    file = src / "pseudorigid/kernel/callee.py"
    file.write_text("from .compiled import jit\n\n\n@jit\ndef one():\n    return 1.0\n")
    caller = "from .callee import one\nfrom .compiled import jit\n\n\n@jit\ndef f():\n"
    (src / "pseudorigid/kernel/caller.py").write_text(f"{caller}    return one()\n")
    show = "from pseudorigid.kernel.caller import f; print(f())"
    cache = {"NUMBA_CACHE_DIR": str(tmp_path / "cache")}
    assert says(src, show, **cache) == "1.0"
    edit_unseen(file, "return 1.0", "return 2.0")
    assert says(src, show, **cache) == "2.0"
    # Edited between what names the folder and what compiles, and undone.
    undone = (
        "import pathlib, pseudorigid.kernel.compiled; "
        f"p = pathlib.Path({str(file)!r}); text = p.read_text(); "
        "p.write_text(text.replace('2.0', '3.0')); "
        f"{show}; p.write_text(text)"
    )
    shutil.rmtree(tmp_path / "cache")
    assert says(src, undone, **cache) == "3.0"
    assert says(src, show, **cache) == "2.0"
    # Edited between the import of what is called and of what calls it, and left so.
    shutil.rmtree(tmp_path / "cache")
    between = "import pathlib, pseudorigid.kernel.callee; "
    between += f"p = pathlib.Path({str(file)!r}); p.write_text(p.read_text().replace('2.0', '4.0'))"
    assert says(src, f"{between}; {show}", **cache) == "2.0"
    assert says(src, show, **cache) == "4.0"


def test_a_comment_compiles_nothing_again_and_a_constant_does(src, tmp_path):
    constants = src / "pseudorigid/kernel/constants.py"
    constants.write_text("ONE = 1.0\n")
    caller = "from . import constants\nfrom .compiled import jit\n\nONE = constants.ONE\n\n\n@jit\n"
    (src / "pseudorigid/kernel/caller.py").write_text(f"{caller}def f():\n    return ONE\n")
    show = "from pseudorigid.kernel.caller import f; print(f(), sum(f.stats.cache_hits.values()))"
    cache = {"NUMBA_CACHE_DIR": str(tmp_path / "cache")}
    assert says(src, show, **cache) == "1.0 0"
    assert says(src, show, **cache) == "1.0 1"
    for file in ("caller", "constants", "compiled/__init__", "compiled/locator"):
        path = src / f"pseudorigid/kernel/{file}.py"
        path.write_text(f"# A comment before everything.\n{path.read_text()}")
    assert says(src, show, **cache) == "1.0 1"
    constants.write_text("ONE = 2.0\n")
    assert says(src, show, **cache) == "2.0 0"


def test_what_was_loaded_is_noted():
    file = os.path.realpath(arithmetic.__file__)
    digest = hashlib.sha256(Path(file).read_bytes()).hexdigest()
    assert pseudorigid.LOADED[file] == {digest}
