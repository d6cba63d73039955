"""The method of inflections in SIMD lanes, to see whether lanes decide between it and the march.

    PYTHONPATH=src .venv/bin/python tests/study/lanes_of_inflections.py

prints nanoseconds an impact of an ensemble by both, and by each alone; it needs an idle machine.
The loop is that of pseudorigid.kernel.lanes, and first steps, evaluations and landings are its
functions. Only the step of the march is replaced: a lane that does not land yet looks at up to
three pieces from its last evaluation on, of which it computes the inflections. All three are
computed in all lanes, since a branch would keep LLVM from vectorising the loop.
"""

import math
import statistics
import time

import numpy as np

from pseudorigid.kernel import lanes as march
from pseudorigid.kernel.compiled import jit
from pseudorigid.kernel.flight import newton, series
from pseudorigid.kernel.impact import impact_coefficients, rebound
from pseudorigid.kernel.lanes import (
    DDF,
    DF,
    HIGH,
    LANDING,
    LANES,
    LOW,
    SIZE,
    TAU,
    X0,
    A,
    B,
    C,
    F,
    P,
    Q,
    T,
    V,
    W,
    X,
)
from study.methods.counted_methods import INFLECTIONS, OURS
from study.methods.inflections import BEST, angle, first_impact
from study.states import BALL, ENERGY, chaotic

ORBITS, IMPACTS, REPETITIONS = 1024, 200, 15
_TURN = 2.0 * math.pi
_CLEAR = 1e-12  # of f'', below which a lane at an inflection goes on alone
_ROUNDS = 50


@jit
def _piece(x, b, g, r, t, f, df, z, convex):
    """Return f, f' and Q at the end z of a piece, whether it has a root or one is inside."""
    q = r if convex else -r
    fz = (x + z * (b + 0.5 * g * z)) + g
    dz = b + g * z + q
    ends = fz >= 0.0
    over = f * (df - dz) + df * (fz - f - dz * (z - t)) >= 0.0
    inside = (not convex) & (not ends) & (df > 0.0) & (dz < 0.0) & over
    return fz, dz, q, ends, inside


@jit
def _pieces(lanes, n, g):
    """Choose the next time of n lanes, and return how many need the scalar method, with T = NaN."""
    alone = 0
    for i in range(n):
        x, b, c, t = lanes[X0 + i], lanes[B + i], lanes[C + i], lanes[T + i]
        f, df, ddf, p, q = lanes[F + i], lanes[DF + i], lanes[DDF + i], lanes[P + i], lanes[Q + i]
        landing, low, high = lanes[LANDING + i] != 0.0, lanes[LOW + i], lanes[HIGH + i]
        a = lanes[A + i]
        square = (x - g) * (x + g) + c * c
        r = math.sqrt(square if square > 0.0 else 0.0)
        convex = ddf > 0.0
        end = r if convex else -r
        length = 2.0 * angle(r, g)
        z1 = t + angle(end * p + g * q, end * q - g * p)
        z2 = z1 + (length if convex else _TURN - length)
        z3 = z2 + (_TURN - length if convex else length)
        f1, d1, q1, ends1, inside1 = _piece(x, b, g, r, t, f, df, z1, convex)
        f2, d2, q2, ends2, inside2 = _piece(x, b, g, r, z1, f1, d1, z2, not convex)
        f3, d3, q3, ends3, _ = _piece(x, b, g, r, z2, f2, d2, z3, convex)
        first, second = ends1 | inside1, ends2 | inside2
        found = ends1 | ((not first) & (ends2 | ((not second) & ends3)))
        # the piece in which to go on, from (t, f, ...) to (z, fz, ...)
        tl = t if first else z1 if second else z2
        fl = f if first else f1 if second else f2
        dl = df if first else d1 if second else d2
        bl = ddf if first else 0.0
        pl = p if first else -g
        ql = q if first else q1 if second else q2
        zh = z1 if first else z2 if second else z3
        fh = f1 if first else f2 if second else f3
        dh = d1 if first else d2 if second else d3
        qh = q1 if first else q2 if second else q3
        right = (dl <= 0.0) | ((dh > 0.0) & (fh * dl < -fl * dh))
        ts = zh if right else tl
        fs = fh if right else fl
        ds = dh if right else dl
        bs = 0.0 if right else bl
        ps = -g if right else pl
        qs = qh if right else ql
        # a lane that lands steps from its last evaluation
        ts = t if landing else ts
        fs = f if landing else fs
        ds = df if landing else ds
        bs = ddf if landing else bs
        ps = p if landing else ps
        qs = q if landing else qs
        low = low if landing else tl
        high = high if landing else zh
        h, applies, _ = series(fs, ds, bs, ps, qs, ts, a)
        root = ts + (h if applies else newton(fs, ds, bs, ps, qs))
        root = root if (low < root) & (root < high) else 0.5 * (low + high)
        lands = landing | found
        tangent = tl - fl / dl
        after = root if lands else (tangent if first | second else z3)
        common = landing | ((square > 0.0) & (abs(ddf) > _CLEAR) & (z1 > 0.25 * math.pi))
        common &= (ds > 0.0) & (fs != 0.0) if lands else after > t
        common &= (after > march._TINY) & (after < march.WIDE) & (after != t)
        lanes[T + i] = after if common else math.nan
        lanes[LOW + i], lanes[HIGH + i] = low, high
        lanes[LANDING + i] = 1.0 if lands else 0.0
        alone += 0 if common else 1
    return alone


