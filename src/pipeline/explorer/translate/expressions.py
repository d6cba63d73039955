"""Expressions of a function, which become JavaScript with the same operations."""

import ast
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import count
from typing import NoReturn, TypeGuard

from .modules import Modules
from .values import (
    AND,
    ATOM,
    BOOL,
    EQUAL,
    FLOAT,
    INT,
    LESS,
    LONG,
    LONGS,
    OR,
    PRODUCT,
    SHIFT,
    SUM,
    TERNARY,
    UNARY,
    Function,
    Scalar,
    Shape,
    Value,
    constant,
    filled,
    kinds_of,
    leaves_of,
    long_literal,
    phrase_of,
    shape_of,
    variables_of,
)

_WIDTH = 100  # of a line
# JavaScript's operators, and how strongly they bind.
_ARITHMETIC: dict[type[ast.operator], tuple[str, int]] = {
    ast.Add: ("+", SUM),
    ast.Sub: ("-", SUM),
    ast.Mult: ("*", PRODUCT),
    ast.Div: ("/", PRODUCT),
}
_OF_LONGS: dict[type[ast.operator], tuple[str, int]] = {
    ast.BitAnd: ("{} & {}", OR),
    ast.BitOr: ("{} | {}", OR),
    ast.RShift: ("{} >> {}", SHIFT),
    ast.LShift: ("$long({} << {})", ATOM),
    ast.FloorDiv: ("$quotient({}, {})", ATOM),
    ast.Mod: ("$modulo({}, {})", ATOM),
}
_COMPARISONS: dict[type[ast.cmpop], tuple[str, int]] = {
    ast.Lt: ("<", LESS),
    ast.LtE: ("<=", LESS),
    ast.Gt: (">", LESS),
    ast.GtE: (">=", LESS),
    ast.Eq: ("===", EQUAL),
    ast.NotEq: ("!==", EQUAL),
}


