"""Source files of results: which files decide the bytes of a result, and their hashes.

Records and manifests name these files, so that an edit of a module outdates the results that use
it. Comments, formatting and docstrings change no hash: a Python file is hashed by its syntax tree
without positions, docstrings and the annotations of local variables that have a value. Other
annotations count, because they are the fields of dataclasses and named tuples. The hash is the same
under Python 3.11 to 3.14. Any other file is hashed by its bytes.
"""

import ast
import hashlib
import json
import os
from collections.abc import Iterable, Iterator
from contextlib import suppress
from functools import cache
from importlib.util import resolve_name
from itertools import groupby
from pathlib import Path
from typing import Any, NamedTuple

from ..declaration import SRC, SourceError
from ..loading import LOADED, PACKAGES
from .files import read_text, write_whole

ROOT = SRC.parent
# Modules that every job loads and that do not affect the bytes of a result: they write records and
# whole files, hash, load modules and report failures. Tests plant a change in each.
BOOKKEEPING = (
    "pipeline",
    "pipeline.declaration",
    "pipeline.jobs",
    "pipeline.jobs.job",
    "pipeline.jobs.forks",
    "pipeline.loading",
    "pipeline.records",
    "pipeline.records.differences",
    "pipeline.records.files",
    "pipeline.records.provenance",
    "pipeline.records.sources",
    "pseudorigid",
)
SCHEME = 1  # increase it when the hash of an unchanged text changes
# The file of stored results is named after the text of this module.
_OWN = hashlib.sha256(Path(__file__).read_bytes()).hexdigest()[:16]
_STORE = Path(__file__).parent / "__pycache__" / f"meanings-{_OWN}.json"
_SCOPES = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)
_WITH_DOCSTRING = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
# Fields that follow from a node's position or have no effect.
_LEFT_OUT = ("ctx", "kind", "type_comment", "type_ignores")


def source_files(*modules: str) -> list[str]:
    """Return the paths, from the root, of the files that some modules (dotted names) depend on.

    BOOKKEEPING is left out.
    """
    closure = import_closure(SRC, *modules, leave_out=BOOKKEEPING)
    return [os.path.relpath(file, ROOT) for file in closure]


def import_closure(src: Path, *starts: str, leave_out: Iterable[str] = ()) -> list[Path]:
    """Return the sorted files, in the folder `src` of packages, that some modules depend on.

    These are the files of the modules (dotted names), of all that they import directly or
    indirectly, also inside functions, and of the packages around them. Import statements are read
    and not run. Modules in `leave_out` are not followed. Raises SourceError if a module does not
    exist or is no Python, and ValueError if a name is imported from a package that imports its
    names lazily, which hides the module that defines the name.
    """
    files, seen, pending = set[Path](), {"", *leave_out}, [*starts]
    while pending:
        if (name := pending.pop()) in seen:
            continue
        seen.add(name)
        file, parent = _file(src, name), name.rpartition(".")[0]
        if file is None:
            path = src.joinpath(*name.split(".")).with_suffix(".py")
            raise SourceError(path, f"no module {name}")
        files.add(file)
        package = name if file.name == "__init__.py" else parent
        pending += [parent, *_imported_modules(src, file, package)]
    _store_results()
    return sorted(files)


def _imported_modules(src: Path, file: Path, package: str) -> Iterator[str]:
    """Yield the modules of the packages that `file`, a member of `package`, imports anywhere."""
    imports = parsed(file.name, file.read_bytes()).imports
    if isinstance(imports, str):
        raise SourceError(file, imports)
    for level, module, names in imports:
        if not (level or module.split(".")[0] in PACKAGES):
            continue
        base = resolve_name("." * level + module, package)
        if not names:
            yield base
        for name in names:
            if _file(src, f"{base}.{name}"):
                yield f"{base}.{name}"
            elif _imports_names_lazily(src, base):
                raise ValueError(f"{file.name}: import {name} from its module")
            else:
                yield base


@cache
def _file(src: Path, name: str) -> Path | None:
    """Return the file of a module, or None if there is none."""
    path = src.joinpath(*name.split("."))
    return next(filter(Path.is_file, (path / "__init__.py", path.with_suffix(".py"))), None)


@cache
def _imports_names_lazily(src: Path, package: str) -> bool:
    """Return whether a package imports its public names when they are first used."""
    file = src.joinpath(*package.split("."), "__init__.py")
    return file.is_file() and b"\ndef __getattr__" in file.read_bytes()


@cache
def machine_code_digest(src: Path, module: str) -> tuple[str, dict[Path, str]]:
    """Return a hash of all that a module's machine code depends on, and its sources' SHA-256."""
    meanings, digests = list[str](), dict[Path, str]()
    for file in import_closure(src, module):
        data = file.read_bytes()
        meanings.append(parsed(file.name, data).syntax_hash)
        digests[file] = _sha256(data)
    return _sha256(" ".join(meanings).encode())[:16], digests


def digest_of_loaded(module: str) -> str | None:
    """Return `machine_code_digest` of a module of this project.

    Returns None for other modules, or if this process loaded another text of a source than the file
    has now.
    """
    try:
        digest, sources = machine_code_digest(SRC, module)
    except ValueError:
        return None
    unchanged = all(LOADED.get(os.path.realpath(f), {d}) == {d} for f, d in sources.items())
    return digest if unchanged else None


