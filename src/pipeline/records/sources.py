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
# What snakemake reads: it says which function a job calls, with what.
WORKFLOW = ("Snakefile", "workflow/rules/common.smk", "workflow/rules/results.smk")
# Module -> the files that it reads.
_READS = {
    "src/pseudorigid/proofs/theorems/statements.py": "src/pseudorigid/proofs/certificates/*.toml"
}


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
        From the root, the script and the workflow's own files included.
    """
    path = ROOT / "workflow" / "scripts" / script
    files = [os.path.relpath(file, ROOT) for file in (path, *closure(path, *modules))]
    for module in set(files) & set(_READS):
        files += sorted(os.path.relpath(file, ROOT) for file in ROOT.glob(_READS[module]))
    return [*WORKFLOW, *files]


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
    seen: set[str] = set()
    pending = []
    for start in starts:
        pending += _read(start, "") if isinstance(start, Path) else [start]
    while pending:
        name = pending.pop()
        if name in seen:
            continue
        seen.add(name)
        file = _file(SRC, name)
        if file is None:
            raise ValueError(f"no module {name} in {SRC}")
        parent = name.rpartition(".")[0]
        pending += [parent] if parent else []
        if file not in found:
            found.add(file)
            pending += _read(file, name if file.name == "__init__.py" else parent)
    return sorted(found)


def _read(file: Path, package: str) -> list[str]:
    """The project's modules that `file`, a member of `package`, imports anywhere."""
    return _imports(SRC, file.read_text(encoding="utf-8"), file.name, package)


@cache
def _imports(src: Path, text: str, file: str, package: str) -> list[str]:
    modules = []
    for node in ast.walk(ast.parse(text, file)):
        if isinstance(node, ast.Import):
            modules += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            base = resolve_name("." * node.level + (node.module or ""), package)
            for alias in node.names if base.split(".")[0] in PACKAGES else ():
                name = f"{base}.{alias.name}"
                if base == PACKAGES[0] and not _file(src, name):
                    raise ValueError(f"{file}: import {alias.name} from its module")
                modules.append(name if _file(src, name) else base)
    return [name for name in modules if name.split(".")[0] in PACKAGES]


@cache
def _file(src: Path, name: str) -> Path | None:
    """The file of a module, None where there is none."""
    path = src.joinpath(*name.split("."))
    files = (path / "__init__.py", path.with_suffix(".py"))
    return next((file for file in files if file.is_file()), None)
