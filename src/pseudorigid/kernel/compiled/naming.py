"""The folder in which `locator` keeps the machine code of a module.

Numba notices an edit of the file in which a function stands, but not of the files that it calls.
"""

import hashlib
import sys
from functools import cache
from pathlib import Path


def subfolder(module: str) -> str | None:
    """Return the name of the folder for a module's machine code, or None to keep none.

    An edit of any file in the module's package, or in this one, gives another name. A program may
    replace this function by one that knows better what a module depends on.
    """
    return f"{module}-{_digest(*{name.partition('.')[0] for name in (module, __name__)})}"


@cache
def _digest(*packages: str) -> str:
    files = [file for name in packages for file in Path(*sys.modules[name].__path__).rglob("*.py")]
    return hashlib.sha256(b"".join(file.read_bytes() for file in sorted(files))).hexdigest()[:16]
