"""The source behind the figures uses only arithmetic that is the same everywhere."""

import ast
import re

import pytest

from helpers.project import ROOT, SHIPPED
from pipeline import config

EXACT = {"prod", "sqrt", "floor", "ceil", "inf", "nan", "isnan", "isfinite", "copysign", "ulp"}
EXACT |= {"nextafter", "pi"}
INEXACT = re.compile(
    r"(arc)?(sin|cos|tan)h?2?|a(sin|cos|tan)h?|atan2|exp2?|expm1|log(2|10|1p|addexp2?)?|(float_)?power|"
    r"cbrt|hypot|dot|vdot|inner|outer|matmul|tensordot|einsum|kron|convolve|correlate|polyfit|sinc|"
    r"linalg|fft|deg2rad|rad2deg|angle|prange|vectorize|guvectorize"
)


def sources_of_the_figures():
    """Every Python file whose bits can reach a figure."""
    specs = config.load(SHIPPED).build_specs(["paper"]).values()
    return sorted({file for spec in specs for file in spec.sources if file.endswith(".py")})


def inexact(tree):
    """Yield the operations in a parsed module whose bits differ between machines."""
    for node in ast.walk(tree):
        match node:
            case ast.Attribute(value=ast.Name("math"), attr=name) if name not in EXACT:
                yield f"math.{name}"
            case ast.Attribute(value=ast.Name("np" | "numba" | "scipy"), attr=name):
                if INEXACT.fullmatch(name):
                    yield f"np.{name}"
            case ast.ImportFrom(module="math" | "numpy" | "scipy" | "cmath"):
                yield f"from {node.module}"
            case ast.Import(names=names):
                yield from (n.name for n in names if n.name.partition(".")[0] in ("scipy", "cmath"))
            case ast.BinOp(op=ast.MatMult()) | ast.AugAssign(op=ast.MatMult()):
                yield "@"
            case ast.BinOp(left=left, op=ast.Pow(), right=right):
                # Squares and powers of whole numbers are products, and fractions are exact. Other
                # powers call pow.
                base, exponent = ast.unparse(left), ast.unparse(right)
                whole = exponent.lstrip("-").isdecimal()
                if not (
                    base.isdecimal()
                    or base.startswith("Fraction(")
                    or exponent == "2"
                    or (whole and base in ("2.0", "10.0"))
                ):
                    yield ast.unparse(node)
            case ast.keyword(arg="fastmath" | "parallel", value=value):
                if ast.unparse(value) != "False":
                    yield node.arg


@pytest.mark.parametrize("file", sources_of_the_figures())
def test_the_source_uses_exact_arithmetic(file):
    assert list(inexact(ast.parse((ROOT / file).read_text()))) == []
