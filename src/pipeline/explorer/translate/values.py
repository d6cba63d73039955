"""Values of translated code: expressions with their kinds, tuples of them, and constants."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

# Kinds of scalars. An `int` may become a `float` or a `long`.
BOOL, INT, FLOAT, LONG, LONGS = "bool", "int", "float", "long", "longs"
_PHRASES = {
    BOOL: "a condition", INT: "an integer", FLOAT: "a number", LONG: "a 64-bit integer",
    LONGS: "an array of integers",
}  # fmt: skip
# Precedence of JavaScript's operators.
TERNARY, OR, AND, EQUAL, LESS, SHIFT, SUM, PRODUCT, UNARY, ATOM = range(2, 12)

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


@dataclass(frozen=True)
class Scalar:
    """A JavaScript expression, its kind and the precedence of its outermost operator."""

    code: str
    kind: str
    precedence: int = ATOM


# An expression's value: tuples are lists of values.
Value = Scalar | list["Value"]
# The kind of each number of a value, with the same nesting.
Shape = str | list["Shape"]


@dataclass
class Function:
    """A translated function: its JavaScript name, and the shapes of its parameters and result."""

    name: str
    parameters: list[Shape]
    result: Shape
    code: str


def constant(value: Any) -> Scalar | None:
    """Return a constant as JavaScript reads it, None if its type has no translation.

    Both languages round decimals correctly.
    """
    match value:
        case bool():
            return Scalar(str(value).lower(), BOOL)
        case int():
            return Scalar(str(value), INT)
        case float():
            code = repr(value).replace("inf", "Infinity").replace("nan", "NaN")
            return Scalar(code, FLOAT)
        case np.ndarray() if value.dtype == np.int64 and value.ndim == 1:
            digits = [long_literal(int(each)) for each in value]
            lines = [", ".join(digits[i : i + 8]) for i in range(0, len(digits), 8)]
            return Scalar("[\n  " + ",\n  ".join(lines) + ",\n]", LONGS)
    return None


def long_literal(value: int) -> str:
    """Return a 64-bit integer as JavaScript reads it: masks and digits are clearer in base 16."""
    return f"{hex(value) if value > 255 else value}n"


def safe(name: str) -> str:
    """Return a name that a variable of a script may have."""
    return f"{name}_" if name in RESERVED else name


def leaves_of(value: Value) -> list[Scalar]:
    """Return the scalars of a value, in order."""
    if isinstance(value, Scalar):
        return [value]
    return [leaf for each in value for leaf in leaves_of(each)]


def kinds_of(shape: Shape) -> list[str]:
    """Return the kinds of the scalars of a shape, in order."""
    return [leaf.kind for leaf in leaves_of(variables_of("", shape))]


def shape_of(value: Value) -> Shape:
    return value.kind if isinstance(value, Scalar) else [shape_of(each) for each in value]


def filled(shape: Shape, scalars: Iterator[Scalar]) -> Value:
    """Return a value of a shape from its scalars in order."""
    if isinstance(shape, str):
        return next(scalars)
    return [filled(each, scalars) for each in shape]


def variables_of(name: str, shape: Shape) -> Value:
    """Return the JavaScript variables that hold a value: `a`, or `a_0`, `a_1`, ..."""
    if isinstance(shape, str):
        return Scalar(safe(name), shape)
    return [variables_of(f"{name}_{i}", each) for i, each in enumerate(shape)]


def phrase_of(shape: Shape) -> str:
    """Return how a message calls a shape."""
    return f"{len(shape)} values" if isinstance(shape, list) else _PHRASES[shape]
