"""The translator keeps the meaning of its subset of Python, and refuses the rest in one line."""

import importlib.util
import itertools
import math
import re
import shutil

import doubles
import numpy as np
import pytest
from project import NO_CACHES, ROOT
from slowly import slowly

from pipeline.explorer import kernel
from pipeline.explorer.translate import TranslationError, Translator

KERNEL = ROOT / "src/pseudorigid/kernel"
HEAD = """import math

import numpy as np

from pseudorigid.kernel.compiled import jit
"""
# Every construct of the subset, in functions of two numbers.
ZOO = '''"""Constructs of the kernel's Python."""

HALF = float.fromhex("0x1p-1")
THIRD, SIXTH = (1.0 / n for n in (3.0, 6.0))
COUNT = 7
WORDS = np.array([3, -5, 1 << 40], dtype=np.int64)


@jit
def grouped(a, b):
    """Keep every grouping and order."""
    return (a - b) - (b - a) * (a / (b / (a + 3.0))) - -a - (-(b * 2.0) + HALF) / (THIRD * SIXTH)


@jit
def extremes(a, b):
    return max(a, b), min(a, b), max(0.0, a), min(b, -0.0), abs(a), max(-a, b) + min(a, 1e-300)


@jit
def roots(a, b):
    return math.sqrt(abs(a)), np.sqrt(b), math.sqrt(a * a + b * b)


@jit
def choices(a, b):
    near = a < b
    first, second = (a, b) if near else (b, 2.0)
    third = 1.0 if not near and (a >= 0.0 or b != a) else -1.0
    return first, second, third if 0.0 < a <= b * 2.0 < 50.0 else 7.0, 2.0 if a in (b, 0.0) else 3.0


@jit
def loops(a, b):
    total = 0.0
    for i in range(COUNT):
        if i != 3:
            total += a * i
    for j in range(10, 0, -2):
        if total > 1e3:
            break
        total -= b / j
    n = 0
    while n < 5 and total < 100.0:
        total = total * 1.5 + a
        n += 1
    return total, n, 1.0 / -n, 2.0 / (n * -3), float(-n)


@jit
def swapped(a, b):
    """Assign several values at once."""
    a, b = b, a - b
    c = d = a * 3.0
    c, d, a = a, c, d
    return a, b, c, d


@jit
def pair(a, b):
    return a * b, a + b


@jit
def nested(a, b):
    return (a, b), pair(b, a), *pair(a, a)


@jit
def passed(a, vector, b):
    p, q = vector
    return a * p - q * b


@jit
def sliced(a, b):
    whole = nested(a, b)
    vector = pair(*whole[0])
    p, (q) = vector
    return passed(a, pair(a, b), b), passed(b, vector, a), whole[2] + whole[3], p, *vector, q


@jit
def early(a, b):
    if not a < math.inf:
        return math.nan, 0.0
    if a > b:
        return a, b
    elif a == b:
        return -math.inf, a
    else:
        b = a
    return pair(a, b)


@jit
def kept(a, b):
    """Return the result of a call beside another one that overwrites shared results."""
    return a, alone(b), b


@jit
def alone(a):
    one, other = pair(a, 2.0)
    return one - other


@jit
def integers(a, b):
    """Use the bits of a double, and 64-bit integers that overflow, round down and shift."""
    bits = np.float64(a).view(np.int64)
    low = bits & 0xFFFFFFFFFFFFF
    exponent = ((bits >> 52) & 0x7FF) - 1023
    total = 0
    for i in range(3):
        total += WORDS[i] * low
    parts = np.zeros(2, np.int64)
    parts[0] = exponent // 24
    parts[1] = exponent % 24 - (low << 20)
    parts[0] |= 5
    back = np.int64(low | 0x3FF0000000000000).view(np.float64)
    count = 4.0 if parts[1] & 1 else 5.0
    return back, total * 2.0**-60, parts[0] * 1.0, float(parts[1]), count, float(exponent - 3)
'''
TYPED = re.compile(r"^def (\w+)\(a, b\)", re.MULTILINE)


def translator(tmp_path, text, fixed=()):
    """A translator of a module `zoo` in a folder of its own."""
    text = f"{HEAD}\n\n{text}".replace("from pseudorigid.kernel.", "from .")
    (tmp_path / "zoo.py").write_text(text, encoding="utf-8")
    return Translator(tmp_path, "kernel", frozenset(fixed))


def flat(result):
    values = result if isinstance(result, tuple) else (result,)
    return [leaf for v in values for leaf in (flat(v) if isinstance(v, tuple) else [float(v)])]


