"""Translation of compiled functions from Python to JavaScript, with the same bits.

The subset of Python is the one in which the kernel computes: numbers, tuples of numbers, 64-bit
integers, and functions of these. Operations keep their order and their grouping. Anything else is
refused with its file and line, so that no construct gets another meaning unnoticed. The rules:

- A double is a JavaScript number, an integer a number too if it only counts, and a BigInt of 64
  bits if it comes from the bits of a double or from an array of integers.
- `max(a, b)` is `b > a ? b : a`, as numba compiles it; Math.max treats NaN and -0 differently.
- A function with several results writes them to the array `$out`, from which the caller reads them
  at once. Tuples exist only during translation: a variable that holds one becomes several.
- Constants of a module become their values. A parameter that is fixed at translation disappears,
  with the branches that it excludes.
"""

import ast
import json
import math
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path
from typing import Any, NoReturn, TypeGuard

import numpy as np

# Kinds of scalars. An `int` may become a `float` or a `long`.
BOOL, INT, FLOAT, LONG, LONGS, NONE = "bool", "int", "float", "long", "longs", "none"
# Precedence of JavaScript's operators.
_TERNARY, _OR, _AND, _EQUAL, _LESS, _SHIFT, _SUM, _PRODUCT, _UNARY, _ATOM = range(2, 12)

_WIDTH = 100  # of a line
_CALL = re.compile(r"(?<![\w$.])(?!(?:Number|BigInt)\()[A-Za-z_]\w*\(")  # of a translated function

