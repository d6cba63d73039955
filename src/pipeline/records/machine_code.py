"""The folder of a module's machine code, by the meaning of what the module imports.

A changed constant compiles again and a changed comment does not.
"""

import hashlib
import os
from functools import cache
from pathlib import Path

from ..loading import LOADED
from .import_closure import import_closure
from .syntax_hash import facts

SRC = Path(__file__).resolve().parents[2]


@cache
def named(src: Path, module: str) -> tuple[str, dict[Path, str]]:
    """Return the name of the folder for a module's functions, and {file: sha256} behind it."""
    texts = {file: file.read_bytes() for file in import_closure(src, module)}
    meanings = [facts(file.name, data)[0] for file, data in texts.items()]
    digest = hashlib.sha256(" ".join(meanings).encode()).hexdigest()[:16]
    return f"{module}-{digest}", {f: hashlib.sha256(d).hexdigest() for f, d in texts.items()}


def subfolder(module: str) -> str | None:
    """Return the name of the folder, or None if this process loaded a file with another text.

    None also if the module is none of this project.
    """
    try:
        name, digests = named(SRC, module)
    except ValueError:
        return None
    loaded = [(LOADED.get(os.path.realpath(f), {d}), {d}) for f, d in digests.items()]
    return None if any(at_import != now for at_import, now in loaded) else name
