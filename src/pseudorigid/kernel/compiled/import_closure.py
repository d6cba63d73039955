"""Files that a module depends on, read from import statements without running them."""

from functools import cache
from importlib.util import resolve_name
from pathlib import Path

from . import syntax_hash

PACKAGES = ("pseudorigid", "pipeline")


def import_closure(src, *starts, leave_out=()):
    """Return the sorted files, in the folder `src` of packages, that some modules depend on.

    They are those of the modules (dotted names), of everything that they import directly or
    indirectly, also inside functions, and of every package on the way, without `leave_out` and what
    only these import. Raises ValueError if a module does not exist, or a name is imported from the
    package `pseudorigid`, which does not show which module defines it.
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
    syntax_hash.keep()
    return sorted(files)


def _imported_modules(src, file, package):
    """Return the modules of the packages that `file`, a member of `package`, imports anywhere."""
    modules = []
    for level, module, names in syntax_hash.facts(file.name, file.read_bytes())[1]:
        if not (level or module.split(".")[0] in PACKAGES):
            continue
        base = resolve_name("." * level + module, package)
        modules += [] if names else [base]
        for name in (f"{base}.{name}" for name in names):
            if base == PACKAGES[0] and not _file(src, name):
                raise ValueError(f"{file.name}: import {name.split('.')[1]} from its module")
            modules.append(name if _file(src, name) else base)
    return modules


@cache
def _file(src: Path, name: str) -> Path | None:
    """Return the file of a module, or None if there is none."""
    path = src.joinpath(*name.split("."))
    files = (path / "__init__.py", path.with_suffix(".py"))
    return next((file for file in files if file.is_file()), None)
