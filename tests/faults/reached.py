"""List the refusals in the checkers of proofs that a run of tests does not reach.

    .venv/bin/python tests/faults/reached.py [tests]     # by default those of the proofs

A refusal is a place that raises NotProvedError. Each operand of its condition has to be the only
one that is broken in some test. What is listed is a place to look at: an operand may follow from
others.
"""

import ast
import sys
from collections.abc import Iterator
from contextlib import suppress
from itertools import pairwise
from pathlib import Path
from types import FrameType

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / folder) for folder in ("src", "tests", "tests/extensions")]
Place = tuple[str, int]  # name of a file and a line


def operands(test: ast.expr) -> list[ast.expr]:
    """Return the parts of a condition, one of which suffices to meet it."""
    if isinstance(test, ast.BoolOp) and isinstance(test.op, ast.Or):
        return [part for value in test.values for part in operands(value)]
    if not (isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not)):
        return [test]
    inner = test.operand
    if isinstance(inner, ast.BoolOp) and isinstance(inner.op, ast.And):
        return [part for value in inner.values for part in operands(_not(value))]
    if isinstance(inner, ast.Compare) and len(inner.ops) > 1:
        ends = pairwise([inner.left, *inner.comparators])
        pairs = zip(ends, inner.ops, strict=True)
        return [_not(ast.Compare(a, [op], [b])) for (a, b), op in pairs]
    return [test]


def _not(value: ast.expr) -> ast.expr:
    return ast.fix_missing_locations(ast.copy_location(ast.UnaryOp(ast.Not(), value), value))


def refusals(file: Path) -> Iterator[tuple[int, int, list[ast.expr]]]:
    """Yield first and last line of each refusal in a file, and the operands of its condition."""
    tree = ast.parse(file.read_text(encoding="utf-8"))
    conditions = {
        id(node.body[0]): node.test for node in ast.walk(tree) if isinstance(node, ast.If)
    }
    for node in ast.walk(tree):
        if isinstance(node, ast.Raise) and "NotProvedError" in ast.unparse(node):
            test = conditions.get(id(node))
            parts = operands(test) if test else []
            yield node.lineno, node.end_lineno or 0, parts if len(parts) > 1 else []


def main() -> None:
    import pytest

    from pseudorigid.verified.flight import NotProvedError

    known: dict[Place, tuple[Place, list[ast.expr]]] = {}
    left: dict[tuple[Place, str], None] = {}
    for file in sorted((ROOT / "src/extensions/proofs/checkers").glob("*.py")):
        for first, last, parts in refusals(file):
            known |= {
                (file.name, line): ((file.name, first), parts) for line in range(first, last + 1)
            }
            left |= dict.fromkeys(
                ((file.name, first), ast.unparse(p)) for p in [*parts, ast.Constant("")]
            )

    def note(self: Exception, *given: object) -> None:
        frame: FrameType = sys._getframe(1)
        at = Path(frame.f_code.co_filename).name, frame.f_lineno
        place, parts = known.get(at, (at, []))
        left.pop((place, "''"), None)
        broken = list[str]()
        for part in parts:
            with suppress(Exception):  # an operand may need that those before it are not broken
                code = compile(ast.Expression(part), "", "eval")
                broken += [ast.unparse(part)] * bool(eval(code, frame.f_globals | frame.f_locals))
        if len(broken) == 1:
            left.pop((place, broken[0]), None)
        Exception.__init__(self, *given)

    NotProvedError.__init__ = note  # type: ignore[method-assign]
    tests = sys.argv[1:] or [
        str(ROOT / f"tests/{name}") for name in ("extensions/proofs", "verified")
    ]
    pytest.main(["-n0", "-q", "-p", "no:cacheprovider", *tests])
    for (name, line), part in left:
        print(f"{name}:{line}: not " + ("reached" if part == "''" else f"broken alone: {part}"))
    print(f"{len({place for place, _ in known.values()})} refusals, {len(left)} places to look at")


if __name__ == "__main__":
    main()
