"""Functions: their statements, parameters and results."""

import ast
import json
import re
from collections.abc import Callable

from .expressions import ExpressionTranslator, is_number
from .modules import Modules
from .values import (
    FLOAT,
    INT,
    LONG,
    LONGS,
    NONE,
    Function,
    Scalar,
    Shape,
    Value,
    kinds_of,
    leaves_of,
    shape_of,
    variables_of,
)

_CALL = re.compile(r"(?<![\w$.])(?!(?:Number|BigInt)\()[A-Za-z_]\w*\(")  # of a translated function


class FunctionTranslator(ExpressionTranslator):
    """Translate one function. The shapes of its variables are inferred first, by repetition."""

    def __init__(
        self,
        modules: Modules,
        module: str,
        node: ast.FunctionDef,
        function: Callable[[str, str], Function],
    ) -> None:
        super().__init__(modules, module, function)
        body = _without_fixed(node.body, modules.fixed)
        self._node = ast.FunctionDef(node.name, node.args, body, [], lineno=node.lineno)
        self._result: Shape | None = None

    def _reset(self) -> None:
        super()._reset()
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
            for leaf in leaves_of(variables_of(name, shape))
        ]
        for variable in variables:  # `a_0` may be a part of `a`, or a function that is called
            if variables.count(variable) > 1 or variable in self._globals:
                self._refuse(node, f"{node.name}, in which {variable} has two meanings,")
        parameters = [(name, self._shapes[name]) for name in names]
        name = self._all.unique(self._module, node.name)
        return Function(name, parameters, self._result, self._text(name, parameters))

    def _text(self, name: str, parameters: list[tuple[str, Shape]]) -> str:
        leaves = [leaf for each in parameters for leaf in leaves_of(variables_of(*each))]
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

    # Statements

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
                numbers = [ast.literal_eval(a) if is_number(a) else None for a in args]
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
        self._join_result(node, shape_of(result))
        assert self._result is not None
        kinds = kinds_of(self._result)
        if isinstance(result, Scalar):
            self._emit(f"return {self._coerced(node, result, kinds[0]).code};")
            return
        if LONG in kinds:
            self._refuse(node, "a 64-bit integer among several results")
        scalars = leaves_of(result)
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
            shape = shape_of(value)
            known = self._shapes.get(name)
            self._shapes[name] = shape if known is None else self._joined(node, known, shape)
            variables = leaves_of(variables_of(name, self._shapes[name]))
            for variable, scalar in zip(variables, leaves_of(value), strict=True):
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
            for leaf in leaves_of(variables_of(name, self._shapes[name]))
        }
        if variable in self._declared or variable in parameters:
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
