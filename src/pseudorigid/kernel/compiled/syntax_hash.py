"""What a source file means: a hash that comments, formatting and docstrings do not change.

The hash of a Python file is that of its syntax tree without positions, docstrings and the
annotations of local variables that have a value. All other annotations count: fields of dataclasses
and named tuples are annotations. It is the same under Python 3.11 to 3.14. Of a Snakefile the
tokens count, of any other file the text.
"""

import ast
import functools
import hashlib
import io
import json
import os
import tokenize
from contextlib import suppress
from pathlib import Path

SCHEME = 1  # to be raised when the same text gets another hash
# What other processes found, by this text of this module.
_OWN = hashlib.sha256(Path(__file__).read_bytes()).hexdigest()[:16]
_KEPT = Path(__file__).parents[1] / "__pycache__" / f"meanings-{_OWN}.json"
_SCOPES = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)
_WITH_DOCSTRING = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
# They follow from the place of a node, or are of no consequence.
_LEFT_OUT = ("ctx", "kind", "type_comment", "type_ignores")
_LAYOUT = (tokenize.ENCODING, tokenize.COMMENT, tokenize.NL)


def syntax_hash(path):
    """Hash of what a file means.

    Parameters
    ----------
    path : path

    Returns
    -------
    str or None
        In hex; None where there is no regular file.
    """
    path = Path(path)
    # Reading a FIFO would wait for ever.
    return facts(path.name, path.read_bytes())[0] if path.is_file() else None


def facts(name, data):
    """Hash of what a text means, and what it imports.

    Parameters
    ----------
    name : str
        Of its file.
    data : bytes
        The text.

    Returns
    -------
    str, list of [int, str, list of str]
        The hash, and for each import the number of dots, the module and the names; names are empty
        for `import module`.
    """
    suffix = ".smk" if name == "Snakefile" else Path(name).suffix
    key = f"{suffix} {hashlib.sha256(data).hexdigest()}"
    known = _known()
    if key not in known:
        known[key] = _facts(suffix, data)
        known["new"] = True
    return known[key]


def keep():
    """Write down for other processes what `facts` found, if that is possible."""
    known = _known()
    if known.pop("new", False):
        part = _KEPT.with_name(f".{_KEPT.name}.{os.getpid()}.part")
        with suppress(OSError):
            _KEPT.parent.mkdir(exist_ok=True)
            text = json.dumps(known)
            part.write_text(f"{_hash(text)}\n{text}", encoding="utf-8")
            os.replace(part, _KEPT)


@functools.cache
def _known():
    """What `facts` found of texts, by this process and earlier ones."""
    with suppress(OSError, ValueError):
        if _KEPT.is_file():  # reading a FIFO would wait for ever
            digest, text = _KEPT.read_text(encoding="utf-8").split("\n", 1)
            if digest == _hash(text):  # else it is damaged
                return json.loads(text)
    return {}


def _hash(text):
    return hashlib.sha256(text.encode()).hexdigest()


def _facts(suffix, data):
    words, imports = [f"{SCHEME}"], []
    try:
        if suffix == ".py":
            tree = ast.parse(data)
            _describe(tree, words, local=False)
            imports = list(_imports(tree))
        elif suffix == ".smk":
            words += _tokens(data)
        else:
            words.append(data.hex())
    except (SyntaxError, ValueError, RecursionError):  # what cannot be read has its text alone
        words = [f"{SCHEME}", "unreadable", data.hex()]
    return [_hash("\n".join(words)), imports]


def _imports(tree):
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield [0, alias.name, []]
        elif isinstance(node, ast.ImportFrom):
            yield [node.level, node.module or "", [alias.name for alias in node.names]]


def _describe(node, words, local):
    """Append words that tell a node from every other; `local` is whether it is in a function."""
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


def _describe_list(name, values, words, local):
    words.append(f"[{name}")
    for value in values:
        if isinstance(value, ast.AST):
            _describe(value, words, local)
        else:
            words.append(_constant(value))
    words.append("]")


def _constant(value):
    """A word for a constant, the same whatever Python finds printable."""
    if isinstance(value, str):
        text = value.encode("utf-8", "surrogatepass").hex()
    elif isinstance(value, bytes):
        text = value.hex()
    elif isinstance(value, int):
        text = hex(value)
    else:
        text = repr(value)
    return f"{type(value).__name__} {text}"


def _joined(values):
    """The parts of an f-string, neighbouring texts as one: Python's versions split them in ways."""
    found = []
    for value in values:
        if not _is_string(value):
            found.append(value)
        elif found and _is_string(found[-1]):
            found[-1] = ast.Constant(found[-1].value + value.value)
        elif value.value:
            found.append(value)
    return found


def _is_string(node):
    return isinstance(node, ast.Constant) and isinstance(node.value, str)


def _is_text(statement):
    return isinstance(statement, ast.Expr) and _is_string(statement.value)


def _tokens(data):
    """The tokens of a text that count, f-strings as one token each, as before Python 3.12."""
    begins, ends = (getattr(tokenize, f"FSTRING_{name}", None) for name in ("START", "END"))
    text = data.decode("utf-8")
    lines, depth, start = text.splitlines(keepends=True), 0, None
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == begins:
            start = start if depth else token.start
            depth += 1
        elif token.type == ends:
            depth -= 1
            if not depth:
                (row, column), (last, end) = start, token.end
                inside = [*lines[row - 1 : last - 1], lines[last - 1][:end]]
                inside[0] = inside[0][column:]
                yield f"STRING {''.join(inside)}"
        elif not depth and token.type not in _LAYOUT:
            layout = token.type in (tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT)
            yield tokenize.tok_name[token.type] + ("" if layout else f" {token.string}")
