"""The one way a function is compiled: strict arithmetic, one thread, cached by the kernel's own
text.

Numba notices an edit of the file a function stands in, but not of the files it calls into; so the
cache lives in a folder named after the text of every kernel module and a stale machine code is
never loaded.
"""

import hashlib
import os
from pathlib import Path

import numba

_HERE = Path(__file__).parent
_KERNEL = (
    "arithmetic.py",
    "ball.py",
    "compiled.py",
    "flight.py",
    "impact.py",
    "lanes.py",
    "scan.py",
    "study/counted.py",
)


def _cache() -> str:
    text = b"\0".join((_HERE / name).read_bytes() for name in _KERNEL)
    root = os.environ.get("NUMBA_CACHE_DIR") or str(_HERE / "__pycache__")
    return os.path.join(root, "compiled-" + hashlib.sha256(text).hexdigest()[:16])


_CACHE = _cache()


def jit(function):
    """Compile on first use.

    No fastmath, no parallel: every + - * / and sqrt is rounded once, in the order written.
    error_model="numpy" turns 1/0 into inf, as the processor does, instead of a Python exception.
    """
    others = numba.config.CACHE_DIR
    numba.config.CACHE_DIR = _CACHE
    try:
        return numba.njit(cache=True, error_model="numpy", fastmath=False, nogil=True)(function)
    finally:
        numba.config.CACHE_DIR = others
