"""Compute a little of everything in one process and print one JSON line of hashes.

    python tests/matrix_probe.py            everything
    python tests/matrix_probe.py short      a short orbit, which plain Python can follow too
    python tests/matrix_probe.py compiled   the library calls and fused operations of compiled code

Arguments come from a generator that is the same everywhere, never from a library's functions.
"""

import hashlib
import json
import math
import re
import sys
import tempfile
from pathlib import Path

import numpy as np
from numba import njit
from numpy._core._multiarray_umath import __cpu_features__

# `short` needs no more than this; what imports xarray and matplotlib is imported where it is used.
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.ensemble import ImpactMap
from pseudorigid.kernel import arithmetic, impact
from pseudorigid.kernel.compiled import jit

BALL = Ball(k=0.2, g=0.04)
ENERGY = 0.01
SEA = 0.6  # a chaotic start, in section radii
FUSED = re.compile(r"\bv?f(?:n?m(?:add|sub)|ml[as])\w*\b")
MATHS = re.compile(
    r"\b_?_?(?:sin|cos|tan|sincos|a?(?:sin|cos|tan)h?|atan2|exp|exp2|expm1|log|log2|log10|log1p|"
    r"pow|powi|hypot|fma|fmuladd|fmod|floor|ceil|rint|round|trunc|nearbyint|cbrt)f?\b"
)


def digest(*parts):
    """The sha256 of arrays, bytes and texts."""
    total = hashlib.sha256()
    for part in parts:
        total.update(part if isinstance(part, bytes) else np.asarray(part).astype("<f8").tobytes())
    return total.hexdigest()


def arguments(count):
    """Angles as flights have them, and doubles of every size."""
    rng = np.random.default_rng(20)
    ordinary = 200.0 * rng.random(count - count // 4) - 100.0
    exponents = rng.integers(1, 2046, count // 4) << 52
    bits = rng.integers(0, 2**52, count // 4) | exponents
    return np.concatenate([ordinary, bits.view("f8")])


def table(count):
    t = arguments(count)
    return digest(*arithmetic.sincos_each(t), [arithmetic.log(abs(a)) for a in t.tolist()])


def library():
    """The hash of the C library's own functions: the positive control."""
    t = arguments(100_000)[:50_000].tolist()
    functions = math.sin, math.exp, lambda a: math.log(abs(a)), lambda a: math.pow(abs(a), 1.7)
    return digest(*([function(a) for a in t] for function in functions))


def history(states, impacts):
    """The hash of every impact; few states are followed by the loop for one orbit."""
    return digest(BALL.history(states, impacts))


def chaotic_orbit(impacts):
    return history(BALL.start(SEA, ENERGY), impacts)


def scanned():
    """The hash of orbits, exponents and inverses by the paper's own method."""
    from pseudorigid.dynamics import lyapunov, orbits, variables

    ball = Ball(BALL.k, BALL.g, ImpactMap((0.1, 1e-12)))
    state = ball.start(SEA, ENERGY)
    track = orbits.orbit(ball, state, 1000)
    last = orbits.orbit(ball, state, 100, keep="last")
    spectrum = lyapunov.lyapunov_spectrum(ball, state, 500)
    parts = [*(track[name] for name in variables.NAMES), last["x"], spectrum["exponent"]]
    return digest(*parts, ball.inverse_impact(*state), ball.jacobian(*state), ball.map.missed)


def everything():
    """Yield (name, hash) of the tables, and of data and figures of each kind, as saved."""
    import paper_probe
    from project import of_scenes

    from pipeline import config
    from pseudorigid.dynamics import lyapunov

    yield "table", table(50_000)
    yield from short()
    yield "orbit", chaotic_orbit(3000)
    many = BALL.start(np.linspace(-0.5, 0.6, 100), ENERGY)  # in lanes and threads
    yield "ensemble", history(many, 300)
    yield "spectra", digest(lyapunov.lyapunov_spectrum(BALL, many, 300, 5)["exponent"])
    yield "scanned", scanned()
    document = of_scenes("fig2", "fig3", "fig5", "fig6", "fig7")
    scenes = document["scenes"]
    scenes["fig2"]["impacts"] = [300 for _ in scenes["fig2"]["impacts"]]
    scenes["fig7"]["formats"] = ["png", "svg", "pdf"]
    with tempfile.TemporaryDirectory() as folder:
        yield from paper_probe.figures(folder, config.check(document))
        for file in Path(folder).rglob("*.nc"):
            yield file.name, digest(file.read_bytes())
    # What the switches themselves change, so that a test can tell that they were honoured.
    yield "library", library()
    yield "simd", [name for name, there in __cpu_features__.items() if there]


def short():
    """Yield the hash of an orbit that plain Python can follow too."""
    yield "short", digest(table(400).encode(), chaotic_orbit(150).encode())


@jit
def calls_the_library(a):
    """A control: `compiled` must see this call."""
    return math.sin(a)


@njit(fastmath=True)
def may_fuse(a, b):
    """A control: a processor with FMA fuses this sum of products."""
    total = 0.0
    for i in range(a.size):
        total += a[i] * b[i]
    return total


def compiled():
    """Yield the answers of `everything`, then those of each compiled function by its place.

    The latter are its library calls and fused operations.
    """
    from pipeline.declaration import extensions
    from pseudorigid import classify_orbits

    yield from everything()
    impact.reflect(0.1, 0.1, 0.1, 0.2, impact.impact_coefficients(0.2))  # for the explorer
    classify_orbits(BALL, BALL.start(np.linspace(-0.9, 0.9, 16), ENERGY), 1000)
    if "atlas" in extensions():
        from extensions.atlas import cell

        cell.cell(0.2, 6.25, 16, 1000)
    calls_the_library(1.0)
    may_fuse(np.ones(9), np.ones(9))
    packages = "pseudorigid", "extensions", "__main__"
    ours = [name for name in sys.modules if name.partition(".")[0] in packages]
    for module in map(sys.modules.get, ours):
        for name, function in vars(module).items():
            if hasattr(function, "inspect_asm"):
                place = f"{module.__name__}.{name}"
                yield place, [found for s in function.signatures for found in traces(function, s)]
                if not function.signatures:
                    yield place, ["was not compiled"]


def traces(function, signature):
    """The fused operations and calls of the C library in one compilation, from its code."""
    assembler = function.inspect_asm(signature)
    # numba's words about arrays of another shape have digits to count
    words = r"^define [^\n]*raise_with_shape_context.*?^}$"
    text = re.sub(words, "", function.inspect_llvm(signature), flags=re.M | re.S)
    called = re.findall(r"\bcall [^@\n]*@\"?([\w.$]+)", text)
    calls = {name for name in called if MATHS.search(name.replace(".", " "))}
    return sorted({*FUSED.findall(assembler), *calls}) if assembler else ["nothing to see"]


if __name__ == "__main__":
    mode = sys.argv[1] if len(sys.argv) > 1 else "everything"
    print(json.dumps(dict(globals()[mode]()), sort_keys=True))
