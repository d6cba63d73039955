"""Where numba keeps the machine code of a function, by its setting CACHE_LOCATOR_CLASSES.

The folder is named after what the files mean that the function's module reaches by imports, so that
a changed constant compiles again and a comment does not.
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
_SEEN = set()  # modules and names of functions


class Locator(_CacheLocator):
    """Of one function of this package."""

    def __init__(self, function, file):
        self._module, self._py_file = function.__module__, file

    @classmethod
    def from_function(cls, py_func, py_file):
        return cls(py_func, py_file)

    @staticmethod
    def keeps(function):
        """Whether the machine code of a function is kept; else every process compiles for itself.

        It is not where the folder cannot be written, nor where this process loaded one of the files
        behind the function when that had another text, nor for a second function of one name.
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
    """The folder of the folders of all functions."""
    return os.environ.get("NUMBA_CACHE_DIR") or str(SRC / "pseudorigid/kernel/__pycache__")


@cache
def subfolder(src, module):
    """The name of the folder of a module's functions, and the hash of each file's text behind it.

    Parameters
    ----------
    src : pathlib.Path
        Where the package is.
    module : str
        Dotted name.

    Returns
    -------
    str, dict of pathlib.Path to str
    """
    texts = {file: file.read_bytes() for file in import_closure(src, module)}
    meanings = [facts(file.name, data)[0] for file, data in texts.items()]
    digest = hashlib.sha256(" ".join(meanings).encode()).hexdigest()[:16]
    return f"{module}-{digest}", {f: hashlib.sha256(d).hexdigest() for f, d in texts.items()}


@cache
def _path(module):
    """The folder of a module's functions, None where nothing is to be kept."""
    name, texts = subfolder(SRC, module)
    path = os.path.join(folder(), name)
    try:
        os.makedirs(path, exist_ok=True)
    except OSError:
        return None
    loaded = [(pseudorigid.LOADED.get(os.path.realpath(f), {d}), {d}) for f, d in texts.items()]
    edited = any(found != now for found, now in loaded)
    return None if edited or not os.access(path, os.W_OK) else path
