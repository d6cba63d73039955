"""Compilation with strict arithmetic, one thread, and machine code that is kept.

Numba notices an edit of the file of a function, but not of the files that it calls.
Machine code is therefore kept in a folder of its own for each state of the package.
"""

import hashlib
import os
import sys
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

_RULE: list[Any] = []  # the function given to `name_folders_by`, if any
_SEEN: set[tuple[str, str]] = set()  # (module, name) of each function that was compiled


def jit(function):
    """Compile a function on its first call, with strict arithmetic and without the GIL.

    Without fastmath and parallel, every + - * / and sqrt is rounded once, in the order written.
    error_model="numpy" makes 1/0 infinite instead of an exception.
    """
    import numba  # slow to import, and every start of the pipeline imports this module

    # Code is kept for a function of a module in a package, unless another one has its name.
    module, name = function.__module__, function.__qualname__
    keep = (module, name) not in _SEEN and "." in module and _path(module) is not None
    _SEEN.add((module, name))
    config: Any = numba.config
    previous = config.CACHE_LOCATOR_CLASSES
    config.CACHE_LOCATOR_CLASSES = f"{__name__}.{Locator.__name__}"
    try:
        return numba.njit(cache=keep, error_model="numpy", fastmath=False, nogil=True)(function)
    finally:
        config.CACHE_LOCATOR_CLASSES = previous


class Locator:
    """Where numba keeps the machine code of one function; CACHE_LOCATOR_CLASSES names the class."""

    def __init__(self, function, file):
        self._module, self._py_file = function.__module__, file

    @classmethod
    def from_function(cls, py_func, py_file):
        return cls(py_func, py_file)

    def ensure_cache_path(self):
        os.makedirs(_path(self._module), exist_ok=True)

    def get_cache_path(self):
        return _path(self._module)

    def get_source_stamp(self):
        return os.path.basename(_path(self._module))

    def get_disambiguator(self):
        return ""


def folders():
    """Return the folders that may hold the folders of all modules, the preferred one first."""
    if chosen := os.environ.get("NUMBA_CACHE_DIR"):
        return [chosen]
    from numba.misc.appdirs import user_cache_dir

    # Without a home, the user's cache is a relative path.
    cache = user_cache_dir("numba", appauthor=False)
    return [str(Path(__file__).parent / "__pycache__"), *[cache] * os.path.isabs(cache)]


def subfolder(module: str) -> str | None:
    """Return the name of the folder for a module's machine code, or None to keep none.

    An edit of any file in the module's package, or in this one, gives another name, unless
    `name_folders_by` has set another rule.
    """
    packages = {name.partition(".")[0] for name in (module, __name__)}
    digest = _RULE[0](module) if _RULE else _digest(*packages)
    return digest and f"{module}-{digest}"


def name_folders_by(digest_of):
    """Let a program that knows what a module depends on name the folders of machine code.

    `digest_of` is a function of a module's name. It returns a hash of all that the module's machine
    code depends on, or None to keep none.
    """
    _RULE[:] = [digest_of]


@cache
def _digest(*packages):
    """Return a hash of all modules of some packages, or None for packages in a zip."""
    files = [file for name in packages for file in Path(*sys.modules[name].__path__).rglob("*.py")]
    text = b"".join(file.read_bytes() for file in sorted(files))
    return hashlib.sha256(text).hexdigest()[:16] if files else None


@cache
def _path(module):
    """Return the first writable folder for a module's machine code, or None if there is none."""
    name = subfolder(module)
    if name is None:
        return None
    for folder in folders():
        path = os.path.join(folder, name)
        with suppress(OSError):
            os.makedirs(path, exist_ok=True)
            if os.access(path, os.W_OK):
                return path
    return None
