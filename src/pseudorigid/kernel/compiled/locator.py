"""Folder in which numba keeps the machine code of a function, set by CACHE_LOCATOR_CLASSES."""

import os
from functools import cache
from pathlib import Path

from numba.core.caching import _CacheLocator

from . import naming

_SEEN = set()  # (module, name) of each function that was compiled


class Locator(_CacheLocator):
    """Locate the machine code of one function."""

    def __init__(self, function, file):
        self._module, self._py_file = function.__module__, file

    @classmethod
    def from_function(cls, py_func, py_file):
        return cls(py_func, py_file)

    @staticmethod
    def keeps(function):
        """Return whether machine code of a function is kept; if not, each process compiles it.

        It is not kept if the folder cannot be written, if `naming.subfolder` says so, for functions
        of the main program, or for a second function with the same name.
        """
        module, name = function.__module__, function.__qualname__
        first = (module, name) not in _SEEN
        _SEEN.add((module, name))
        return first and "." in module and _path(module) is not None

    def get_cache_path(self):
        return _path(self._module)

    def get_source_stamp(self):
        return os.path.basename(_path(self._module))

    def get_disambiguator(self):
        return ""


def folder():
    """Return the folder that holds the folders of all modules."""
    return os.environ.get("NUMBA_CACHE_DIR") or str(Path(__file__).parents[1] / "__pycache__")


@cache
def _path(module):
    """Return the folder for a module's functions, or None if nothing is to be kept."""
    name = naming.subfolder(module)
    if name is None:
        return None
    path = os.path.join(folder(), name)
    try:
        os.makedirs(path, exist_ok=True)
    except OSError:
        return None
    return path if os.access(path, os.W_OK) else None
