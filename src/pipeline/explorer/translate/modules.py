"""The Python files that are translated: their imports, functions and constants."""

import ast
import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from .values import BOOL, FLOAT, INT, LONGS, Scalar, literal, long_literal

# Words that cannot name a variable of a script, and names that the translation uses.
RESERVED = frozenset(
    (
        *("arguments", "await", "case", "catch", "class", "const", "debugger", "default", "delete"),
        *("do", "enum", "eval", "export", "extends", "function", "implements", "import", "in"),
        *("instanceof", "interface", "let", "new", "null", "package", "private", "protected"),
        *("public", "static", "super", "switch", "this", "throw", "try", "typeof", "undefined"),
        *("var", "void", "with", "yield", "BigInt", "BigInt64Array", "Error", "Float64Array"),
        *("Infinity", "Math", "NaN", "Number"),
    )
)


class TranslationError(ValueError):
    """A construct that is not translated. The message is one line with file and line."""


@dataclass
class Module:
    """A Python file: its imports, functions and constants."""

    path: Path
    shown: str  # path in messages
    functions: dict[str, ast.FunctionDef] = field(default_factory=dict)
    aliases: dict[str, tuple[str, str]] = field(default_factory=dict)  # name -> module, function
    imports: dict[str, tuple[str, str | None]] = field(default_factory=dict)  # None: the module
    assignments: list[ast.Assign] = field(default_factory=list)
    constants: dict[str, Any] | None = None


class Modules:
    """The modules in a folder, and what their names are in JavaScript.

    Parameters
    ----------
    folder : Path
        Folder of the package with the functions.
    shown : str
        How messages call the folder.
    fixed : set
        Names of the parameters that are None in the translation.
    """

    def __init__(self, folder: Path, shown: str, fixed: frozenset[str]) -> None:
        self._folder, self._shown, self.fixed = folder, shown, fixed
        self._modules: dict[str, Module] = {}
        self.constants: dict[str, str] = {}  # JavaScript name -> declaration
        self._names: dict[str, tuple[str, str]] = {}  # JavaScript name -> module and name in it

    def has_function(self, module: str, name: str) -> bool:
        """Return whether a name of a module is a function, its own or an imported one."""
        source = self.module(module)
        if name in source.imports and source.imports[name][1]:
            origin, original = source.imports[name]
            return (self._folder / f"{origin}.py").is_file() and self.has_function(
                origin, str(original)
            )
        return name in source.functions or name in source.aliases

    def constant(self, module: str, name: str, node: ast.expr) -> Scalar:
        """Return a constant of a module, which is declared under its name."""
        source = self.module(module)
        if name in source.imports and source.imports[name][1]:
            origin, original = source.imports[name]
            return self.constant(origin, str(original), node)
        values = self._values(module)
        if name not in values:
            self.refuse(source, node, f"the name {name}")
        value = values[name]
        kind = _kind_of_constant(value)
        if kind is None:
            self.refuse(source, node, f"the constant {name} of type {type(value).__name__}")
        code = self.unique(module, name)
        self.constants[code] = f"const {code} = {_literal_of_constant(value, kind)};"
        return Scalar(code, kind)

    def unique(self, module: str, name: str) -> str:
        """Return the JavaScript name of a name of a module; the second of its kind is prefixed."""
        code = f"{name}_" if name in RESERVED else name
        owner = self._names.setdefault(code, (module, name))
        if owner != (module, name):
            code = f"{module}_{code}"
            self._names.setdefault(code, (module, name))
        return code

    def module(self, name: str) -> Module:
        """Read a module."""
        if name not in self._modules:
            path = self._folder / f"{name}.py"
            self._modules[name] = _read(path, f"{self._shown}/{name}.py")
        return self._modules[name]

    def refuse(self, source: Module, node: ast.AST, construct: str) -> NoReturn:
        """Raise the error for a construct."""
        line = getattr(node, "lineno", 1)
        raise TranslationError(f"{source.shown}:{line}: {construct} is not translated")

    def _values(self, module: str) -> dict[str, Any]:
        """Return the values of a module's assignments."""
        source = self.module(module)
        if source.constants is None:
            values: dict[str, Any] = {"math": math, "np": np}
            for node in source.assignments:
                names = {each.id for each in ast.walk(node) if isinstance(each, ast.Name)}
                for used in names & source.imports.keys():
                    origin, original = source.imports[used]
                    if original and not self.has_function(module, used):
                        values[used] = self._values(origin).get(original)
                block = ast.Module([node], [])
                try:
                    exec(compile(block, source.shown, "exec"), values)
                except Exception as error:
                    self.refuse(source, node, f"a constant ({type(error).__name__}: {error})")
            source.constants = values
        return source.constants


def _read(path: Path, shown: str) -> Module:
    """Parse a file into imports, functions and assignments; refuse other statements."""
    try:
        tree = ast.parse(path.read_text(encoding="utf-8"))
    except SyntaxError as error:
        raise TranslationError(f"{shown}:{error.lineno}: {error.msg}") from None
    source = Module(path, shown)
    for node in tree.body:
        match node:
            case ast.ImportFrom(level=1, module=None, names=names):
                source.imports |= {each.asname or each.name: (each.name, None) for each in names}
            case ast.ImportFrom(level=1, module=str(origin), names=names):
                source.imports |= {each.asname or each.name: (origin, each.name) for each in names}
            case ast.Import(names=[ast.alias("math", None) | ast.alias("numpy", "np")]):
                pass
            case ast.FunctionDef(name=name, decorator_list=[] | [ast.Name("jit")]):
                source.functions[name] = node
            case ast.Assign(
                targets=[ast.Name(name)],
                value=ast.Call(
                    func=ast.Name("jit"),
                    args=[ast.Attribute(value=ast.Name(origin), attr=original)],
                    keywords=[],
                ),
            ):
                source.aliases[name] = source.imports.get(origin, (origin, None))[0], original
            case ast.Assign():
                source.assignments.append(node)
            case ast.Expr(value=ast.Constant(value=str())):
                pass
            case _:
                word = type(node).__name__
                raise TranslationError(f"{shown}:{node.lineno}: {word} is not translated")
    return source


def _kind_of_constant(value: Any) -> str | None:
    """Return the kind of a constant, None if there is none."""
    if isinstance(value, np.ndarray) and value.dtype == np.int64 and value.ndim == 1:
        return LONGS
    if isinstance(value, bool):
        return BOOL
    return {int: INT, float: FLOAT}.get(type(value))


def _literal_of_constant(value: Any, kind: str) -> str:
    if kind == LONGS:
        digits = [long_literal(int(each)) for each in value]
        lines = [", ".join(digits[i : i + 8]) for i in range(0, len(digits), 8)]
        return "[\n  " + ",\n  ".join(lines) + ",\n]"
    return str(value).lower() if kind == BOOL else literal(value)
