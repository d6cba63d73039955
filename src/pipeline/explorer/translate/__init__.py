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

from pathlib import Path

from .functions import FunctionTranslator
from .modules import Modules, TranslationError
from .values import Function

__all__ = ["TranslationError", "Translator"]

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


class Translator(Modules):
    """Translate functions of the modules in a folder, with all that they call."""

    def __init__(self, folder: Path, shown: str, fixed: frozenset[str]) -> None:
        super().__init__(folder, shown, fixed)
        self._begun: set[tuple[str, str]] = set()
        self._done: dict[tuple[str, str], Function] = {}  # each after those that it calls

    def javascript(self) -> str:
        """Return constants and functions translated so far, each after those that it uses."""
        functions = [function.code for function in self._done.values()]
        return "\n".join([PRELUDE, *self.constants.values(), "", *functions])

    def function(self, module: str, name: str) -> Function:
        """Translate a function of a module, unless that is done, and return it."""
        key = origin, original = self.definition(module, name)
        if key not in self._done:
            source = self.module(origin)
            if original not in source.functions:
                raise TranslationError(f"{source.shown}: there is no function {original}")
            node = source.functions[original]
            if key in self._begun:
                self.refuse(origin, node, f"the recursive function {original}")
            self._begun.add(key)
            self._done[key] = FunctionTranslator(self, origin, node).translate()
        return self._done[key]
