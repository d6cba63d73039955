"""Which files of this package a script needs, read from import statements without running them.

Snakemake does not look inside a script's imports; its rules name these files as inputs, so that
editing a module reruns what uses it.
"""

import ast
import os
from functools import cache
from pathlib import Path

SRC = Path(__file__).resolve().parents[2]
ROOT = SRC.parent
PACKAGES = ("pseudorigid", "pipeline")


def code(script: str, *modules: str) -> list[str]:
    """The project's files that a script of workflow/scripts runs, from the root, itself included.

    `modules` are those that the script imports by a name it is given.
    """
    scripts = [ROOT / "workflow" / "scripts" / name for name in (script, "job.py")]
    return [os.path.relpath(file, ROOT) for file in (*scripts, *closure(*scripts, *modules))]


def closure(*starts: str | Path) -> list[Path]:
    """The package's files behind `starts`, sorted: what they import, what that imports, and so on.

    A start is a module's dotted name ("pseudorigid.orbits"), whose own file is part of the answer,
    or the path of a script, which is not. Imports inside functions count; those under
    `if TYPE_CHECKING` do not. A package's `__init__` runs when one of its modules is imported, so
    it counts too. Raises ValueError for a module that is not there, and for `from package import
    name` where name is no module: a lazy package does not tell where such a name comes from.
    """
    found: set[Path] = set()
    pending = []
    for start in starts:
        if isinstance(start, Path):
            pending += _imports(start, ())
        else:
            pending.append(tuple(start.split(".")))
    while pending:
        parts = pending.pop()
        for size in range(1, len(parts) + 1):
            file = _file(parts[:size])
            if file is None:
                raise ValueError(f"no module {'.'.join(parts[:size])} in {SRC}")
            if file not in found:
                found.add(file)
                package = parts[:size] if file.name == "__init__.py" else parts[: size - 1]
                pending += _imports(file, package)
    return sorted(found)


def _file(parts: tuple[str, ...]) -> Path | None:
    path = SRC.joinpath(*parts)
    for file in (path / "__init__.py", path.with_suffix(".py")):
        if file.is_file():
            return file
    return None


def _imports(file: Path, package: tuple[str, ...]) -> list[tuple[str, ...]]:
    """The modules of this package that `file`, a member of `package`, imports anywhere."""
    modules = []
    for node in _statements(file.read_text(encoding="utf-8"), str(file)):
        if isinstance(node, ast.Import):
            modules += [tuple(alias.name.split(".")) for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) - node.level + 1] if node.level else ()
            base += tuple(node.module.split(".")) if node.module else ()
            if base[0] not in PACKAGES:
                continue
            for alias in node.names:
                modules.append(_module_or_name(base, alias.name, file))
    return [module for module in modules if module[0] in PACKAGES]


@cache
def _statements(text: str, name: str) -> list[ast.Import | ast.ImportFrom]:
    """The import statements of a file that run."""
    found = []
    pending: list[ast.AST] = [ast.parse(text, name)]
    while pending:
        node = pending.pop()
        if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test):
            pending += node.orelse
        elif isinstance(node, ast.Import | ast.ImportFrom):
            found.append(node)
        else:
            pending += ast.iter_child_nodes(node)
    return found


def _module_or_name(base: tuple[str, ...], name: str, file: Path) -> tuple[str, ...]:
    """The module that `from base import name` needs."""
    if _file((*base, name)):
        return (*base, name)
    own = _file(base)
    if own and own.name == "__init__.py" and name not in _defined(own):
        raise ValueError(f"{file.name}: import {name} from its module, not from {'.'.join(base)}")
    return base


def _defined(file: Path) -> set[str]:
    """Names that a package's `__init__` defines by itself."""
    names = set()
    for node in ast.parse(file.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            names.add(node.name)
        elif isinstance(node, ast.Assign | ast.AnnAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            names |= {target.id for target in targets if isinstance(target, ast.Name)}
        elif isinstance(node, ast.Import | ast.ImportFrom):
            names |= {(alias.asname or alias.name) for alias in node.names}
    return names
