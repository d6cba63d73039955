"""Which of the project's files a script needs, read from import statements without running them.

Records name these files, so that editing a module makes again what uses it.
"""

import ast
import os
from functools import cache
from importlib.util import resolve_name
from pathlib import Path

SRC = Path(__file__).resolve().parents[2]
ROOT = SRC.parent
PACKAGES = ("pseudorigid", "pipeline")


def code(script: str, *modules: str) -> list[str]:
    """The project's files that a script of workflow/scripts runs.

    Parameters
    ----------
    script : str
        Its file's name.
    *modules : str
        Those that the script imports by a name it is given.

    Returns
    -------
    list of str
        From the root, the script included.
    """
    scripts = [ROOT / "workflow" / "scripts" / name for name in (script, "job.py")]
    return [os.path.relpath(file, ROOT) for file in (*scripts, *closure(*scripts, *modules))]


def closure(*starts: str | Path) -> list[Path]:
    """The packages' files behind some modules or scripts.

    What they import, what that imports, and so on; imports inside functions count, and so does the
    `__init__` of every package on the way.

    Parameters
    ----------
    *starts : str or pathlib.Path
        A module's dotted name ("pseudorigid.dynamics.orbits"), whose own file is part of the
        answer, or the path of a script, which is not.

    Returns
    -------
    list of pathlib.Path
        Sorted.

    Raises
    ------
    ValueError
        A module that is not there, or a name from the package `pseudorigid`, which does not tell
        where such a name comes from.
    """
    found: set[Path] = set()
    pending = []
    for start in starts:
        pending += _imports(start, "") if isinstance(start, Path) else [start]
    while pending:
        name = pending.pop()
        parts = name.split(".")
        for size in range(1, len(parts) + 1):
            file = _file(".".join(parts[:size]))
            if file is None:
                raise ValueError(f"no module {name} in {SRC}")
            if file not in found:
                found.add(file)
                package = size if file.name == "__init__.py" else size - 1
                pending += _imports(file, ".".join(parts[:package]))
    return sorted(found)


def _file(name: str) -> Path | None:
    """The file of a module, None where there is none."""
    path = SRC.joinpath(*name.split("."))
    files = (path / "__init__.py", path.with_suffix(".py"))
    return next((file for file in files if file.is_file()), None)


def _imports(file: Path, package: str) -> list[str]:
    """The project's modules that `file`, a member of `package`, imports anywhere."""
    modules = []
    for node in _statements(file.read_text(encoding="utf-8"), str(file)):
        if isinstance(node, ast.Import):
            modules += [alias.name for alias in node.names]
            continue
        base = resolve_name("." * node.level + (node.module or ""), package)
        for alias in node.names if base.split(".")[0] in PACKAGES else ():
            name = f"{base}.{alias.name}"
            if base == PACKAGES[0] and not _file(name):
                raise ValueError(f"{file.name}: import {alias.name} from its module")
            modules.append(name if _file(name) else base)
    return [name for name in modules if name.split(".")[0] in PACKAGES]


@cache
def _statements(text: str, name: str) -> list[ast.Import | ast.ImportFrom]:
    nodes = ast.walk(ast.parse(text, name))
    return [node for node in nodes if isinstance(node, ast.Import | ast.ImportFrom)]
