"""Hashes of source files that comments, formatting and docstrings do not change.

A Python file is hashed by its syntax tree without positions, docstrings and the annotations of
local variables that have a value. Other annotations count, because they are the fields of
dataclasses and named tuples. The hash is the same under Python 3.11 to 3.14. Any other file is
hashed by its bytes.
"""

import ast
import functools
import hashlib
import json
import os
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

Facts = list[Any]  # the hash of a text and its imports
SCHEME = 1  # increase it when the hash of an unchanged text changes
# The file of stored results is named after the text of this module.
_OWN = hashlib.sha256(Path(__file__).read_bytes()).hexdigest()[:16]
_KEPT = Path(__file__).parent / "__pycache__" / f"meanings-{_OWN}.json"
_SCOPES = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)
_WITH_DOCSTRING = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
# Fields that follow from a node's position or have no effect.
_LEFT_OUT = ("ctx", "kind", "type_comment", "type_ignores")


def syntax_hash(path: str | os.PathLike[str]) -> str | None:
    """Return the hash of a file in hex, or None if there is no regular file."""
    path = Path(path)
    # Reading a FIFO would block.
    return facts(path.name, path.read_bytes())[0] if path.is_file() else None


def facts(name: str, data: bytes) -> Facts:
    """Return the hash of a file's text and its imports, [number of dots, module, names] each."""
    suffix = Path(name).suffix
    key = f"{suffix} {hashlib.sha256(data).hexdigest()}"
    known = _known()
    if key not in known:
        known[key] = _facts(suffix, data)
        known["new"] = True
    return list(known[key])


def keep() -> None:
    """Store the results of `facts` for other processes, if possible."""
    known = _known()
    if known.pop("new", False):
        part = _KEPT.with_name(f".{_KEPT.name}.{os.getpid()}.part")
        with suppress(OSError):
            _KEPT.parent.mkdir(exist_ok=True)
            text = json.dumps(known)
            part.write_text(f"{_hash(text)}\n{text}", encoding="utf-8")
            os.replace(part, _KEPT)


@functools.cache
def _known() -> dict[str, Any]:
    """Return the stored results of `facts`."""
    with suppress(OSError, ValueError):
        if _KEPT.is_file():  # reading a FIFO would block
            digest, text = _KEPT.read_text(encoding="utf-8").split("\n", 1)
            if digest == _hash(text):  # otherwise the file is damaged
                return dict(json.loads(text))
    return {}


def _hash(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def _facts(suffix: str, data: bytes) -> list[Any]:
    words, imports = [f"{SCHEME}"], []
    try:
        if suffix == ".py":
            tree = ast.parse(data)
            _describe(tree, words, local=False)
            imports = list(_imports(tree))
        else:
            words.append(data.hex())
    except (SyntaxError, ValueError, RecursionError):  # hash the bytes of an unreadable file
        words = [f"{SCHEME}", "unreadable", data.hex()]
    return [_hash("\n".join(words)), imports]


def _imports(tree: ast.AST) -> Iterator[list[Any]]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield [0, alias.name, []]
        elif isinstance(node, ast.ImportFrom):
            yield [node.level, node.module or "", [alias.name for alias in node.names]]


def _describe(node: Any, words: list[str], local: object) -> None:
    """Append words that identify a node; `local` is whether it is inside a function."""
    if isinstance(node, ast.Constant):
        words.append(_constant(node.value))
        return
    if isinstance(node, ast.JoinedStr):
        _describe_list("JoinedStr", _joined(node.values), words, local)
        return
    annotated = isinstance(node, ast.AnnAssign) and node.value and isinstance(node.target, ast.Name)
    if local and annotated:
        node = ast.Assign(targets=[node.target], value=node.value)
    words.append(f"({type(node).__name__}")
    inner = isinstance(node, _SCOPES) or (local and not isinstance(node, ast.ClassDef))
    for name, value in sorted(ast.iter_fields(node)):
        if name in _LEFT_OUT or value is None or value == []:
            continue
        if name == "body" and isinstance(node, _WITH_DOCSTRING) and _is_text(value[0]):
            _describe_list(name, value[1:], words, inner)
        elif name == "format_spec" and not _joined(value.values):
            continue
        elif isinstance(value, list):
            _describe_list(name, value, words, inner)
        elif isinstance(value, ast.AST):
            words.append(name)
            _describe(value, words, inner)
        else:
            words.append(f"{name} {_constant(value)}")
    words.append(")")


def _describe_list(name: str, values: list[Any], words: list[str], local: object) -> None:
    words.append(f"[{name}")
    for value in values:
        if isinstance(value, ast.AST):
            _describe(value, words, local)
        else:
            words.append(_constant(value))
    words.append("]")


def _constant(value: object) -> str:
    """Return a word for a constant that does not depend on what Python can print."""
    if isinstance(value, str):
        text = value.encode("utf-8", "surrogatepass").hex()
    elif isinstance(value, bytes):
        text = value.hex()
    elif isinstance(value, int):
        text = hex(value)
    else:
        text = repr(value)
    return f"{type(value).__name__} {text}"


def _joined(values: list[Any]) -> list[Any]:
    """Merge adjacent texts of an f-string, which Python versions split differently."""
    parts = []
    for value in values:
        if not _is_string(value):
            parts.append(value)
        elif parts and _is_string(parts[-1]):
            parts[-1] = ast.Constant(parts[-1].value + value.value)
        elif value.value:
            parts.append(value)
    return parts


def _is_string(node: object) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, str)


def _is_text(statement: object) -> bool:
    return isinstance(statement, ast.Expr) and _is_string(statement.value)
