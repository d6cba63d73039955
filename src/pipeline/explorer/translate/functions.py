"""Functions: their statements, parameters and results."""

import ast
import json
import re
from collections.abc import Iterable

from .expressions import ExpressionTranslator, is_number
from .modules import Modules
from .values import (
    FLOAT,
    INT,
    LONG,
    LONGS,
    Function,
    Scalar,
    Shape,
    Value,
    kinds_of,
    leaves_of,
    safe,
    shape_of,
    variables_of,
)

_CALL = re.compile(r"(?<![\w$.])(?!(?:Number|BigInt)\()[A-Za-z_]\w*\(")  # of a translated function


class FunctionTranslator(ExpressionTranslator):
    """Translate one function. The shapes of its variables are inferred first, by repetition."""

    def __init__(self, modules: Modules, module: str, node: ast.FunctionDef) -> None:
        super().__init__(modules, module)
        body = _without_fixed(node.body, modules.fixed)
        self._node = ast.FunctionDef(node.name, node.args, body, [], lineno=node.lineno)
        self._result: Shape | None = None

    def _reset(self) -> None:
        super()._reset()
        self._declared: set[str] = set()
        self._hoisted: list[str] = []

    def translate(self) -> Function:
        """Return the translated function."""
        node, arguments = self._node, self._node.args
        if arguments.defaults or arguments.kwonlyargs or arguments.vararg or arguments.kwarg:
            self._refuse(node, "a default, keyword or variable argument")
        names = [each.arg for each in arguments.args if each.arg not in self._modules.fixed]
        self._parameters = names
        self._shapes = dict.fromkeys(names, FLOAT) | self._tuple_parameters(names)
        before = ""
        while repr((self._shapes, self._result)) != before:
            before = repr((self._shapes, self._result))
            self._reset()
            self._block(node.body)
        if self._result is None:
            self._refuse(node, f"{node.name}, which returns nothing,")
        variables = self._variables(self._shapes)
        for variable in variables:  # `a_0` may be a part of `a`, or a function that is called
            if variables.count(variable) > 1 or variable in self._globals:
                self._refuse(node, f"{node.name}, in which {variable} has two meanings,")
        parameters = [self._shapes[name] for name in names]
        name = self._modules.unique(self._module, node.name)
        return Function(name, parameters, self._result, self._text(name))

    def _variables(self, names: Iterable[str]) -> list[str]:
        """Return the JavaScript variables that hold some variables."""
        values: list[Value] = [variables_of(name, self._shapes[name]) for name in names]
        return [leaf.code for leaf in leaves_of(values)]

    def _text(self, name: str) -> str:
        given = self._variables(self._parameters)
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

    def _tuple_parameters(self, names: list[str]) -> dict[str, Shape]:
        """Return the shapes of the parameters that are tuples."""
        widths: dict[str, int] = {}
        for node in ast.walk(self._node):
            match node:
                case ast.Assign(targets=[ast.Tuple(elts=targets)], value=ast.Name(name)):
                    if name in names:
                        widths[name] = len(targets)
                case ast.Call() if called := self._called(node):
                    args, expected, at = self._arguments(node), called.parameters, 0
                    for given in args:
                        several = len(expected) - len(args) + 1  # behind a star
                        match given:
                            case ast.Name(name) if name in names and at < len(expected):
                                shape = expected[at]
                                if isinstance(shape, list):
                                    widths[name] = len(shape)
                            case ast.Starred(value=ast.Name(name)) if name in names:
                                widths[name] = several
                        at += several if isinstance(given, ast.Starred) else 1
        return {name: [FLOAT] * width for name, width in widths.items()}

    # Statements

    def _block(self, body: list[ast.stmt]) -> None:
        for node in body:
            self._statement(node)

    def _braced(self, head: str, body: list[ast.stmt]) -> None:
        """Write a head that ends in a brace, and its body."""
        self._emit(head)
        self._indent += 1
        self._block(body)
        self._indent -= 1

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
            case ast.If(test=test, body=body, orelse=orelse):
                self._braced(f"if ({self._condition(test).code}) {{", body)
                if orelse:
                    self._braced("} else {", orelse)
                self._emit("}")
            case ast.While(test=test, body=body, orelse=[]):
                with self._unevaluated():
                    condition = self._condition(test)
                self._braced(f"while ({condition.code}) {{", body)
                self._emit("}")
            case ast.For(target=ast.Name(name), iter=over, body=body, orelse=[]):
                self._for(name, over, body)
            case ast.Break():
                self._emit("break;")
            case ast.Raise(exc=ast.Call(ast.Name("ArithmeticError"), [ast.Constant(str(text))])):
                self._emit(f"throw new Error({json.dumps(text)});")
            case _:
                self._refuse(node, type(node).__name__)

    def _for(self, name: str, over: ast.expr, body: list[ast.stmt]) -> None:
        match over:
            case ast.Call(func=ast.Name("range"), args=[_, *_] as args, keywords=[]):
                step = 1 if len(args) < 3 else is_number(args[2]) and ast.literal_eval(args[2])
            case _:
                self._refuse(over, "a loop over anything but range")
        if not isinstance(step, int) or step == 0:
            self._refuse(over, "a step that is no number")
        start = self._number(args[0], INT).code if len(args) > 1 else "0"
        stop = self._number(args[1] if len(args) > 1 else args[0], INT).code
        i = safe(name)
        sign, change = ("<", f"+= {step}") if step > 0 else (">", f"-= {-step}")
        self._shapes[name] = INT
        self._braced(f"for (let {i} = {start}; {i} {sign} {stop}; {i} {change}) {{", body)
        del self._shapes[name]  # after the loop, JavaScript does not know it
        self._emit("}")

    def _return(self, node: ast.stmt, value: ast.expr | None) -> None:
        if value is None:
            self._refuse(node, "a return of nothing")
        if (called := self._called(value)) and isinstance(called.result, list):
            self._join_result(node, called.result)
            if self._result == called.result:  # its results are already in place
                assert isinstance(value, ast.Call)
                self._emit(f"return {self._call_code(called, value)};")
                return
        result = self._value(value)
        kinds = kinds_of(self._join_result(node, shape_of(result)))
        if isinstance(result, Scalar):
            self._emit(f"return {self._coerced(node, result, kinds[0]).code};")
            return
        if LONG in kinds:
            self._refuse(node, "a 64-bit integer among several results")
        scalars = leaves_of(result)
        if any(_CALL.search(scalar.code) for scalar in scalars):
            scalars = self._kept(scalars)  # a call may overwrite `$out`
        self._emit_joined([f"$out[{i}] = {scalar.code};" for i, scalar in enumerate(scalars)])
        self._emit("return;")

    def _join_result(self, node: ast.AST, shape: Shape) -> Shape:
        """Return the shape that holds this result and those before it."""
        self._result = self._joined(node, shape if self._result is None else self._result, shape)
        return self._result

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
                    self._emit(f"{safe(name)}[{self._index(index)}] = {code};")
                case _:
                    self._refuse(target, type(target).__name__)

    def _bind(self, node: ast.AST, pairs: list[tuple[str, Value]]) -> None:
        """Assign values to variables at once."""
        moves: list[tuple[str, Scalar]] = []
        for name, value in pairs:
            if name == "_":
                continue
            if name in self._modules.fixed:
                self._refuse(node, f"an assignment to {name}")
            shape = shape_of(value)
            self._shapes[name] = self._joined(node, self._shapes.get(name, shape), shape)
            variables = leaves_of(variables_of(name, self._shapes[name]))
            for variable, scalar in zip(variables, leaves_of(value), strict=True):
                moves.append((variable.code, self._coerced(node, scalar, variable.kind)))
        names, scalars = [name for name, _ in moves], [scalar for _, scalar in moves]
        if any(_mentions(s.code, name) for i, name in enumerate(names) for s in scalars[i + 1 :]):
            scalars = self._kept(scalars)
        self._emit_joined(
            [
                f"{self._declaration(name)}{name} = {scalar.code};"
                for name, scalar in zip(names, scalars, strict=True)
            ]
        )

    def _declaration(self, variable: str) -> str:
        """Return `let ` where a variable is declared: at its first assignment, or at the top."""
        if variable in self._declared or variable in self._variables(self._parameters):
            return ""
        self._declared.add(variable)
        if self._indent == 1:
            return "let "
        self._hoisted.append(variable)
        return ""


def _mentions(code: str, name: str) -> bool:
    """Return whether JavaScript code has a name in it."""
    separated = "".join(c if c.isalnum() or c in "_$" else " " for c in code)
    return name in separated.split()


def _without_fixed(body: list[ast.stmt], fixed: frozenset[str]) -> list[ast.stmt]:
    """Return statements without those that are excluded because some parameters are None."""
    kept = []
    for node in body:
        match node:
            case ast.If(
                test=ast.Compare(ast.Name(name), [ast.Is()], [ast.Constant(None)]), body=inner
            ) if name in fixed:
                kept += _without_fixed(inner, fixed)
                if isinstance(inner[-1], ast.Return):
                    break
            case _:
                kept.append(node)
    return kept