@pytest.mark.parametrize("browser", ["chromium", *slowly("firefox")], indirect=True)
def test_every_construct_has_the_bits_of_the_compiled_one(browser, tmp_path):
    zoo = translator(tmp_path, ZOO)
    functions = [zoo.function("zoo", name) for name in TYPED.findall(ZOO)]
    assert len(functions) == 12
    compiled_file = tmp_path / "compiled_zoo.py"
    compiled_file.write_text(HEAD + ZOO, encoding="utf-8")
    spec = importlib.util.spec_from_file_location("compiled_zoo", compiled_file)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    numbers = [0.0, -0.0, 1.0, -2.5, 0.1, 1e-300, 5e-324, 1e300, math.inf, -math.inf, math.nan]
    numbers += [3.0, 7.25, -1e-5, 12345.678]
    pairs = list(itertools.product(numbers, numbers))
    names = [function.name for function in functions]
    script = f"""{zoo.javascript()}
        const numbers = floats(args[0]), functions = {{ {", ".join(names)} }};
        return Object.entries(functions).map(([name, f]) => {{
          const width = args[1][name], all = [];
          for (const a of numbers) for (const b of numbers) {{
            const value = f(a, b);
            all.push(...(width ? $out.slice(0, width) : [value]));
          }}
          return text(Float64Array.from(all));
        }});"""
    ours = {name: np.array([flat(getattr(module, name)(a, b)) for a, b in pairs]) for name in names}
    several = {name: 0 if name == "grouped" else ours[name].shape[1] for name in names}
    theirs = browser.run(script, doubles.packed(numbers), several)
    for name, text in zip(names, theirs, strict=True):
        values = doubles.unpacked(text).reshape(ours[name].shape)
        differing = (doubles.bits(ours[name]) != doubles.bits(values)).any(axis=1)
        assert not differing.any(), (name, pairs[int(np.argmax(differing))])


# A function's body, the line counted from its `def`, and the words of the message.
REFUSED = {
    "a power": ("return a**2", 1, "a power of anything but two numbers"),
    "a call": ("return math.sin(a)", 1, "the call of math.sin"),
    "a method": ("return a.real", 1, "Attribute"),
    "an unknown name": ("return a + unknown", 1, "the name unknown"),
    "a list": ("return [a]", 1, "List"),
    "a division rounded down": ("return a // b", 1, "FloorDiv of anything but 64-bit integers"),
    "bits of numbers": ("return a & b", 1, "BitAnd of anything but 64-bit integers"),
    "a number as a condition": ("return 1.0 if a else 2.0", 1, "a number here"),
    "a comparison with is": ("return 1.0 if a is b else 2.0", 1, "the comparison Is"),
    "a loop over values": ("for i in (a, b):\n        a += i\n    return a", 1,
                           "a loop over anything but range"),
    "an else of a loop": ("while a < b:\n        a += 1\n    else:\n        a = b\n    return a", 1,
                          "While"),
    "a loop's variable after it": ("for i in range(3):\n        a += 1\n    return a + i", 3,
                                   "the name i"),
    "several results in a condition": ("return 1.0 if other(a) > b else 2.0", 1,
                                       "other, with several results, in a condition or a choice,"),
    "several results in a choice": ("b, a = other(a) if a > b else (a, b)\n    return a", 1,
                                    "other, with several results, in a condition or a choice,"),
    "another number of arguments": ("a, b = other(a, b)\n    return a", 1,
                                    "a call of other with another number of arguments"),
    "another number of variables": ("a, b, c = other(a)\n    return a", 1,
                                    "an assignment to another number of variables"),
    "two kinds": ("a = 1.0 if b > a else a > b\n    return a", 1,
                  "a variable that is both a number and a condition"),
    "two kinds, later": ("c = 1.0\n    c = a > b\n    return c", 2,
                         "a variable that is both a number and a condition"),
    "a keyword argument": ("return other(t=a)", 1, "a keyword argument"),
    "a keyword argument of Python's": ("return max(a, b, key=a)", 1, "a keyword argument"),
    "a star": ("return max(*other(a))", 1, "the call of max"),
    "try": ("try:\n        return a\n    finally:\n        b = a", 1, "Try"),
    "no result": ("a = b", 0, "f, which returns nothing,"),
    "an empty return": ("if a > b:\n        return\n    return a", 2, "a return of nothing"),
    "two meanings": ("c = other(a)\n    c_0 = b\n    return c[0] + c_0", 0,
                     "f, in which c_0 has two meanings,"),
    "itself": ("return f(b, a)", 0, "the recursive function f"),
    "an array": ("c = np.zeros(3)\n    return a", 1, "the call of np.zeros"),
    "an imaginary number": ("return a * 2j", 1, "Constant"),
}  # fmt: skip
BODY = """@jit
def f(a, b):
    {}


@jit
def other(t):
    return t, t
"""


