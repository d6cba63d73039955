"""Names of the folders of compiled functions, which contain a hash of the functions' sources.

A changed constant compiles again and a changed comment does not.
"""

import hashlib
import os
from functools import cache
from pathlib import Path

from ..loading import LOADED
from .import_closure import import_closure
from .syntax_hash import parsed

SRC = Path(__file__).resolve().parents[2]


@cache
def named(src: Path, module: str) -> tuple[str, dict[Path, str]]:
    """Return the name of the folder for a module's functions, and the SHA-256 of its sources."""
    contents = {file: file.read_bytes() for file in import_closure(src, module)}
    hashes = [parsed(file.name, data).syntax_hash for file, data in contents.items()]
    digest = hashlib.sha256(" ".join(hashes).encode()).hexdigest()[:16]
    return f"{module}-{digest}", {f: hashlib.sha256(d).hexdigest() for f, d in contents.items()}


def subfolder(module: str) -> str | None:
    """Return the name of the folder for a module's functions.

    Returns None for a module of another project, or if this process loaded another text of a source
    than the file has now.
    """
    try:
        name, digests = named(SRC, module)
    except ValueError:
        return None
    unchanged = all(LOADED.get(os.path.realpath(f), {d}) == {d} for f, d in digests.items())
    return name if unchanged else None
