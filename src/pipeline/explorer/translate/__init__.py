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


class Translator:
    """Translate functions of the modules in a folder, with all that they call.

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
        self._modules = Modules(folder, shown, fixed)
        self._functions: dict[tuple[str, str], Function | None] = {}

    def javascript(self) -> str:
        """Return constants and functions translated so far, each after those that it uses."""
        functions = [each.code for each in self._functions.values() if each]
        return "\n".join([PRELUDE, *self._modules.constants.values(), "", *functions])

    def function(self, module: str, name: str) -> Function:
        """Translate a function of a module, unless that is done, and return it."""
        source = self._modules.module(module)
        if name in source.aliases:
            return self.function(*source.aliases[name])
        if name in source.imports and source.imports[name][1]:
            origin, original = source.imports[name]
            return self.function(origin, str(original))
        key = module, name
        if key in self._functions:
            known = self._functions[key]
            if known is None:
                self._modules.refuse(
                    source, source.functions[name], f"the recursive function {name}"
                )
            return known
        if name not in source.functions:
            raise TranslationError(f"{source.shown}: there is no function {name}")
        self._functions[key] = None
        translated = FunctionTranslator(
            self._modules, module, source.functions[name], self.function
        ).translate()
        del self._functions[key]  # so that it stands after the functions that it calls
        self._functions[key] = translated
        return translated
