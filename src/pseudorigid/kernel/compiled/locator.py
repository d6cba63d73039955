"""Folder in which numba keeps the machine code of a function, set by CACHE_LOCATOR_CLASSES.

Its name is a hash of the meaning of all files that the function's module imports, so that a changed
constant compiles again and a changed comment does not.
"""

import hashlib
import os
from functools import cache
from pathlib import Path

from numba.core.caching import _CacheLocator

import pseudorigid

from .import_closure import import_closure
from .syntax_hash import facts

SRC = Path(__file__).parents[3]
_SEEN = set()  # (module, name) of each function that was compiled


class Locator(_CacheLocator):
    """Locate the machine code of one function of this package."""

    def __init__(self, function, file):
        self._module, self._py_file = function.__module__, file

    @classmethod
    def from_function(cls, py_func, py_file):
        return cls(py_func, py_file)

    @staticmethod
    def keeps(function):
        """Return whether machine code of a function is kept; if not, each process compiles it.

        It is not kept if the folder cannot be written, if this process loaded a file behind the
        function with another text, or for a second function with the same name.
        """
        module, name = function.__module__, function.__qualname__
        first = (module, name) not in _SEEN
        _SEEN.add((module, name))
        return first and module.startswith("pseudorigid.") and _path(module) is not None

    def get_cache_path(self):
        return _path(self._module)

    def get_source_stamp(self):
        return os.path.basename(_path(self._module))

    def get_disambiguator(self):
        return ""


def folder():
    """Return the folder that holds the folders of all modules."""
    return os.environ.get("NUMBA_CACHE_DIR") or str(SRC / "pseudorigid/kernel/__pycache__")


@cache
def subfolder(src, module):
    """Return the name of the folder for the functions of a module, and {file: sha256} behind it."""
    texts = {file: file.read_bytes() for file in import_closure(src, module)}
    meanings = [facts(file.name, data)[0] for file, data in texts.items()]
    digest = hashlib.sha256(" ".join(meanings).encode()).hexdigest()[:16]
    return f"{module}-{digest}", {f: hashlib.sha256(d).hexdigest() for f, d in texts.items()}


@cache
def _path(module):
    """Return the folder for a module's functions, or None if nothing is to be kept."""
    name, texts = subfolder(SRC, module)
    path = os.path.join(folder(), name)
    try:
        os.makedirs(path, exist_ok=True)
    except OSError:
        return None
    loaded = [(pseudorigid.LOADED.get(os.path.realpath(f), {d}), {d}) for f, d in texts.items()]
    edited = any(at_import != now for at_import, now in loaded)
    return None if edited or not os.access(path, os.W_OK) else path