class ParsedSource(NamedTuple):
    """The hash of a source file, and its imports: number of dots, module and names of each.

    Those of a Python file with mistakes are the line about the first mistake.
    """

    syntax_hash: str
    imports: list[tuple[int, str, list[str]]] | str


def syntax_hash(path: str | os.PathLike[str]) -> str | None:
    """Return the hash of a file in hex, or None if there is no file."""
    path = Path(path)
    return parsed(path.name, path.read_bytes()).syntax_hash if path.is_file() else None


def imported_modules(path: str | os.PathLike[str]) -> set[str]:
    """Return the names, without submodules, of the modules that a file imports absolutely."""
    path = Path(path)
    imports = parsed(path.name, path.read_bytes()).imports if path.is_file() else []
    if isinstance(imports, str):  # no Python
        return set()
    return {module.partition(".")[0] for level, module, _ in imports if not level}


def parsed(name: str, data: bytes) -> ParsedSource:
    """Return the hash and the imports of a file with this name and content.

    A Python file with mistakes is hashed by its bytes.
    """
    suffix, results = Path(name).suffix, _results()
    key = f"{suffix} {_sha256(data)}"
    if key not in results:
        words: list[str] = [f"{SCHEME}"]
        imports: list[Any] | str = []
        try:
            if suffix == ".py":
                tree = ast.parse(data, name)
                _describe(tree, words, in_function=False)
                imports = list(_imports(tree))
            else:
                words.append(data.hex())
        except (SyntaxError, ValueError, RecursionError) as error:
            words, imports = [f"{SCHEME}", "unreadable", data.hex()], str(error)
        results[key] = _sha256("\n".join(words).encode()), imports
        results["new"] = True
    return ParsedSource(*results[key])


def _store_results() -> None:
    """Store the results of `parsed` for other processes, if possible."""
    results = _results()
    if results.pop("new", False):
        text = json.dumps(results)
        with suppress(OSError, ValueError):
            write_whole(_STORE, f"{_sha256(text.encode())}\n{text}")


@cache
def _results() -> dict[str, Any]:
    """Return the stored results of `parsed`, none if their file is missing or damaged."""
    with suppress(OSError, ValueError):
        digest, text = read_text(_STORE).split("\n", 1)
        if digest == _sha256(text.encode()):
            return dict(json.loads(text))
    return {}


def _sha256(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


def _imports(tree: ast.AST) -> Iterator[tuple[int, str, list[str]]]:
    """Yield the number of dots, the module and the names of each import statement."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from ((0, alias.name, []) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield node.level, node.module or "", [alias.name for alias in node.names]


def _describe(value: Any, words: list[str], in_function: bool, field: str = "") -> None:
    """Append words that identify a part of a syntax tree: a node, a constant or a field's list."""
    if isinstance(value, list):
        words.append(f"[{field}")
        for part in value:
            _describe(part, words, in_function)
        words.append("]")
    elif isinstance(value, ast.JoinedStr):
        _describe(_merged(value.values), words, in_function, "JoinedStr")
    elif isinstance(value, ast.AST) and not isinstance(value, ast.Constant):
        _describe_node(value, words, in_function)
    else:
        words.append(_constant(value.value if isinstance(value, ast.Constant) else value))


def _describe_node(node: ast.AST, words: list[str], in_function: bool) -> None:
    """Append the type of a node, and the words of each of its fields that has an effect."""
    if in_function and isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
        node = ast.Assign(targets=[node.target], value=node.value) if node.value else node
    words.append(f"({type(node).__name__}")
    inside = isinstance(node, _SCOPES) or (in_function and not isinstance(node, ast.ClassDef))
    for name, value in sorted(ast.iter_fields(node)):
        empty_format = name == "format_spec" and value and not _merged(value.values)
        if name in _LEFT_OUT or value is None or value == [] or empty_format:
            continue
        if name == "body" and isinstance(node, _WITH_DOCSTRING):
            with_docstring = ast.get_docstring(node, clean=False) is not None
            _describe(value[with_docstring:], words, inside, name)
        elif isinstance(value, list):
            _describe(value, words, inside, name)
        elif isinstance(value, ast.AST):
            words.append(name)
            _describe(value, words, inside)
        else:
            words.append(f"{name} {_constant(value)}")
    words.append(")")


def _constant(value: object) -> str:
    """Return a word for a constant that does not depend on what Python can print."""
    if isinstance(value, str):
        text = value.encode("utf-8", "surrogatepass").hex()
    elif isinstance(value, bytes):
        text = value.hex()
    else:
        text = hex(value) if isinstance(value, int) else repr(value)
    return f"{type(value).__name__} {text}"


def _merged(values: list[Any]) -> list[Any]:
    """Merge adjacent texts of an f-string, which Python versions split differently."""
    parts: list[Any] = []
    for is_text, group in groupby(values, lambda value: isinstance(value, ast.Constant)):
        if not is_text:
            parts += group
        elif text := "".join(constant.value for constant in group):
            parts.append(text)
    return parts