class ExpressionTranslator:
    """Translate expressions of one function.

    Calls with several results, and what may be evaluated once only, are written as statements
    before the expression that they belong to.
    """

    def __init__(self, modules: Modules, module: str) -> None:
        self._modules, self._module = modules, module
        self._shapes: dict[str, Shape] = {}
        self._globals: set[str] = set()  # functions and constants that it uses
        self._reset()

    def _reset(self) -> None:
        self._lines: list[str] = []
        self._indent = 1
        self._conditional = 0  # depth of expressions that may not be evaluated
        self._temporaries = count(1)

    def _refuse(self, node: ast.AST, construct: str) -> NoReturn:
        self._modules.refuse(self._module, node, construct)

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

    def _kept(self, scalars: list[Scalar]) -> list[Scalar]:
        """Return constants that hold scalars."""
        names = [f"$t{next(self._temporaries)}" for _ in scalars]
        pairs = [f"{name} = {scalar.code}" for name, scalar in zip(names, scalars, strict=True)]
        self._emit(f"const {', '.join(pairs)};")
        return [Scalar(name, scalar.kind) for name, scalar in zip(names, scalars, strict=True)]

    def _joined(self, node: ast.AST, one: Shape, other: Shape) -> Shape:
        """Return the shape that holds values of both shapes."""
        if isinstance(one, list) and isinstance(other, list) and len(one) == len(other):
            return [self._joined(node, a, b) for a, b in zip(one, other, strict=True)]
        if one == other:
            return one
        for wider in (FLOAT, LONG):
            if (one, other) in ((INT, wider), (wider, INT)):
                return wider
        self._refuse(node, f"a variable that is both {phrase_of(one)} and {phrase_of(other)}")

    def _coerced(self, node: ast.AST, scalar: Scalar, kind: str) -> Scalar:
        """Convert a scalar to a kind."""
        if scalar.kind == kind or (scalar.kind, kind) == (INT, FLOAT):
            return scalar
        if (scalar.kind, kind) == (INT, LONG):
            if scalar.code.isdigit():
                return Scalar(long_literal(int(scalar.code)), LONG)
            return Scalar(f"BigInt({scalar.code})", LONG)
        if (scalar.kind, kind) == (LONG, FLOAT):
            return Scalar(f"Number({scalar.code})", FLOAT)
        self._refuse(node, f"{phrase_of(scalar.kind)} where {phrase_of(kind)} is needed")

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
            self._refuse(node, f"{phrase_of(shape_of(value))} here")
        return value

    def _condition(self, node: ast.expr) -> Scalar:
        """Translate a condition: a comparison, or a 64-bit integer that is not 0."""
        value = self._number(node, BOOL, LONG)
        if value.kind == LONG:
            return Scalar(f"{self._grouped(value, EQUAL + 1)} !== 0n", BOOL, EQUAL)
        return value

    @staticmethod
    def _grouped(scalar: Scalar, precedence: int) -> str:
        """Return the code of an operand, in parentheses where it binds less than `precedence`."""
        return scalar.code if scalar.precedence >= precedence else f"({scalar.code})"

    def _value(self, node: ast.expr) -> Value:
        match node:
            case ast.Constant(value=bool() | int() | float() as number):
                return self._literal(node, number)
            case ast.Name(name):
                return self._name(node, name)
            case ast.Attribute(value=ast.Name("math"), attr="inf" | "nan" as name):
                return self._literal(node, float(name))
            case ast.Tuple(elts=elements):
                return self._tuple(elements)
            case ast.BinOp(left=left, op=op, right=right):
                return self._operation(node, left, op, right)
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                value = self._number(operand)
                if value.kind == INT and not isinstance(operand, ast.Constant):  # -0 is 0
                    return Scalar(f"0 - {self._grouped(value, PRODUCT)}", INT, SUM)
                code = f"-{self._grouped(value, UNARY + 1)}"
                return Scalar(code, value.kind, UNARY)
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                condition = self._condition(operand)
                return Scalar(f"!{self._grouped(condition, UNARY + 1)}", BOOL, UNARY)
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

    def _literal(self, node: ast.expr, number: object) -> Scalar:
        return constant(number) or self._refuse(node, "this number")

    def _name(self, node: ast.expr, name: str) -> Value:
        if name in self._shapes:
            return variables_of(name, self._shapes[name])
        value = self._modules.constant(self._module, name, node)
        self._globals.add(value.code)
        return value

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
            if not (is_number(left) and is_number(right)):
                self._refuse(node, "a power of anything but two numbers")
            return self._literal(node, ast.literal_eval(left) ** ast.literal_eval(right))
        if isinstance(op, ast.BitAnd | ast.BitOr):
            one, other = self._value(left), self._value(right)
            if shape_of(one) == shape_of(other) == BOOL:
                return self._joined_conditions(op, one, other)
        a, b = self._number(left), self._number(right)
        kind = LONG if LONG in (a.kind, b.kind) else INT
        if FLOAT in (a.kind, b.kind) or isinstance(op, ast.Div):
            kind = FLOAT
        if isinstance(op, ast.Div) and LONG in (a.kind, b.kind):
            self._refuse(node, "the division of 64-bit integers")
        a, b = self._coerced(node, a, kind), self._coerced(node, b, kind)
        if type(op) in _ARITHMETIC:
            symbol, precedence = _ARITHMETIC[type(op)]
            code = f"{self._grouped(a, precedence)} {symbol} {self._grouped(b, precedence + 1)}"
            if kind == LONG:
                return Scalar(f"$long({code})", LONG)
            if kind == INT and isinstance(op, ast.Mult):  # an integer has no -0
                return Scalar(f"{code} + 0", INT, SUM)
            return Scalar(code, kind, precedence)
        if kind != LONG or type(op) not in _OF_LONGS:
            self._refuse(node, f"{type(op).__name__} of anything but 64-bit integers")
        template, precedence = _OF_LONGS[type(op)]
        return Scalar(
            template.format(self._grouped(a, ATOM), self._grouped(b, ATOM)), LONG, precedence
        )

    def _joined_conditions(self, op: ast.AST, *values: Value) -> Scalar:
        """Join conditions by `&&` or `||`; without side effects, all may as well be evaluated."""
        both = isinstance(op, ast.And | ast.BitAnd)
        symbol, precedence = ("&&", AND) if both else ("||", OR)
        scalars = [leaf for value in values for leaf in leaves_of(value)]
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
        if type(op) not in _COMPARISONS:
            self._refuse(node, f"the comparison {type(op).__name__}")
        a, b = self._number(left), self._number(right)
        if LONG in (a.kind, b.kind):
            a, b = self._coerced(node, a, LONG), self._coerced(node, b, LONG)
        symbol, precedence = _COMPARISONS[type(op)]
        code = f"{self._grouped(a, SHIFT)} {symbol} {self._grouped(b, SHIFT)}"
        return Scalar(code, BOOL, precedence)

    def _choice(self, node: ast.expr, test: ast.expr, body: ast.expr, orelse: ast.expr) -> Value:
        condition = self._condition(test)
        with self._unevaluated():
            one, other = self._value(body), self._value(orelse)
        shape = self._joined(node, shape_of(one), shape_of(other))
        kinds = kinds_of(shape)
        if len(kinds) > 1 and condition.precedence < ATOM:
            (condition,) = self._kept([condition])
        scalars = []
        for a, b, kind in zip(leaves_of(one), leaves_of(other), kinds, strict=True):
            parts = condition, self._coerced(node, a, kind), self._coerced(node, b, kind)
            test_code, yes, no = (self._grouped(each, OR) for each in parts)
            scalars.append(Scalar(f"{test_code} ? {yes} : {no}", kind, TERNARY))
        return filled(shape, iter(scalars))

    def _index(self, node: ast.expr) -> str:
        at = self._number(node, INT, LONG)
        return f"Number({at.code})" if at.kind == LONG else at.code

    def _element(self, node: ast.expr, name: str, index: ast.expr) -> Value:
        match self._name(node, name), index:
            case list(values), ast.Constant(value=int(i)) if i < len(values):
                return values[i]
            case Scalar(code, kind=kind), _ if kind == LONGS:
                return Scalar(f"{code}[{self._index(index)}]", LONG)
        self._refuse(node, "this element")

    # Calls

    def _called(self, node: ast.expr | None) -> Function | None:
        """Return the translated function that an expression calls, if it is such a call."""
        match node:
            case ast.Call(func=ast.Name(name)) if self._modules.has_function(self._module, name):
                return self._modules.function(self._module, name)
        return None

    def _call(self, node: ast.Call, keep: bool = True) -> Value:
        """Translate a call; several results are kept in constants, or read by the caller."""
        if function := self._called(node):
            code = self._call_code(function, node)
            if isinstance(function.result, str):
                return Scalar(code, function.result)
            if self._conditional:
                called = ast.unparse(node.func)
                self._refuse(node, f"{called}, with several results, in a condition or a choice,")
            self._emit(f"{code};")
            kinds = kinds_of(function.result)
            read = [Scalar(f"$out[{i}]", kind) for i, kind in enumerate(kinds)]
            return filled(function.result, iter(self._kept(read) if keep else read))
        if node.keywords:
            self._refuse(node, "a keyword argument")
        match ast.unparse(node.func), node.args:
            case "abs", [a]:
                return Scalar(f"Math.abs({self._number(a, FLOAT).code})", FLOAT)
            case "max" | "min" as name, [a, b]:
                one, other = self._number(a, INT, FLOAT), self._number(b, INT, FLOAT)
                kind = INT if one.kind == other.kind == INT else FLOAT
                return Scalar(f"${name}({one.code}, {other.code})", kind)
            case "float", [a]:
                return self._coerced(node, self._number(a), FLOAT)
            case "math.sqrt" | "np.sqrt", [a]:
                return Scalar(f"Math.sqrt({self._number(a, INT, FLOAT).code})", FLOAT)
            case "np.zeros", [size, ast.Attribute(value=ast.Name("np"), attr="int64")]:
                return Scalar(f"new BigInt64Array({self._number(size, INT).code})", LONGS)
        match node:
            case ast.Call(ast.Attribute(ast.Call(origin, [a]), "view"), [target]):
                match ast.unparse(origin), ast.unparse(target):
                    case "np.float64", "np.int64":
                        return Scalar(f"$bitsOf({self._number(a, FLOAT).code})", LONG)
                    case "np.int64", "np.float64":
                        return Scalar(f"$floatOf({self._number(a, LONG).code})", FLOAT)
        self._refuse(node, f"the call of {ast.unparse(node.func)}")

    def _arguments(self, node: ast.Call) -> list[ast.expr]:
        """Return the arguments of a call without those that are fixed."""
        fixed = self._modules.fixed
        return [each for each in node.args if not (isinstance(each, ast.Name) and each.id in fixed)]

    def _call_code(self, function: Function, node: ast.Call) -> str:
        if node.keywords:
            self._refuse(node, "a keyword argument")
        self._globals.add(function.name)
        values = self._tuple(self._arguments(node))
        if len(values) != len(function.parameters):
            self._refuse(node, f"a call of {function.name} with another number of arguments")
        codes = []
        for value, shape in zip(values, function.parameters, strict=True):
            if len(leaves_of(value)) != len(kinds_of(shape)):
                self._refuse(node, f"this argument of {function.name}")
            for leaf, kind in zip(leaves_of(value), kinds_of(shape), strict=True):
                if leaf.kind in (LONG, LONGS, BOOL):
                    self._refuse(node, f"{phrase_of(leaf.kind)} as an argument")
                codes.append(self._coerced(node, leaf, kind).code)
        return f"{function.name}({', '.join(codes)})"


def is_number(node: ast.expr) -> TypeGuard[ast.expr]:
    """Return whether an expression is a literal number, with or without a sign."""
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        node = node.operand
    return isinstance(node, ast.Constant) and type(node.value) in (int, float)
