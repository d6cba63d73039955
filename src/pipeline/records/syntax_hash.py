"""Hashes of source files that comments, formatting and docstrings do not change.

A Python file is hashed by its syntax tree without positions, docstrings and the annotations of
local variables that have a value. Other annotations count, because they are the fields of
dataclasses and named tuples. The hash is the same under Python 3.11 to 3.14. Any other file is
hashed by its bytes.
"""

import ast
import hashlib
import json
import os
from collections.abc import Iterator
from contextlib import suppress
from functools import cache
from itertools import groupby
from pathlib import Path
from typing import Any, NamedTuple

from .files import read_text, write_whole

SCHEME = 1  # increase it when the hash of an unchanged text changes
# The file of stored results is named after the text of this module.
_OWN = hashlib.sha256(Path(__file__).read_bytes()).hexdigest()[:16]
_STORE = Path(__file__).parent / "__pycache__" / f"meanings-{_OWN}.json"
_SCOPES = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)
_WITH_DOCSTRING = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
# Fields that follow from a node's position or have no effect.
_LEFT_OUT = ("ctx", "kind", "type_comment", "type_ignores")


class ParsedSource(NamedTuple):
    """The hash of a source file, and its imports: number of dots, module and names of each."""

    syntax_hash: str
    imports: list[tuple[int, str, list[str]]]


def syntax_hash(path: str | os.PathLike[str]) -> str | None:
    """Return the hash of a file in hex, or None if there is no regular file."""
    path = Path(path)
    # Reading a FIFO would block.
    return parsed(path.name, path.read_bytes()).syntax_hash if path.is_file() else None


def parsed(name: str, data: bytes) -> ParsedSource:
    """Return the hash and the imports of a file with this name and content."""
    suffix = Path(name).suffix
    key = f"{suffix} {_sha256(data)}"
    results = _results()
    if key not in results:
        results[key] = _parse(suffix, data)
        results["new"] = True
    return ParsedSource(*results[key])


def store_results() -> None:
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


def _parse(suffix: str, data: bytes) -> ParsedSource:
    """Parse a Python file; a file of another suffix, or with mistakes, is hashed by its bytes."""
    words, imports = [f"{SCHEME}"], []
    try:
        if suffix == ".py":
            tree = ast.parse(data)
            _describe(tree, words, in_function=False)
            imports = list(_imports(tree))
        else:
            words.append(data.hex())
    except (SyntaxError, ValueError, RecursionError):
        words = [f"{SCHEME}", "unreadable", data.hex()]
    return ParsedSource(_sha256("\n".join(words).encode()), imports)


def _imports(tree: ast.AST) -> Iterator[tuple[int, str, list[str]]]:
    """Yield the number of dots, the module and the names of each import statement."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from ((0, alias.name, []) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield node.level, node.module or "", [alias.name for alias in node.names]


def _describe(value: Any, words: list[str], in_function: bool) -> None:
    """Append words that identify a node of a syntax tree, or a constant in one."""
    if isinstance(value, ast.JoinedStr):
        _describe_list("JoinedStr", _merged(value.values), words, in_function)
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
            _describe_list(name, value[with_docstring:], words, inside)
        elif isinstance(value, list):
            _describe_list(name, value, words, inside)
        elif isinstance(value, ast.AST):
            words.append(name)
            _describe(value, words, inside)
        else:
            words.append(f"{name} {_constant(value)}")
    words.append(")")


def _describe_list(name: str, values: list[Any], words: list[str], in_function: bool) -> None:
    """Append the words of a field that has a list."""
    words.append(f"[{name}")
    for value in values:
        _describe(value, words, in_function)
    words.append("]")


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