# Text of a module, and the beginning of the message.
REFUSED_MODULES = {
    "a class": ("class A:\n    pass\n", "kernel/zoo.py:8: ClassDef is not translated"),
    "another decorator": ("@njit(fastmath=True)\ndef f(a):\n    return a\n",
                          "kernel/zoo.py:9: FunctionDef is not translated"),
    "another import": ("from scipy import special\n", "kernel/zoo.py:8: ImportFrom is not "),
    "a broken constant": ("A = 1 // 0\n\n\n@jit\ndef f(a):\n    return a * A\n",
                          "kernel/zoo.py:8: a constant (ZeroDivisionError: "),
    "a constant of another type": ("A = {}\n\n\n@jit\ndef f(a):\n    return a * A\n",
                                   "kernel/zoo.py:13: the constant A of type dict is not "),
    "a default": ("@jit\ndef f(a, b=1.0):\n    return a * b\n",
                  "kernel/zoo.py:9: a default, keyword or variable argument is not translated"),
    "a syntax error": ("def f(a:\n", "kernel/zoo.py:"),
    "no such function": ("", "kernel/zoo.py: there is no function f"),
}  # fmt: skip
for fault, (body, below, words) in REFUSED.items():  # `def f` stands in line 9
    REFUSED_MODULES[fault] = BODY.format(body), f"kernel/zoo.py:{9 + below}: {words} is not transl"


@pytest.mark.parametrize("fault", REFUSED_MODULES)
def test_what_is_not_known_is_refused_with_file_and_line(tmp_path, fault):
    text, words = REFUSED_MODULES[fault]
    with pytest.raises(TranslationError) as caught:
        translator(tmp_path, text).function("zoo", "f")
    message = str(caught.value)
    assert message.startswith(words) and "\n" not in message, message


def test_a_fixed_parameter_disappears_with_what_it_excludes(tmp_path):
    text = """@jit
def f(a, method):
    if method is None:
        return a + 1.0
    return unknown(a, method)


@jit
def g(a, method):
    return f(a, method) * 2.0
"""
    fixed = translator(tmp_path, text, fixed=["method"])
    assert fixed.function("zoo", "g").code.splitlines() == [
        "function g(a) {",
        "  return f(a) * 2.0;",
        "}",
    ]
    assert "method" not in fixed.javascript() and "unknown" not in fixed.javascript()


def test_words_of_javascript_and_equal_names_of_two_modules_are_told_apart(tmp_path):
    (tmp_path / "more.py").write_text("@jit\ndef gap(new):\n    return new * 2.0\n")
    text = "from . import more\nfrom .more import gap as twice\n\n\n@jit\ndef gap(let):\n"
    text += "    var = let + 1.0\n    return twice(var)\n"
    both = translator(tmp_path, text)
    both.function("zoo", "gap")
    script = both.javascript()
    assert "function zoo_gap(let_)" in script and "function gap(new_)" in script
    assert "const var_ = let_ + 1.0;" in script and "return gap(var_);" in script


def test_a_variable_that_hides_a_function_is_refused(tmp_path):
    """In Python, the function has another name."""
    (tmp_path / "more.py").write_text("@jit\ndef gap(t):\n    return t * 2.0\n")
    text = "from .more import gap as twice\n\n\n@jit\ndef f(a):\n    gap = twice(a)\n"
    hiding = translator(tmp_path, f"{text}    return twice(gap)\n")
    with pytest.raises(TranslationError, match="f, in which gap has two meanings, is not"):
        hiding.function("zoo", "f")


def test_the_script_follows_the_kernel_and_not_its_comments(tmp_path):
    folder = shutil.copytree(KERNEL, tmp_path / "kernel", ignore=NO_CACHES)
    file = folder / "impact_law.py"
    text = file.read_text()
    unused = "# A comment.\n@jit\ndef unused(a):\n    return math.sin(a)\n"
    file.write_text(f"{text}\n\n{unused}")
    assert kernel.javascript(folder) == kernel.javascript()
    file.write_text(text.replace("return v - k * e, w - e, s", "return v - e * k, w - e, s"))
    assert "$out[0] = v - e * k;" in kernel.javascript(folder)
