"""Hashes of a little of everything, as one JSON line.

    export PYTHONPATH=src:tests
    python tests/helpers/matrix_probe.py         everything
    python tests/helpers/matrix_probe.py short   a short table and orbit, for plain Python
    python tests/helpers/matrix_probe.py analyses

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
from numpy._core._multiarray_umath import __cpu_features__

# `short` needs no more than this; what imports xarray and matplotlib is imported where it is used.
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.ensemble import ImpactMap
from pseudorigid.kernel import arithmetic

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
    """The hash of the C library's own functions, which the settings change where it has FMA."""
    t = arguments(20_000)[:10_000].tolist()
    functions = math.sin, math.exp, lambda a: math.log(abs(a)), lambda a: math.pow(abs(a), 1.7)
    return digest(*([function(a) for a in t] for function in functions))


def history(states, impacts):
    """The hash of every impact; few states are followed by the loop for one orbit."""
    return digest(BALL.history(states, impacts))


def scanned():
    """The hash of orbits and exponents by the paper's own method."""
    from pseudorigid.dynamics import lyapunov, orbits, variables

    ball = Ball(BALL.k, BALL.g, ImpactMap((0.1, 1e-12)))
    state = ball.start(SEA, ENERGY)
    track, spectrum = orbits.orbit(ball, state, 1000), lyapunov.lyapunov_spectrum(ball, state, 500)
    return digest(*(track[name] for name in variables.NAMES), spectrum["exponent"], ball.map.missed)


def everything():
    """Yield (name, hash) of tables, and of data and figures of four kinds, as saved."""
    from helpers import paper_probe
    from helpers.project import of_scenes
    from pipeline import config
    from pseudorigid.dynamics import lyapunov

    yield "table", table(20_000)
    yield from short()
    yield "orbit", history(BALL.start(SEA, ENERGY), 3000)
    many = BALL.start(np.linspace(-0.5, 0.6, 100), ENERGY)  # in lanes and threads
    yield "ensemble", history(many, 300)
    yield "spectra", digest(lyapunov.lyapunov_spectrum(BALL, many, 300, 5)["exponent"])
    yield "scanned", scanned()
    document = of_scenes("fig2", "fig3", "fig5", "fig7")
    scenes = document["scenes"]
    scenes["fig2"]["impacts"] = [300 for _ in scenes["fig2"]["impacts"]]
    scenes["fig7"]["formats"] = ["png", "svg", "pdf"]
    with tempfile.TemporaryDirectory() as folder:
        yield from paper_probe.figures(folder, config.check(document))
        for file in Path(folder).rglob("*.nc"):
            yield file.name, digest(file.read_bytes())
    # What the settings change, so that a test can tell that they were honoured.
    yield "library", library()
    yield "simd", [name for name, there in __cpu_features__.items() if there]


def analyses():
    """Yield the hashes of small datasets of analyses of claims, and of a block of a sweep."""
    from extensions.atlas import cell, last_curve
    from extensions.claims.analyses import (
        clusters,
        control,
        exclusion,
        flux,
        jumps,
        rotation,
        spread,
    )  # fmt: skip
    from helpers.dataset_hash import content_hash

    for name, function, *given in (
        ("spread", spread.spread, 13, 2000, 4, [-0.44], 256, 8, 256),
        ("clusters", clusters.clusters, 16, 400, [4.0, 6.0], 2, 20, 1),
        ("control", control.control, [0.03], 20, 400, [0.1], 0.03, 20),
        ("rotation", rotation.rotation, [0.026], 15, 600, (-0.8344, -0.8341), 600),
        ("jumps", jumps.jumps, [0.0018], 60), ("flux", flux.flux, 6, 5e-3, 16, 300),
        ("exclusion", exclusion.exclusion, 20, 50),
        ("last", last_curve.last_curve, 3, (-0.2, -0.0325639), 60, [[0, 5, 1, 15]]),
    ):  # fmt: skip
        yield name, content_hash(function(BALL, ENERGY, *given))
    yield "cells", content_hash(cell.block_of_cells_of_a_sweep([[0.2, 6.25], [0.1, 0.3]], 20, 2000))


def short():
    """Yield the hashes of a table and an orbit that plain Python can follow too."""
    yield "short table", table(400)
    yield "short orbit", history(BALL.start(SEA, ENERGY), 150)


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
