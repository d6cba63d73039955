"""Compute a little of everything in one process and print one JSON line of hashes.

    python tests/matrix_probe.py            everything
    python tests/matrix_probe.py short      a short orbit, which plain Python can follow too
    python tests/matrix_probe.py sincos     the table of sines, cosines and logarithms alone
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

from pseudorigid.dynamics import lyapunov, motion, orbits, periodic, variables
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.ensemble import ImpactMap
from pseudorigid.kernel import arithmetic, impact
from pseudorigid.kernel.compiled import jit
from pseudorigid.sweep import cell

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


@jit
def tables(t, sine, cosine, logarithm):
    for i in range(t.size):
        sine[i], cosine[i] = arithmetic.sincos(t[i])
        logarithm[i] = arithmetic.log(abs(t[i]))


def arguments(count):
    """Angles as flights have them, and doubles of every size."""
    rng = np.random.default_rng(20)
    ordinary = 200.0 * rng.random(count - count // 4) - 100.0
    exponents = rng.integers(1, 2046, count // 4) << 52
    bits = rng.integers(0, 2**52, count // 4) | exponents
    return np.concatenate([ordinary, bits.view("f8")])


def table(count):
    t = arguments(count)
    columns = [np.empty(count) for _ in range(3)]
    tables(t, *columns)
    return digest(*columns)


def library():
    """The hash of the C library's own functions: the positive control."""
    t = arguments(200_000)[:100_000].tolist()
    functions = math.sin, math.exp, lambda a: math.log(abs(a)), lambda a: math.pow(abs(a), 1.7)
    return digest(*([function(a) for a in t] for function in functions))


def history(states, impacts):
    """The hash of every impact; a single state is followed by the loop for one orbit."""
    columns = [np.atleast_1d(a) for a in states]
    out = np.empty((columns[0].size, impacts, 4))
    if columns[0].size == 1:
        impact.history(*columns, BALL.k, BALL.g, out, None)
    else:
        BALL.map.history(*columns, BALL.k, BALL.g, out)
    return digest(out)


def chaotic_orbit(impacts):
    return history(BALL.start(SEA, ENERGY), impacts)


def scanned():
    """The hash of orbits, exponents and inverses by the paper's own method."""
    ball = Ball(BALL.k, BALL.g, ImpactMap((0.1, 1e-12)))
    state = ball.start(SEA, ENERGY)
    track = orbits.orbit(ball, state, 1000)
    last = orbits.orbit(ball, state, 100, keep="last")
    spectrum = lyapunov.lyapunov_spectrum(ball, state, 500)
    parts = [*(track[name] for name in variables.NAMES), last["x"], spectrum["exponent"]]
    return digest(*parts, ball.inverse_impact(*state), ball.jacobian(*state), ball.map.missed)


AXES = {
    "x": {"limits": [-0.2, 0.6], "ticks": [0, 0.4]},
    "xdot": {"limits": [-0.4, 0.4], "ticks": [-0.4, 0, 0.4]},
    "udot": {"limits": [-0.2, 0.4], "ticks": [0]},
    "t": {"limits": [0, 20], "ticks": [0, 20]},
    "displacement": {"limits": [-0.5, 0.2], "ticks": [-0.5, 0.2]},
    "impact": {"limits": [0, 2000], "ticks": [0, 2000]},
    "exponent": {"limits": [-0.5, 0.5], "ticks": [-0.5, 0, 0.5]},
}
STARTS = [-0.44, -0.2, 0.14, SEA]
RESOLUTION = {"distance": 0.05, "bend": 20}


def scene(*axes):
    how = {"view": {"elevation": 40, "azimuth": 115}, "sea": [3], "type": "hyperbolic"}
    how |= {"energy": ENERGY, "ball": {"k": BALL.k, "g": BALL.g}}
    return how | {"axes": {name: AXES[name] for name in axes}}


def everything():
    """Yield (name, hash) of the tables, and of data and figures of each kind, as saved."""
    from pipeline.records import artifacts
    from pseudorigid.dynamics import manifolds
    from pseudorigid.figures.canvas.render import render
    from pseudorigid.figures.kinds import closeup, exponents, portrait, tangle
    from pseudorigid.figures.kinds import motion as motion_picture

    yield "table", table(200_000)
    yield from short()
    yield "orbit", chaotic_orbit(3000)
    many = BALL.start(np.linspace(-0.5, 0.6, 100), ENERGY)  # in lanes and threads
    yield "ensemble", history(many, 300)
    yield "spectra", digest(lyapunov.lyapunov_spectrum(BALL, many, 300, 5)["exponent"])
    yield "scanned", scanned()
    folder = tempfile.TemporaryDirectory()
    hashes = {}

    def keep(stage, dataset):
        """The dataset after a round through its file, whose bytes are hashed."""
        path = Path(folder.name) / f"{stage}.nc"
        artifacts.save(dataset, path, {}, stage=stage, k=BALL.k, g=BALL.g, energy=ENERGY)
        hashes[f"{stage}.nc"] = digest(path.read_bytes())
        return artifacts.load(path)

    found = keep("periodic", periodic.symmetric_orbits(BALL, ENERGY, 6))
    sea = keep("orbits", orbits.scene_orbits(BALL, ENERGY, STARTS, [300, 300, 300, 600]))
    moved = keep("motion", motion.scene_motion(BALL, ENERGY, found, 6, "elliptic", 20.0))
    saddle = BALL, ENERGY, found, 6, "hyperbolic", RESOLUTION
    branches = {"outer": {"length": 0.5}, "inner": {"length": 0.2}}
    whole = keep("manifolds", manifolds.scene_manifolds(*saddle, branches=branches))
    window = {"x": [-0.05, 0.05], "xdot": [-0.05, 0.05]}
    near = manifolds.scene_manifolds(*saddle, point=0, window=window, length=0.3)
    near = keep("window", near)
    spread = keep("lyapunov", lyapunov.scene_exponents(BALL, ENERGY, [SEA, 0.62], 2000, 40))
    yield from hashes.items()
    centre = [near.attrs[f"window_{name}"] for name in ("x", "xdot")]
    zoom = {
        name: {"limits": list(map(float, ends)), "ticks": [float(ends[0])]}
        for name, ends in zip(("x", "xdot"), centre, strict=True)
    }
    pictures = {
        "portrait": portrait.draw(scene("x", "xdot", "udot"), sea),
        "motion": motion_picture.draw(scene("t", "displacement"), moved),
        "tangle": tangle.draw(scene("x", "xdot", "udot"), sea, whole, found),
        "closeup": closeup.draw(scene() | {"axes": zoom}, near),
        "exponents": exponents.draw(scene("impact", "exponent"), spread),
    }
    for name, figure in pictures.items():
        for kind in ("png", "svg", "pdf") if name == "exponents" else ("png",):
            yield f"{name}.{kind}", digest(render(figure, kind))
    # What the switches themselves change, so that a test can tell that they were honoured.
    yield "library", library()
    yield "simd", [name for name, there in __cpu_features__.items() if there]


def short():
    """Yield the hash of an orbit that plain Python can follow too."""
    yield "short", digest(table(400).encode(), chaotic_orbit(150).encode())


def sincos():
    yield "table", table(200_000)


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
    """Yield (function, library calls and fused operations) of every compiled function."""
    dict(everything())
    BALL.inverse_impact(0.1, 0.1, 0.1)
    cell.cell(0.2, 6.25, 16, 1000)
    calls_the_library(1.0)
    may_fuse(np.ones(9), np.ones(9))
    ours = [name for name in sys.modules if name.partition(".")[0] in ("pseudorigid", "__main__")]
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