PRELUDE = """\
const $out = new Float64Array(32); // several results of one function
const $floats = new Float64Array(1), $longs = new BigInt64Array($floats.buffer);
const $max = (a, b) => b > a ? b : a; // of a NaN and a number, the first
const $min = (a, b) => b < a ? b : a;
const $long = a => BigInt.asIntN(64, a);
const $bitsOf = a => { $floats[0] = a; return $longs[0]; };
const $floatOf = a => { $longs[0] = a; return $floats[0]; };
const $modulo = (a, b) => ((a % b) + b) % b; // of the sign of b
const $quotient = (a, b) => (a - $modulo(a, b)) / b; // rounded down
"""
# Words that cannot name a variable of a script, and names that the translation uses.
_RESERVED = frozenset(
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


@dataclass(frozen=True)
class Scalar:
    """A JavaScript expression, its kind and the precedence of its outermost operator."""

    code: str
    kind: str
    precedence: int = _ATOM


# An expression's value: tuples are lists of values.
Value = Scalar | list["Value"]
# The kind of each number of a value, with the same nesting.
Shape = str | list["Shape"]


@dataclass
class Function:
    """A translated function: its JavaScript name, parameters and result."""

    name: str
    parameters: list[tuple[str, Shape]]
    result: Shape
    code: str


@dataclass
class _Module:
    """A Python file: its imports, functions and constants."""

    path: Path
    shown: str  # path in messages
    functions: dict[str, ast.FunctionDef] = field(default_factory=dict)
    aliases: dict[str, tuple[str, str]] = field(default_factory=dict)  # name -> module, function
    imports: dict[str, tuple[str, str | None]] = field(default_factory=dict)  # None: the module
    assignments: list[ast.Assign] = field(default_factory=list)
    constants: dict[str, Any] | None = None


class Translator:
    """Translate functions of the modules in a folder, with all that they call.

    Parameters
    ----------
    folder : Path
        Folder of the package with the functions.
    shown : str
        How messages call the folder.
    fixed : mapping
        Parameters, by name, that are None in the translation.
    """

    def __init__(self, folder: Path, shown: str, fixed: frozenset[str]) -> None:
        self._folder, self._shown, self.fixed = folder, shown, fixed
        self._modules: dict[str, _Module] = {}
        self._functions: dict[tuple[str, str], Function | None] = {}
        self._constants: dict[str, str] = {}  # JavaScript name -> declaration
        self._names: dict[str, tuple[str, str]] = {}  # JavaScript name -> module and name in it

    def javascript(self) -> str:
        """Return constants and functions translated so far, each after those that it uses."""
        functions = [each.code for each in self._functions.values() if each]
        return "\n".join([PRELUDE, *self._constants.values(), "", *functions])

    def function(self, module: str, name: str) -> Function:
        """Translate a function of a module, unless that is done, and return it."""
        source = self.module(module)
        if name in source.aliases:
            return self.function(*source.aliases[name])
        if name in source.imports and source.imports[name][1]:
            origin, original = source.imports[name]
            return self.function(origin, str(original))
        key = module, name
        if key in self._functions:
            known = self._functions[key]
            if known is None:
                self.refuse(source, source.functions[name], f"the recursive function {name}")
            return known
        if name not in source.functions:
            raise TranslationError(f"{source.shown}: there is no function {name}")
        self._functions[key] = None
        translated = _FunctionTranslator(self, module, source.functions[name]).translate()
        del self._functions[key]  # so that it stands after the functions that it calls
        self._functions[key] = translated
        return translated

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
        self._constants[code] = f"const {code} = {_literal_of_constant(value, kind)};"
        return Scalar(code, kind)

    def unique(self, module: str, name: str) -> str:
        """Return the JavaScript name of a name of a module; the second of its kind is prefixed."""
        code = f"{name}_" if name in _RESERVED else name
        owner = self._names.setdefault(code, (module, name))
        if owner != (module, name):
            code = f"{module}_{code}"
            self._names.setdefault(code, (module, name))
        return code

    def module(self, name: str) -> _Module:
        """Read a module."""
        if name not in self._modules:
            path = self._folder / f"{name}.py"
            self._modules[name] = _read(path, f"{self._shown}/{name}.py")
        return self._modules[name]

    def refuse(self, source: _Module, node: ast.AST, construct: str) -> NoReturn:
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


def _read(path: Path, shown: str) -> _Module:
    """Parse a file into imports, functions and assignments; refuse other statements."""
    try:
        tree = ast.parse(path.read_text(encoding="utf-8"))
    except SyntaxError as error:
        raise TranslationError(f"{shown}:{error.lineno}: {error.msg}") from None
    source = _Module(path, shown)
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
        digits = [_long_literal(int(each)) for each in value]
        lines = [", ".join(digits[i : i + 8]) for i in range(0, len(digits), 8)]
        return "[\n  " + ",\n  ".join(lines) + ",\n]"
    return str(value).lower() if kind == BOOL else _literal(value)


def _literal(value: int | float) -> str:
    """Return a number as JavaScript reads it; both languages round decimals correctly."""
    if isinstance(value, int):
        return str(value)
    if math.isnan(value):
        return "NaN"
    return repr(value).replace("inf", "Infinity")


def _long_literal(value: int) -> str:
    """Return a 64-bit integer as JavaScript reads it: masks and digits are clearer in base 16."""
    return f"{hex(value) if value > 255 else value}n"


def _leaves(value: Value) -> list[Scalar]:
    """Return the scalars of a value, in order."""
    if isinstance(value, Scalar):
        return [value]
    return [leaf for each in value for leaf in _leaves(each)]


def _kinds(shape: Shape) -> list[str]:
    """Return the kinds of the scalars of a shape, in order."""
    return [shape] if isinstance(shape, str) else [kind for each in shape for kind in _kinds(each)]


def _shape(value: Value) -> Shape:
    return value.kind if isinstance(value, Scalar) else [_shape(each) for each in value]


def _filled(shape: Shape, scalars: Iterator[Scalar]) -> Value:
    """Return a value of a shape from its scalars in order."""
    if isinstance(shape, str):
        return next(scalars)
    return [_filled(each, scalars) for each in shape]


def _names_of(name: str, shape: Shape) -> Value:
    """Return the variables that hold a value of a shape: `a`, or `a_0`, `a_1`, ..."""
    if isinstance(shape, str):
        return Scalar(name, shape)
    return [_names_of(f"{name}_{i}", each) for i, each in enumerate(shape)]


class _FunctionTranslator:
    """Translate one function. The shapes of its variables are inferred first, by repetition."""

    def __init__(self, all_functions: Translator, module: str, node: ast.FunctionDef) -> None:
        self._all, self._module = all_functions, module
        self._source = all_functions.module(module)
        body = _without_fixed(node.body, all_functions.fixed)
        self._node = ast.FunctionDef(node.name, node.args, body, [], lineno=node.lineno)
        self._shapes: dict[str, Shape] = {}
        self._result: Shape | None = None
        self._globals: set[str] = set()  # functions and constants that it uses
        self._reset()

    def _reset(self) -> None:
        self._lines: list[str] = []
        self._indent = 1
        self._conditional = 0  # depth of expressions that may not be evaluated
        self._temporaries = count(1)
        self._declared: set[str] = set()
        self._hoisted: list[str] = []

    def translate(self) -> Function:
        """Return the translated function."""
        node = self._node
        arguments = node.args
        if arguments.defaults or arguments.kwonlyargs or arguments.vararg or arguments.kwarg:
            self._refuse(node, "a default, keyword or variable argument")
        names = [each.arg for each in arguments.args]
        widths = self._tuple_parameters(names)
        for name in names:
            if name in self._all.fixed:
                self._shapes[name] = NONE
            else:
                self._shapes[name] = [FLOAT] * widths[name] if name in widths else FLOAT
        self._parameters = {*names}
        while True:
            before = repr((self._shapes, self._result))
            self._reset()
            self._block(node.body)
            if repr((self._shapes, self._result)) == before:
                break
        if self._result is None:
            self._refuse(node, f"{node.name}, which returns nothing,")
        variables = [
            leaf.code
            for name, shape in self._shapes.items()
            if shape != NONE
            for leaf in _leaves(_names_of(name, shape))
        ]
        for variable in variables:  # `a_0` may be a part of `a`, or a function that is called
            if variables.count(variable) > 1 or variable in self._globals:
                self._refuse(node, f"{node.name}, in which {variable} has two meanings,")
        parameters = [(name, self._shapes[name]) for name in names]
        name = self._all.unique(self._module, node.name)
        return Function(name, parameters, self._result, self._text(name, parameters))

    def _text(self, name: str, parameters: list[tuple[str, Shape]]) -> str:
        leaves = [leaf for each in parameters for leaf in _leaves(_names_of(*each))]
        given = [self._safe(leaf.code) for leaf in leaves if leaf.kind != NONE]
        summary = (ast.get_docstring(self._node) or "").partition("\n")[0]
        head = [f"// {summary}"] if summary else []
        head.append(f"function {name}({', '.join(given)}) {{")
        if self._hoisted:
            head.append(f"  let {', '.join(self._hoisted)};")
        body = "\n".join(self._lines).removesuffix("\n  return;")
        for variable in self._declared - {*self._hoisted}:
            if len(re.findall(rf"(?<![\w$.]){re.escape(variable)} = ", body)) == 1:
                body = body.replace(f"let {variable} = ", f"const {variable} = ")
        for word in ("const", "let"):  # one declaration for all variables of a line
            while (joined := re.sub(rf"({word} [^;\n]*); {word} ", r"\1, ", body)) != body:
                body = joined
        return "\n".join([*head, body, "}", ""])

    def _tuple_parameters(self, names: list[str]) -> dict[str, int]:
        """Return the parameters that are tuples, and their lengths."""
        widths: dict[str, int] = {}
        for node in ast.walk(self._node):
            match node:
                case ast.Assign(targets=[ast.Tuple(elts=targets)], value=ast.Name(name)):
                    if name in names:
                        widths[name] = len(targets)
                case ast.Call(func=ast.Name(called), args=args) if self._is_function(called):
                    expected = [shape for _, shape in self._callee(called).parameters]
                    at = 0
                    for given in args:
                        match given:
                            case ast.Name(name) if name in names and at < len(expected):
                                shape = expected[at]
                                if isinstance(shape, list):
                                    widths[name] = len(shape)
                            case ast.Starred(value=ast.Name(name)) if name in names:
                                widths[name] = len(expected) - len(args) + 1
                        starred = isinstance(given, ast.Starred)
                        at += len(expected) - len(args) + 1 if starred else 1
        return widths

    def _callee(self, name: str) -> Function:
        return self._all.function(self._module, name)

    def _is_function(self, name: str) -> bool:
        return self._all.has_function(self._module, name)

    def _refuse(self, node: ast.AST, construct: str) -> NoReturn:
        self._all.refuse(self._source, node, construct)

    def _safe(self, name: str) -> str:
        return f"{name}_" if name in _RESERVED else name

    # Statements

    def _emit(self, line: str) -> None:
        self._lines.append("  " * self._indent + line)

    def _emit_joined(self, statements: list[str]) -> None:
        """Write short statements, several on a line."""
        for statement in statements:
            line = self._lines[-1] if statement != statements[0] else ""
            if line and len(line) + 1 + len(statement) <= _WIDTH:
                self._lines[-1] += f" {statement}"
            else:
                self._emit(statement)

    @contextmanager
    def _deeper(self) -> Iterator[None]:
        self._indent += 1
        yield
        self._indent -= 1

    def _block(self, body: list[ast.stmt]) -> None:
        for node in body:
            self._statement(node)

    def _statement(self, node: ast.stmt) -> None:
        match node:
            case ast.Expr(value=ast.Constant(value=str())):
                pass
            case ast.Assign(targets=targets, value=value):
                self._assign(targets, value)
            case ast.AugAssign(target=target, op=op, value=value):
                load = ast.parse(ast.unparse(target), mode="eval").body
                combined = ast.BinOp(load, op, value)
                self._assign([target], ast.copy_location(combined, node))
            case ast.Return(value=value):
                self._return(node, value)
            case ast.If():
                self._if(node)
            case ast.While(test=test, body=body, orelse=[]):
                with self._unevaluated():
                    condition = self._condition(test)
                self._emit(f"while ({condition.code}) {{")
                with self._deeper():
                    self._block(body)
                self._emit("}")
            case ast.For(target=ast.Name(name), iter=over, body=body, orelse=[]):
                self._for(node, name, over, body)
            case ast.Break():
                self._emit("break;")
            case ast.Continue():
                self._emit("continue;")
            case ast.Raise(
                exc=ast.Call(func=ast.Name("ArithmeticError"), args=[ast.Constant(value=str(text))])
            ):
                self._emit(f"throw new Error({json.dumps(text)});")
            case _:
                self._refuse(node, type(node).__name__)

    def _if(self, node: ast.If) -> None:
        condition = self._condition(node.test)
        self._emit(f"if ({condition.code}) {{")
        with self._deeper():
            self._block(node.body)
        if node.orelse:
            self._emit("} else {")
            with self._deeper():
                self._block(node.orelse)
        self._emit("}")

    def _for(self, node: ast.For, name: str, over: ast.expr, body: list[ast.stmt]) -> None:
        match over:
            case ast.Call(func=ast.Name("range"), args=[_, *_] as args, keywords=[]):
                numbers = [ast.literal_eval(a) if _is_number(a) else None for a in args]
            case _:
                self._refuse(over, "a loop over anything but range")
        inside = {id(each) for each in ast.walk(node)}
        for each in ast.walk(self._node):
            if isinstance(each, ast.Name) and each.id == name and id(each) not in inside:
                loops = [n for n in ast.walk(self._node) if isinstance(n, ast.For) and n != node]
                if not any(id(each) in {id(n) for n in ast.walk(loop)} for loop in loops):
                    self._refuse(each, f"{name} outside its loop")
        step = numbers[2] if len(args) == 3 else 1
        if not isinstance(step, int) or step == 0:
            self._refuse(over, "a step that is no number")
        start = self._number(args[0], INT).code if len(args) > 1 else "0"
        stop = self._number(args[1] if len(args) > 1 else args[0], INT).code
        self._shapes[name] = INT
        variable = self._safe(name)
        sign, change = ("<", f"+= {step}") if step > 0 else (">", f"-= {-step}")
        self._emit(
            f"for (let {variable} = {start}; {variable} {sign} {stop}; {variable} {change}) {{"
        )
        with self._deeper():
            self._block(body)
        self._emit("}")

    def _return(self, node: ast.stmt, value: ast.expr | None) -> None:
        if value is None:
            self._refuse(node, "a return of nothing")
        if isinstance(value, ast.Call) and (called := self._called(value)):
            function = self._callee(called)
            if isinstance(function.result, list):
                self._join_result(node, function.result)
                if self._result == function.result:  # its results are already in place
                    self._emit(f"return {self._call_code(function, value)};")
                    return
        result = self._value(value)
        self._join_result(node, _shape(result))
        assert self._result is not None
        kinds = _kinds(self._result)
        if isinstance(result, Scalar):
            self._emit(f"return {self._coerced(node, result, kinds[0]).code};")
            return
        if LONG in kinds:
            self._refuse(node, "a 64-bit integer among several results")
        scalars = _leaves(result)
        if any(_CALL.search(scalar.code) for scalar in scalars):
            scalars = self._all_kept(scalars)  # a call may overwrite `$out`
        stores = [f"$out[{i}] = {scalar.code};" for i, scalar in enumerate(scalars)]
        self._emit_joined(stores)
        self._emit("return;")

    def _join_result(self, node: ast.AST, shape: Shape) -> None:
        known = self._result
        self._result = shape if known is None else self._joined(node, known, shape)

    # Assignments

    def _assign(self, targets: list[ast.expr], value: ast.expr) -> None:
        if isinstance(value, ast.Call) and len(targets) == 1:
            result = self._call(value, keep=False)
        else:
            result = self._value(value)
        for target in targets:
            match target:
                case ast.Name(name):
                    self._bind(target, [(name, result)])
                case ast.Tuple(elts=names):
                    if not isinstance(result, list) or len(result) != len(names):
                        self._refuse(target, "an assignment to another number of variables")
                    pairs = []
                    for each, part in zip(names, result, strict=True):
                        if not isinstance(each, ast.Name):
                            self._refuse(each, type(each).__name__)
                        pairs.append((each.id, part))
                    self._bind(target, pairs)
                case ast.Subscript(value=ast.Name(name), slice=index):
                    if self._shapes.get(name) != LONGS or not isinstance(result, Scalar):
                        self._refuse(target, "an assignment to an element")
                    code = self._coerced(target, result, LONG).code
                    at = self._index(index)
                    self._emit(f"{self._safe(name)}[{at}] = {code};")
                case _:
                    self._refuse(target, type(target).__name__)

    def _bind(self, node: ast.AST, pairs: list[tuple[str, Value]]) -> None:
        """Assign values to variables at once."""
        moves: list[tuple[str, Scalar]] = []
        for name, value in pairs:
            if name == "_":
                continue
            if name in self._all.fixed:
                self._refuse(node, f"an assignment to {name}")
            shape = _shape(value)
            known = self._shapes.get(name)
            self._shapes[name] = shape if known is None else self._joined(node, known, shape)
            variables = _leaves(_names_of(name, self._shapes[name]))
            for variable, scalar in zip(variables, _leaves(value), strict=True):
                code = self._safe(variable.code)
                moves.append((code, self._coerced(node, scalar, variable.kind)))
        for i, (variable_code, _) in enumerate(moves):
            later = [scalar for _, scalar in moves[i + 1 :]]
            if any(_mentions(scalar.code, variable_code) for scalar in later):
                kept = self._all_kept([scalar for _, scalar in moves])
                moves = [(name, scalar) for (name, _), scalar in zip(moves, kept, strict=True)]
                break
        self._emit_joined(
            [f"{self._declaration(code)}{code} = {scalar.code};" for code, scalar in moves]
        )

    def _declaration(self, variable: str) -> str:
        """Return `let ` where a variable is declared: at its first assignment, or at the top."""
        parameters = {
            self._safe(leaf.code)
            for name in self._parameters
            for leaf in _leaves(_names_of(name, self._shapes[name]))
        }
        if variable in self._declared or variable in parameters:
            return ""
        self._declared.add(variable)
        if self._indent == 1:
            return "let "
        self._hoisted.append(variable)
        return ""

    def _kept(self, scalar: Scalar) -> Scalar:
        """Return a constant that holds a scalar."""
        return self._all_kept([scalar])[0]

    def _all_kept(self, scalars: list[Scalar]) -> list[Scalar]:
        """Return constants that hold scalars."""
        names = [f"$t{next(self._temporaries)}" for _ in scalars]
        pairs = [f"{name} = {scalar.code}" for name, scalar in zip(names, scalars, strict=True)]
        self._emit(f"const {', '.join(pairs)};")
        return [Scalar(name, scalar.kind) for name, scalar in zip(names, scalars, strict=True)]

    def _joined(self, node: ast.AST, one: Shape, other: Shape) -> Shape:
        """Return the shape that holds values of both shapes."""
        if isinstance(one, list) and isinstance(other, list) and len(one) == len(other):
            return [self._joined(node, a, b) for a, b in zip(one, other, strict=True)]
        if isinstance(one, str) and isinstance(other, str):
            if one == other:
                return one
            pair = {one, other}
            if pair == {INT, FLOAT}:
                return FLOAT
            if pair == {INT, LONG}:
                return LONG
        self._refuse(node, f"a variable that is both {_word(one)} and {_word(other)}")

    def _coerced(self, node: ast.AST, scalar: Scalar, kind: str) -> Scalar:
        """Convert a scalar to a kind."""
        if scalar.kind == kind or (scalar.kind, kind) == (INT, FLOAT):
            return scalar
        if (scalar.kind, kind) == (INT, LONG):
            if scalar.code.isdigit():
                return Scalar(_long_literal(int(scalar.code)), LONG)
            return Scalar(f"BigInt({scalar.code})", LONG)
        if (scalar.kind, kind) == (LONG, FLOAT):
            return Scalar(f"Number({scalar.code})", FLOAT)
        self._refuse(node, f"{_word(scalar.kind)} where {_word(kind)} is needed")

    # Expressions

    @contextmanager
    def _unevaluated(self) -> Iterator[None]:
        """Mark expressions that may not be evaluated, or more than once."""
        self._conditional += 1
        yield
        self._conditional -= 1

    def _number(self, node: ast.expr, *kinds: str) -> Scalar:
        """Translate an expression that is one number, of given kinds if there are any."""
        value = self._value(node)
        if not isinstance(value, Scalar) or value.kind not in (kinds or (INT, FLOAT, LONG)):
            self._refuse(node, f"{_word(_shape(value))} here")
        return value

    def _condition(self, node: ast.expr) -> Scalar:
        """Translate a condition: a comparison, or a 64-bit integer that is not 0."""
        value = self._number(node, BOOL, LONG)
        if value.kind == LONG:
            return Scalar(f"{self._grouped(value, _EQUAL + 1)} !== 0n", BOOL, _EQUAL)
        return value

    @staticmethod
    def _grouped(scalar: Scalar, precedence: int) -> str:
        """Return the code of an operand, in parentheses where it binds less than `precedence`."""
        return scalar.code if scalar.precedence >= precedence else f"({scalar.code})"

    def _value(self, node: ast.expr) -> Value:
        match node:
            case ast.Constant(value=bool(truth)):
                return Scalar(str(truth).lower(), BOOL)
            case ast.Constant(value=int() | float() as number):
                return Scalar(_literal(number), INT if isinstance(number, int) else FLOAT)
            case ast.Name(name):
                return self._name(node, name)
            case ast.Attribute(value=ast.Name("math"), attr="inf" | "nan" as name):
                return Scalar({"inf": "Infinity", "nan": "NaN"}[name], FLOAT)
            case ast.Tuple(elts=elements):
                return self._tuple(elements)
            case ast.BinOp(left=left, op=op, right=right):
                return self._operation(node, left, op, right)
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                value = self._number(operand)
                if value.kind == INT and not isinstance(operand, ast.Constant):  # -0 is 0
                    return Scalar(f"0 - {self._grouped(value, _PRODUCT)}", INT, _SUM)
                code = f"-{self._grouped(value, _UNARY + 1)}"
                return Scalar(code, value.kind, _UNARY)
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                condition = self._condition(operand)
                return Scalar(f"!{self._grouped(condition, _UNARY + 1)}", BOOL, _UNARY)
            case ast.BoolOp(op=op, values=values):
                return self._logic(op, values)
            case ast.Compare(left=left, ops=ops, comparators=others):
                return self._comparison(node, left, ops, others)
            case ast.IfExp(test=test, body=body, orelse=orelse):
                return self._choice(node, test, body, orelse)
            case ast.Subscript(value=ast.Name(name), slice=index):
                return self._element(node, name, index)
            case ast.Call():
                return self._call(node)
        self._refuse(node, type(node).__name__)

    def _name(self, node: ast.expr, name: str) -> Value:
        if name in self._shapes:
            shape = self._shapes[name]
            if shape == NONE:
                return Scalar("null", NONE)
            variables = [
                Scalar(self._safe(leaf.code), leaf.kind) for leaf in _leaves(_names_of(name, shape))
            ]
            return _filled(shape, iter(variables))
        constant = self._all.constant(self._module, name, node)
        self._globals.add(constant.code)
        return constant

    def _tuple(self, elements: list[ast.expr]) -> list[Value]:
        values: list[Value] = []
        for element in elements:
            if isinstance(element, ast.Starred):
                value = self._value(element.value)
                if not isinstance(value, list):
                    self._refuse(element, "a star before a number")
                values += value
            else:
                values.append(self._value(element))
        return values

    def _operation(
        self, node: ast.expr, left: ast.expr, op: ast.operator, right: ast.expr
    ) -> Scalar:
        if isinstance(op, ast.Pow):
            if not (_is_number(left) and _is_number(right)):
                self._refuse(node, "a power of anything but two numbers")
            power = ast.literal_eval(left) ** ast.literal_eval(right)
            if not isinstance(power, int | float):
                self._refuse(node, "this power")
            return Scalar(_literal(power), INT if isinstance(power, int) else FLOAT)
        if isinstance(op, ast.BitAnd | ast.BitOr):
            a, b = self._value(left), self._value(right)
            if _shape(a) == _shape(b) == BOOL:
                return self._joined_conditions(op, a, b)
        a, b = self._number(left), self._number(right)
        kind = LONG if LONG in (a.kind, b.kind) else INT
        if FLOAT in (a.kind, b.kind) or isinstance(op, ast.Div):
            kind = FLOAT
        if isinstance(op, ast.Div) and LONG in (a.kind, b.kind):
            self._refuse(node, "the division of 64-bit integers")
        a, b = self._coerced(node, a, kind), self._coerced(node, b, kind)
        symbols: dict[type[ast.operator], tuple[str, int]] = {
            ast.Add: ("+", _SUM), ast.Sub: ("-", _SUM),
            ast.Mult: ("*", _PRODUCT), ast.Div: ("/", _PRODUCT),
        }  # fmt: skip
        if type(op) in symbols:
            symbol, precedence = symbols[type(op)]
            code = f"{self._grouped(a, precedence)} {symbol} {self._grouped(b, precedence + 1)}"
            if kind == LONG:
                return Scalar(f"$long({code})", LONG)
            if kind == INT and isinstance(op, ast.Mult):  # an integer has no -0
                return Scalar(f"{code} + 0", INT, _SUM)
            return Scalar(code, kind, precedence)
        if kind != LONG:
            self._refuse(node, f"{type(op).__name__} of anything but 64-bit integers")
        one, other = self._grouped(a, _ATOM), self._grouped(b, _ATOM)
        match op:
            case ast.BitAnd():
                return Scalar(f"{one} & {other}", LONG, _OR)
            case ast.BitOr():
                return Scalar(f"{one} | {other}", LONG, _OR)
            case ast.RShift():
                return Scalar(f"{one} >> {other}", LONG, _SHIFT)
            case ast.LShift():
                return Scalar(f"$long({one} << {other})", LONG)
            case ast.FloorDiv():
                return Scalar(f"$quotient({a.code}, {b.code})", LONG)
            case ast.Mod():
                return Scalar(f"$modulo({a.code}, {b.code})", LONG)
        self._refuse(node, type(op).__name__)

    def _joined_conditions(self, op: ast.AST, *values: Value) -> Scalar:
        """Join conditions by `&&` or `||`; without side effects, all may as well be evaluated."""
        both = isinstance(op, ast.And | ast.BitAnd)
        symbol, precedence = ("&&", _AND) if both else ("||", _OR)
        scalars = [leaf for value in values for leaf in _leaves(value)]
        code = f" {symbol} ".join(self._grouped(each, precedence + 1) for each in scalars)
        return Scalar(code, BOOL, precedence)

    def _logic(self, op: ast.boolop, values: list[ast.expr]) -> Scalar:
        conditions = [self._condition(values[0])]
        with self._unevaluated():
            conditions += [self._condition(each) for each in values[1:]]
        return self._joined_conditions(op, *conditions)

    def _comparison(
        self, node: ast.expr, left: ast.expr, ops: list[ast.cmpop], others: list[ast.expr]
    ) -> Scalar:
        match ops, others:
            case [ast.In()], [ast.Tuple(elts=elements)]:
                pairs = [self._compared(node, left, ast.Eq(), each) for each in elements]
                return self._joined_conditions(ast.Or(), *pairs)
        with self._unevaluated():  # the middle of a chain is written twice
            operands = [left, *others]
            pairs = [
                self._compared(node, a, op, b)
                for a, op, b in zip(operands, ops, others, strict=False)
            ]
        return pairs[0] if len(pairs) == 1 else self._joined_conditions(ast.And(), *pairs)

    def _compared(self, node: ast.expr, left: ast.expr, op: ast.cmpop, right: ast.expr) -> Scalar:
        symbols: dict[type[ast.cmpop], tuple[str, int]] = {
            ast.Lt: ("<", _LESS), ast.LtE: ("<=", _LESS), ast.Gt: (">", _LESS),
            ast.GtE: (">=", _LESS), ast.Eq: ("===", _EQUAL), ast.NotEq: ("!==", _EQUAL),
        }  # fmt: skip
        if type(op) not in symbols:
            self._refuse(node, f"the comparison {type(op).__name__}")
        a, b = self._number(left), self._number(right)
        if LONG in (a.kind, b.kind):
            a, b = self._coerced(node, a, LONG), self._coerced(node, b, LONG)
        symbol, precedence = symbols[type(op)]
        code = f"{self._grouped(a, _SHIFT)} {symbol} {self._grouped(b, _SHIFT)}"
        return Scalar(code, BOOL, precedence)

    def _choice(self, node: ast.expr, test: ast.expr, body: ast.expr, orelse: ast.expr) -> Value:
        condition = self._condition(test)
        with self._unevaluated():
            one, other = self._value(body), self._value(orelse)
        shape = self._joined(node, _shape(one), _shape(other))
        kinds = _kinds(shape)
        if len(kinds) > 1 and condition.precedence < _ATOM:
            condition = self._kept(condition)
        scalars = []
        for a, b, kind in zip(_leaves(one), _leaves(other), kinds, strict=True):
            parts = condition, self._coerced(node, a, kind), self._coerced(node, b, kind)
            test_code, yes, no = (self._grouped(each, _OR) for each in parts)
            scalars.append(Scalar(f"{test_code} ? {yes} : {no}", kind, _TERNARY))
        return _filled(shape, iter(scalars))

    def _index(self, node: ast.expr) -> str:
        at = self._number(node, INT, LONG)
        return f"Number({at.code})" if at.kind == LONG else at.code

    def _element(self, node: ast.expr, name: str, index: ast.expr) -> Value:
        value = self._name(node, name)
        if isinstance(value, list):
            match index:
                case ast.Constant(value=int(i)) if i < len(value):
                    return value[i]
                case ast.Slice(lower=None | ast.Constant(), upper=None | ast.Constant(), step=None):
                    first, last = (
                        int(str(each.value)) if isinstance(each, ast.Constant) else None
                        for each in (index.lower, index.upper)
                    )
                    return value[first:last]
        elif value.kind == LONGS:
            return Scalar(f"{value.code}[{self._index(index)}]", LONG)
        self._refuse(node, "this element")

    # Calls

    def _called(self, node: ast.Call) -> str | None:
        """Return the name of the translated function that is called, if it is one."""
        if isinstance(node.func, ast.Name) and self._is_function(node.func.id):
            return node.func.id
        return None

    def _call(self, node: ast.Call, keep: bool = True) -> Value:
        """Translate a call; several results are kept in constants, or read by the caller."""
        if called := self._called(node):
            function = self._callee(called)
            code = self._call_code(function, node)
            if isinstance(function.result, str):
                return Scalar(code, function.result)
            if self._conditional:
                self._refuse(node, f"{called}, with several results, in a condition or a choice,")
            self._emit(f"{code};")
            kinds = _kinds(function.result)
            read = [Scalar(f"$out[{i}]", kind) for i, kind in enumerate(kinds)]
            if keep:
                read = self._all_kept(read)
            return _filled(function.result, iter(read))
        if node.keywords:
            self._refuse(node, "a keyword argument")
        match node.func, node.args:
            case ast.Name("abs"), [a]:
                return Scalar(f"Math.abs({self._number(a, FLOAT).code})", FLOAT)
            case ast.Name("max" | "min" as name), [a, b]:
                one, other = self._number(a, INT, FLOAT), self._number(b, INT, FLOAT)
                kind = INT if one.kind == other.kind == INT else FLOAT
                return Scalar(f"${name}({one.code}, {other.code})", kind)
            case ast.Name("float"), [a]:
                return self._coerced(node, self._number(a), FLOAT)
            case ast.Attribute(value=ast.Name("math" | "np"), attr="sqrt"), [a]:
                return Scalar(f"Math.sqrt({self._number(a, INT, FLOAT).code})", FLOAT)
            case ast.Attribute(value=ast.Name("math"), attr="isnan"), [a]:
                return Scalar(f"Number.isNaN({self._number(a, FLOAT).code})", BOOL)
            case (
                ast.Attribute(value=ast.Name("np"), attr="zeros"),
                [size, ast.Attribute(value=ast.Name("np"), attr="int64")],
            ):
                return Scalar(f"new BigInt64Array({self._number(size, INT).code})", LONGS)
            case (
                ast.Attribute(
                    value=ast.Call(
                        func=ast.Attribute(value=ast.Name("np"), attr=origin), args=[a], keywords=[]
                    ),
                    attr="view",
                ),
                [ast.Attribute(value=ast.Name("np"), attr=target)],
            ):
                if (origin, target) == ("float64", "int64"):
                    return Scalar(f"$bitsOf({self._number(a, FLOAT).code})", LONG)
                if (origin, target) == ("int64", "float64"):
                    return Scalar(f"$floatOf({self._number(a, LONG).code})", FLOAT)
        self._refuse(node, f"the call of {ast.unparse(node.func)}")

    def _call_code(self, function: Function, node: ast.Call) -> str:
        if node.keywords:
            self._refuse(node, "a keyword argument")
        self._globals.add(function.name)
        values = self._tuple(node.args)
        shapes = [shape for _, shape in function.parameters]
        if len(values) != len(shapes):
            self._refuse(node, f"a call of {function.name} with another number of arguments")
        codes = []
        for value, shape in zip(values, shapes, strict=True):
            if len(_leaves(value)) != len(_kinds(shape)):
                self._refuse(node, f"this argument of {function.name}")
            if shape == NONE and _shape(value) == NONE:
                continue
            for leaf, kind in zip(_leaves(value), _kinds(shape), strict=True):
                if leaf.kind in (LONG, LONGS, BOOL):
                    self._refuse(node, f"{_word(leaf.kind)} as an argument")
                codes.append(self._coerced(node, leaf, kind).code)
        return f"{function.name}({', '.join(codes)})"


def _is_number(node: ast.expr) -> TypeGuard[ast.expr]:
    """Return whether an expression is a literal number, with or without a sign."""
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        node = node.operand
    return isinstance(node, ast.Constant) and type(node.value) in (int, float)


def _mentions(code: str, name: str) -> bool:
    """Return whether JavaScript code has a name in it."""
    separated = "".join(c if c.isalnum() or c in "_$" else " " for c in code)
    return name in separated.split()


def _word(shape: Shape) -> str:
    """Return how a message calls a shape."""
    if isinstance(shape, list):
        return f"{len(shape)} values"
    names: Mapping[str, str] = {
        BOOL: "a condition", INT: "an integer", FLOAT: "a number", LONG: "a 64-bit integer",
        LONGS: "an array of integers", NONE: "None",
    }  # fmt: skip
    return names[shape]


def _without_fixed(body: list[ast.stmt], fixed: frozenset[str]) -> list[ast.stmt]:
    """Return statements without those that are excluded because some parameters are None."""
    kept = []
    for node in body:
        match node:
            case ast.If(
                test=ast.Compare(
                    left=ast.Name(name), ops=[ast.Is()], comparators=[ast.Constant(value=None)]
                ),
                body=inner,
            ) if name in fixed:
                kept += _without_fixed(inner, fixed)
                if isinstance(inner[-1], ast.Return):
                    break
            case _:
                kept.append(node)
    return kept
