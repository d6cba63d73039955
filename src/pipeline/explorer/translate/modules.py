"""The Python files that are translated: their imports, functions and constants."""

import ast
import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from .values import Function, Scalar, constant, safe


class TranslationError(ValueError):
    """A construct that is not translated. The message is one line with file and line."""


@dataclass
class Module:
    """A Python file: its imports, functions and constants."""

    shown: str  # path in messages
    functions: dict[str, ast.FunctionDef] = field(default_factory=dict)
    modules: dict[str, str] = field(default_factory=dict)  # imported ones by their names here
    others: dict[str, tuple[str, str]] = field(default_factory=dict)  # name -> module, name there
    assignments: list[ast.Assign] = field(default_factory=list)
    constants: dict[str, Any] = field(default_factory=dict)


class Modules:
    """The modules in a folder, and what their names are in JavaScript.

    Messages call the folder `shown`. The parameters called as in `fixed` are None.
    """

    def __init__(self, folder: Path, shown: str, fixed: frozenset[str]) -> None:
        self._folder, self._shown, self.fixed = folder, shown, fixed
        self._modules: dict[str, Module] = {}
        self.constants: dict[str, str] = {}  # JavaScript name -> declaration
        self._names: dict[str, tuple[str, str]] = {}  # JavaScript name -> module and name in it

    def function(self, module: str, name: str) -> Function:
        """Return the translation of a function."""
        raise NotImplementedError

    def definition(self, module: str, name: str) -> tuple[str, str]:
        """Return the module that defines a name of a module, and the name there."""
        others = self.module(module).others
        return self.definition(*others[name]) if name in others else (module, name)

    def has_function(self, module: str, name: str) -> bool:
        """Return whether a name of a module is a function, its own or an imported one."""
        origin, original = self.definition(module, name)
        return original in self.module(origin).functions

    def constant(self, module: str, name: str, node: ast.expr) -> Scalar:
        """Return a constant of a module, which is declared under its name."""
        origin, original = self.definition(module, name)
        values = self._values(origin)
        if original not in values:
            self.refuse(module, node, f"the name {name}")
        value = constant(values[original])
        if value is None:
            kind = type(values[original]).__name__
            self.refuse(module, node, f"the constant {name} of type {kind}")
        code = self.unique(origin, original)
        self.constants[code] = f"const {code} = {value.code};"
        return Scalar(code, value.kind)

    def unique(self, module: str, name: str) -> str:
        """Return the JavaScript name of a name of a module; the second of its kind is prefixed."""
        code = safe(name)
        if self._names.setdefault(code, (module, name)) != (module, name):
            code = f"{module}_{code}"
        return code

    def module(self, name: str) -> Module:
        """Read a module."""
        if name not in self._modules:
            self._modules[name] = _read(self._folder / f"{name}.py", f"{self._shown}/{name}.py")
        return self._modules[name]

    def refuse(self, module: str, node: ast.AST, construct: str) -> NoReturn:
        """Raise the error for a construct."""
        place = f"{self.module(module).shown}:{getattr(node, 'lineno', 1)}"
        raise TranslationError(f"{place}: {construct} is not translated")

    def _values(self, module: str) -> dict[str, Any]:
        """Return the values of a module's assignments."""
        source = self.module(module)
        if not source.constants:
            source.constants |= {"math": math, "np": np}
            for node in source.assignments:
                try:
                    exec(compile(ast.Module([node], []), source.shown, "exec"), source.constants)
                except Exception as error:
                    self.refuse(module, node, f"a constant ({type(error).__name__}: {error})")
        return source.constants


def _read(path: Path, shown: str) -> Module:
    """Parse a file into imports, functions and assignments; refuse other statements."""
    try:
        tree = ast.parse(path.read_text(encoding="utf-8"))
    except SyntaxError as error:
        raise TranslationError(f"{shown}:{error.lineno}: {error.msg}") from None
    source = Module(shown)
    for node in tree.body:
        match node:
            case ast.ImportFrom(level=1, module=None, names=names):
                source.modules |= {each.asname or each.name: each.name for each in names}
            case ast.ImportFrom(level=1, module="compiled"):
                pass  # `jit` only marks functions
            case ast.ImportFrom(level=1, module=str(origin), names=names):
                source.others |= {each.asname or each.name: (origin, each.name) for each in names}
            case ast.Import(names=[ast.alias("math", None) | ast.alias("numpy", "np")]):
                pass
            case ast.FunctionDef(name=name, decorator_list=[] | [ast.Name("jit")]):
                source.functions[name] = node
            case ast.Assign(
                targets=[ast.Name(name)],
                value=ast.Call(ast.Name("jit"), [ast.Attribute(ast.Name(origin), original)], []),
            ):
                source.others[name] = source.modules.get(origin, origin), original
            case ast.Assign():
                source.assignments.append(node)
            case ast.Expr(value=ast.Constant(value=str())):
                pass
            case _:
                word = type(node).__name__
                raise TranslationError(f"{shown}:{node.lineno}: {word} is not translated")
    return source
