"""Files that a module depends on, read from import statements without running them."""

from collections.abc import Iterable
from functools import cache
from importlib.util import resolve_name
from pathlib import Path

from ..loading import PACKAGES
from . import syntax_hash


def import_closure(src: Path, *starts: str, leave_out: Iterable[str] = ()) -> list[Path]:
    """Return the sorted files, in the folder `src` of packages, that some modules depend on.

    These are the files of the modules (dotted names), of all that they import directly or
    indirectly, also inside functions, and of the packages around them. Modules in `leave_out` are
    not followed. Raises ValueError if a module does not exist, or if a name is imported from a
    package that imports its names lazily, which hides the module that defines the name.
    """
    files, seen, pending = set(), set(leave_out), [*starts]
    while pending:
        name = pending.pop()
        parent = name.rpartition(".")[0]
        pending += [parent] if parent and parent not in seen else []
        if name in seen:
            continue
        seen.add(name)
        file = _file(src, name)
        if file is None:
            raise ValueError(f"no module {name} in {src}")
        if file not in files:
            files.add(file)
            pending += _imported_modules(src, file, name if file.name == "__init__.py" else parent)
    syntax_hash.store_results()
    return sorted(files)


def _imported_modules(src: Path, file: Path, package: str) -> list[str]:
    """Return the modules of the packages that `file`, a member of `package`, imports anywhere."""
    modules = []
    for level, module, names in syntax_hash.parsed(file.name, file.read_bytes()).imports:
        if not (level or module.split(".")[0] in PACKAGES):
            continue
        base = resolve_name("." * level + module, package)
        modules += [] if names else [base]
        for name in (f"{base}.{name}" for name in names):
            if not _file(src, name) and _imports_names_lazily(src, base):
                raise ValueError(f"{file.name}: import {name.rpartition('.')[2]} from its module")
            modules.append(name if _file(src, name) else base)
    return modules


@cache
def _file(src: Path, name: str) -> Path | None:
    """Return the file of a module, or None if there is none."""
    path = src.joinpath(*name.split("."))
    files = (path / "__init__.py", path.with_suffix(".py"))
    return next((file for file in files if file.is_file()), None)


@cache
def _imports_names_lazily(src: Path, package: str) -> bool:
    """Return whether a package imports its public names when they are first used."""
    file = src.joinpath(*package.split("."), "__init__.py")
    return file.is_file() and b"\ndef __getattr__" in file.read_bytes()