@jit
def _step_alone(lanes, orbit, i, k, g, coefficients):
    """Do the whole flight of lane i by the scalar method."""
    j = orbit[i]
    b, c, s = rebound(lanes[V + j], lanes[W + j], k, coefficients)
    tau, p, q, _ = first_impact(lanes[X + j], b, c, s, g, BEST)
    v = b + g * tau
    lanes[X + j], lanes[V + j], lanes[W + j], lanes[TAU + j] = p, v, max(q, -v), tau
    lanes[T + i] = math.nan


@jit
def advance(lanes, orbit, n, k, g, coefficients):
    """Advance n orbits by one impact, as `march.advance`."""
    for i in range(n):
        orbit[i] = i
    march._begin_flights(lanes, n, k, g, coefficients)
    for _ in range(_ROUNDS):
        march._gaps(lanes, n, g)
        if march._find_ends(lanes, n, g) > 0:
            march._land(lanes, n, g)
            n = march._close_up(lanes, orbit, n)
        if n < 2:
            break
        if _pieces(lanes, n, g) > 0:
            for i in range(n):
                if math.isnan(lanes[T + i]):
                    _step_alone(lanes, orbit, i, k, g, coefficients)
    for i in range(n):
        if not math.isnan(lanes[T + i]):
            _step_alone(lanes, orbit, i, k, g, coefficients)


@jit
def steps(x, v, w, k, g, impacts, tau):
    """Advance states x, v, w (n,) in place; `tau` (n,) receives the times of the last flights."""
    coefficients = impact_coefficients(k)
    lanes, orbit = np.empty(SIZE), np.empty(LANES, np.int64)
    for first in range(0, x.size, LANES):
        n = min(LANES, x.size - first)
        for i in range(n):
            lanes[X + i], lanes[V + i], lanes[W + i] = x[first + i], v[first + i], w[first + i]
        for _ in range(impacts):
            advance(lanes, orbit, n, k, g, coefficients)
        for i in range(n):
            j = first + i
            x[j], v[j], w[j], tau[j] = lanes[X + i], lanes[V + i], lanes[W + i], lanes[TAU + i]


def ensemble(impacts, inflections):
    """Return the ends (4, ORBITS) of an ensemble of orbits by one of the methods."""
    start = BALL.start(0.52 + 0.1 * (np.arange(ORBITS) / ORBITS), ENERGY)
    x, v, w = (np.array(column) for column in start)
    tau = np.empty(ORBITS)
    if inflections:
        steps(x, v, w, BALL.k, BALL.g, impacts, tau)
    else:
        march.steps(x, v, w, BALL.k, BALL.g, impacts, tau, np.empty((0, 0, 4)))
    return np.array([x, v, w, tau])


if __name__ == "__main__":
    calls = {
        "march, lanes": (lambda: ensemble(IMPACTS, False), ORBITS * IMPACTS),
        "inflections, lanes": (lambda: ensemble(IMPACTS, True), ORBITS * IMPACTS),
        "march, one orbit": (lambda: OURS.orbit(BALL, chaotic(), 100_000), 100_000),
        "inflections, one orbit": (lambda: INFLECTIONS.orbit(BALL, chaotic(), 100_000), 100_000),
    }
    seconds = {name: [] for name in calls}
    for turn in range(REPETITIONS + 1):
        for name, (call, units) in calls.items():
            start = time.process_time()
            call()
            if turn:  # the first call compiles
                seconds[name].append((time.process_time() - start) / units)
    for name, values in seconds.items():
        print(f"{name}: {statistics.median(values) * 1e9:.1f} ns an impact")
