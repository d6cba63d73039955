"""The one way a function is compiled: strict arithmetic, one thread, cached by the text behind it.

Numba notices an edit of the file a function stands in, but not of the files it calls into; so the
cache lives in a folder named after the text of every file that is compiled, and stale machine code
is never loaded. Nothing is kept by a process that has loaded another text than the folder's.
"""

import hashlib
import os
from pathlib import Path

import numba

import pseudorigid

_KERNEL = Path(__file__).parent
_PACKAGE = _KERNEL.parent
_TEXTS = {file: file.read_bytes() for file in sorted(_PACKAGE.rglob("*.py"))}
# What is noted as loaded of a file that has this text.
_NOTES = {os.path.realpath(f): {hashlib.sha256(t).hexdigest()} for f, t in _TEXTS.items()}


def _cache() -> str:
    """A folder named after the text of the kernel and of every other file that uses `jit`."""
    compiled = [text for file, text in _TEXTS.items() if file.parent == _KERNEL or b"jit" in text]
    root = os.environ.get("NUMBA_CACHE_DIR") or str(_KERNEL / "__pycache__")
    digest = hashlib.sha256(b"\0".join(compiled)).hexdigest()[:16]
    return os.path.join(root, f"compiled-{digest}")


def _edited() -> bool:
    """Whether a module of the package was loaded from another text than its file had at first."""
    return any(pseudorigid.LOADED.get(file, note) != note for file, note in _NOTES.items())


def _writable(folder) -> bool:
    try:
        os.makedirs(folder, exist_ok=True)
    except OSError:
        return False
    return os.access(folder, os.W_OK)


_CACHE = _cache()
_KEPT = _writable(_CACHE)  # where it is not, every process compiles for itself


def jit(function):
    """Compile a function on its first call, with strict arithmetic.

    No fastmath, no parallel: every + - * / and sqrt is rounded once, in the order written.
    error_model="numpy" turns 1/0 into inf, as the processor does, instead of a Python exception.

    Parameters
    ----------
    function : callable
        Of numbers, tuples and arrays, in the part of Python that numba compiles.

    Returns
    -------
    callable
        The same, compiled for each set of argument types, without the interpreter's lock.
    """
    others = numba.config.CACHE_DIR
    numba.config.CACHE_DIR = _CACHE
    try:
        kept = _KEPT and not _edited()
        return numba.njit(cache=kept, error_model="numpy", fastmath=False, nogil=True)(function)
    finally:
        numba.config.CACHE_DIR = others
