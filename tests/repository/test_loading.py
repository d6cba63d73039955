"""The pipeline loads modules from their text: it never runs a cached .pyc, whatever its times."""

import hashlib
import os
import py_compile
import shutil
import sys
from pathlib import Path

import pytest

from helpers.project import NO_CACHES, ROOT, run
from pipeline.loading import LOADED
from pseudorigid.kernel import arithmetic


@pytest.fixture
def src(tmp_path):
    """A copy of the packages."""
    return shutil.copytree(ROOT / "src", tmp_path / "src", ignore=NO_CACHES)


@pytest.fixture
def printed(src, tmp_path):
    """code -> what a new interpreter prints, with a cache of compiled code of its own."""

    def printed(code, first="import pipeline; "):
        own = {"PYTHONPATH": str(src), "NUMBA_CACHE_DIR": str(tmp_path / "cache")}
        result = run(sys.executable, "-P", "-c", first + code, env=os.environ | own)
        assert result.returncode == 0, result.stderr
        return result.stdout.strip()

    return printed


def edit_unseen(file, old, new):
    """Edit a file that Python has cached, keeping its size and its times."""
    py_compile.compile(str(file), invalidation_mode=py_compile.PycInvalidationMode.TIMESTAMP)
    text, times = file.read_text(), file.stat()
    assert len(old) == len(new) and text.count(old) == 1
    file.write_text(text.replace(old, new))
    os.utime(file, ns=(times.st_atime_ns, times.st_mtime_ns))


def test_a_name_of_the_api_is_imported_when_it_is_used(printed):
    loaded = "print(*sorted(m for m in sys.modules if m.startswith('pseudorigid.')))"
    assert printed(f"import sys, pseudorigid; {loaded}", "") == ""
    modules = printed(f"import sys; from pseudorigid import Ball; {loaded}", "").split()
    assert "pseudorigid.dynamics.ball" in modules and "pseudorigid.figures" not in modules


def test_a_stale_pyc_is_not_run(src, printed):
    file = src / "paper/values.py"
    file.write_text(f"{file.read_text()}\nPLANTED = 1\n")
    show = "import paper.values as m; print(m.PLANTED)"
    assert printed(show) == "1"
    edit_unseen(file, "PLANTED = 1", "PLANTED = 2")
    assert printed(show) == "2"


@pytest.mark.slow
def test_a_comment_compiles_nothing_and_constants_do_whatever_is_cached(src, printed):
    """One constant stands in another module, one in a function that a stale .pyc holds."""
    kernel = src / "pseudorigid/kernel"
    constants, callee, caller = (kernel / f"{n}.py" for n in ("constants", "callee", "caller"))
    constants.write_text("ONE = 1.0\n")
    callee.write_text("from .compiled import jit\n\n\n@jit\ndef one():\n    return 1.0\n")
    caller.write_text("""
from . import constants
from .callee import one
from .compiled import jit


@jit
def f():
    return one() * ONE


ONE = constants.ONE
""")
    show = "from pseudorigid.kernel.caller import f; print(f(), sum(f.stats.cache_hits.values()))"
    assert printed(show) == "1.0 0"
    for file in (caller, constants, kernel / "compiled.py"):
        file.write_text(f"# A comment before everything.\n{file.read_text()}")
    assert printed(show) == "1.0 1"
    constants.write_text("ONE = 2.0\n")
    edit_unseen(callee, "return 1.0", "return 3.0")
    assert printed(show) == "6.0 0"
    # The science alone runs a .pyc that fits by size and time, as any Python does.
    callee.write_text(callee.read_text().replace("3.0", "10.0"))
    assert printed(show, "") == "20.0 0"
    assert printed(show, "") == "20.0 1"


@pytest.mark.slow
def test_an_edit_before_the_compilation_does_not_stay_in_the_cache(src, printed):
    """The machine code is kept under the text that was loaded, whatever the file holds later."""
    file = src / "pseudorigid/kernel/callee.py"
    file.write_text("from .compiled import jit\n\n\n@jit\ndef f():\n    return 2.0\n")
    show = "from pseudorigid.kernel.callee import f; print(f())"
    edit = f"import pathlib; p = pathlib.Path({str(file)!r}); text = p.read_text(); "
    edit += "p.write_text(text.replace('2.0', '3.0'))"
    undone = f"import pseudorigid.kernel.compiled; {edit}; {show}; p.write_text(text)"
    assert printed(undone) == "3.0"
    assert printed(show) == "2.0"


@pytest.mark.slow
def test_machine_code_goes_to_the_users_cache_if_the_package_cannot_be_written(src, tmp_path):
    """A file in the folder's place keeps also root from writing it."""
    (src / "pseudorigid" / "kernel" / "__pycache__").touch()
    code = "from pseudorigid.kernel.arithmetic import sincos as f; print(f(1.0)[0], "
    code += "sum(f.stats.cache_hits.values()), f.stats.cache_path)"
    cache = tmp_path / "cache"
    environment = {name: os.environ[name] for name in os.environ if name != "NUMBA_CACHE_DIR"}
    environment |= {"PYTHONPATH": str(src), "XDG_CACHE_HOME": str(cache)}
    found = [run(sys.executable, "-P", "-c", code, env=environment).stdout.split() for _ in "12"]
    assert [hits for _, hits, _ in found] == ["0", "1"]
    assert all(Path(path).parent == cache / "numba" for _, _, path in found)
    # Without a home nothing is kept, and no folder named ~ is made.
    result = run(
        *(sys.executable, "-P", "-c", code), env=environment | {"XDG_CACHE_HOME": ""}, cwd=tmp_path
    )
    assert result.returncode == 0, result.stderr
    assert {path.name for path in tmp_path.iterdir()} == {"src", "cache"}


def test_loaded_files_are_noted():
    file = os.path.realpath(arithmetic.__file__)
    assert LOADED[file] == {hashlib.sha256(Path(file).read_bytes()).hexdigest()}
