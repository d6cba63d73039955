"""Many orbits at once in SIMD lanes, with the bits of `impact.steps`.

Each of LANES orbits has a lane. A round evaluates the gap once in every lane, at whatever stage its
flight is, with the functions that `flight.first_impact` calls. LLVM vectorises a loop over lanes
only if the loop has no branch and makes every selection before its first store, so a branch of
`first_impact` is a selection between two values here. The loops are short so that the processor
overlaps several iterations. A lane that leaves the common case has its flight done by
`impact.step`.
"""

import math

import numpy as np

from .arithmetic import WIDE, narrow_quadrant
from .compiled import jit
from .flight import (
    HUGE,
    amplitude_bound,
    first_step,
    gap,
    impact_free_time,
    longest_stride,
    newton,
    rises_to_its_root,
    rotated,
    series,
    stride,
    sure_stride,
)
from .impact import impact_coefficients, rebound, step

LANES = 32  # orbits; four iterations of a loop over vectors of eight doubles
MIN_ORBITS_FOR_LANES = 12  # fewer orbits are faster one after the other
# Offsets of the rows of a lane's state: the state, the time of the flight before it, the impacts
# left, the time of the next evaluation, 1 in LANDING once a bracket (LOW, HIGH) of the root is
# known, the results of `impact_free_time`, and the evaluations of this flight.
X, V, W, TAU, LEFT, T, LANDING, LOW, HIGH, RISE, RATE, FREE, EVALUATIONS = (
    i * LANES for i in range(13)
)
# Rows of results of an evaluation.
F, DF, DDF, P, Q, B, C, S, A = (i * LANES for i in range(13, 22))
# Rows of decisions: the next time of the march and 1 if `_march` is enough to find it; the step to
# the root and 1 if it is the last; the time chosen, 1 if the impact is there, and one of three
# cases.
AHEAD, MARCHES, STEP, LAST, NEXT, DONE, ODD = (i * LANES for i in range(22, 29))
SIZE = 29 * LANES
# `impact.step` does flights with more evaluations than this (2 or 3 are usual), and flights whose
# time or contact speed is below _TINY, near the rounding of numbers of order one.
_MOST_EVALUATIONS = 50.0
_TINY = 1e-15
# Values of ODD: the common case, a lane for `_step_alone`, and a lane whose next step of the march
# is longer than `_march` finds.
_PLAIN, _ALONE, _LONG = 0.0, 1.0, 2.0


@jit
def _gaps(lanes, k, g, coefficients):
    """Evaluate the gap in every lane."""
    for i in range(LANES):
        x, v, w, t = lanes[X + i], lanes[V + i], lanes[W + i], lanes[T + i]
        b, c, s = rebound(v, w, k, coefficients)
        s = max(s, 0.0)
        f, df, ddf, p, q = gap(t, x, b, c, s, g, narrow_quadrant(t))
        lanes[F + i], lanes[DF + i], lanes[DDF + i], lanes[P + i], lanes[Q + i] = f, df, ddf, p, q
        lanes[B + i], lanes[C + i], lanes[S + i], lanes[A + i] = b, c, s, amplitude_bound(x, c)


@jit
def _march(lanes, g):
    """Compute the next time of the march in every lane."""
    for i in range(LANES):
        f, df, ddf, q = lanes[F + i], lanes[DF + i], lanes[DDF + i], lanes[Q + i]
        t, amplitude = lanes[T + i], lanes[A + i]
        rise, rate, free = lanes[RISE + i], lanes[RATE + i], lanes[FREE + i]
        sure = sure_stride(-f, df, g, amplitude)
        bounded = stride(-f, df, ddf, q, g, amplitude, 2.0 * sure)
        ahead = t + max(sure, bounded)
        marches = (bounded < 2.0 * sure) & (ahead != t)
        ahead = free if (ahead < free) & (ahead * rate >= rise) else ahead
        lanes[AHEAD + i] = ahead
        lanes[MARCHES + i] = 1.0 if marches else 0.0


@jit
def _land(lanes):
    """Compute the step to the root in every lane."""
    for i in range(LANES):
        f, df, ddf, p, q = lanes[F + i], lanes[DF + i], lanes[DDF + i], lanes[P + i], lanes[Q + i]
        h, near, last = series(f, df, ddf, p, q, lanes[T + i], lanes[A + i])
        h = h if near else newton(f, df, ddf, p, q)
        lanes[STEP + i] = h
        lanes[LAST + i] = 1.0 if last & near else 0.0


@jit
def _follow(lanes, g):
    """Choose the next time of every lane, as `flight.first_impact` does."""
    for i in range(LANES):
        f, df, ddf, q = lanes[F + i], lanes[DF + i], lanes[DDF + i], lanes[Q + i]
        t, amplitude = lanes[T + i], lanes[A + i]
        was_landing, low, high = lanes[LANDING + i] != 0.0, lanes[LOW + i], lanes[HIGH + i]
        evaluations, h, ahead = lanes[EVALUATIONS + i], lanes[STEP + i], lanes[AHEAD + i]
        marches, last = lanes[MARCHES + i] != 0.0, lanes[LAST + i] != 0.0
        below = f < 0.0
        landing = was_landing | (not below) | rises_to_its_root(-f, df, ddf, q, g, amplitude)
        low = t if (not was_landing) | below else low
        high = (high if below else t) if was_landing else math.inf
        after = t + h
        lands = (df > 0.0) & (f != 0.0) & (last | ((low < after) & (after < high) & (after != t)))
        usual = (
            (t > _TINY) & (t < WIDE) & (lanes[S + i] > _TINY) & (evaluations < _MOST_EVALUATIONS)
        )
        plain = (lands if landing else marches) & usual
        flag = 1.0 if landing else 0.0
        done = 1.0 if landing & last else 0.0
        odd = _ALONE if landing | (not usual) else _LONG
        odd = _PLAIN if plain else odd
        following = after if landing else ahead
        lanes[NEXT + i], lanes[DONE + i], lanes[ODD + i] = following, done, odd
        lanes[LANDING + i], lanes[LOW + i], lanes[HIGH + i] = flag, low, high
        lanes[EVALUATIONS + i] = evaluations + 1.0


@jit
def _end_flights(lanes, k, g, coefficients):
    """Advance lanes whose flight has ended, and return 0 if every lane is in the common case."""
    exceptions = 0
    for i in range(LANES):
        x, v, w, tau, t = (lanes[X + i], lanes[V + i], lanes[W + i], lanes[TAU + i], lanes[T + i])
        rise, rate, free = lanes[RISE + i], lanes[RATE + i], lanes[FREE + i]
        evaluations, left = lanes[EVALUATIONS + i], lanes[LEFT + i]
        landing, after, odd = lanes[LANDING + i], lanes[NEXT + i], lanes[ODD + i]
        moved = (lanes[DONE + i] != 0.0) & (odd == 0.0) & (left > 0.0)
        p, q = rotated(lanes[P + i], lanes[Q + i], lanes[STEP + i])
        v1 = lanes[B + i] + g * after
        q = max(q, -v1)
        b, c, s = rebound(v1, q, k, coefficients)
        amplitude = amplitude_bound(p, c)
        first = first_step(p, c, max(s, 0.0), g, amplitude)
        rise1, rate1, free1 = impact_free_time(p, b, g, amplitude)
        first = free1 if (first < free1) & (first * rate1 >= rise1) else first
        x, v, w, tau = (p, v1, q, after) if moved else (x, v, w, tau)
        t = first if moved else (after if odd == 0.0 else t)
        rise, rate, free = (rise1, rate1, free1) if moved else (rise, rate, free)
        landing, evaluations = (0.0, 0.0) if moved else (landing, evaluations)
        left = left - 1.0 if moved else left
        ended = _ALONE if moved & (left == 0.0) else _PLAIN
        odd = odd if (odd != _PLAIN) & (left > 0.0) else ended
        lanes[X + i], lanes[V + i], lanes[W + i], lanes[TAU + i] = x, v, w, tau
        lanes[RISE + i], lanes[RATE + i], lanes[FREE + i], lanes[T + i] = rise, rate, free, t
        lanes[LANDING + i], lanes[EVALUATIONS + i], lanes[LEFT + i] = landing, evaluations, left
        lanes[ODD + i] = odd
        exceptions += int(odd)
    return exceptions


@jit
def _begin_flight(lanes, i, k, g, coefficients):
    """Begin the flight of lane i from its state."""
    x = lanes[X + i]
    b, c, s = rebound(lanes[V + i], lanes[W + i], k, coefficients)
    amplitude = amplitude_bound(x, c)
    t = first_step(x, c, max(s, 0.0), g, amplitude)
    rise, rate, free = impact_free_time(x, b, g, amplitude)
    if t < free and t * rate >= rise:
        t = free
    lanes[T + i], lanes[RISE + i], lanes[RATE + i], lanes[FREE + i] = t, rise, rate, free
    size = abs(x) + abs(b) + abs(c) + abs(s) + g
    usual = 1.0 / HUGE < size < HUGE
    lanes[EVALUATIONS + i] = 0.0 if usual else math.inf  # `impact.step` changes the unit of length
    lanes[LANDING + i] = 0.0


@jit
def _stride_alone(lanes, i, g):
    """Do the next step of the march of lane i, and return whether it moves the lane."""
    t = lanes[T + i]
    f, df, ddf, q = lanes[F + i], lanes[DF + i], lanes[DDF + i], lanes[Q + i]
    ahead = t + longest_stride(-f, df, ddf, q, g, lanes[A + i])
    if ahead < lanes[FREE + i] and ahead * lanes[RATE + i] >= lanes[RISE + i]:
        ahead = lanes[FREE + i]
    lanes[T + i] = ahead
    return ahead > t


@jit
def _step_alone(lanes, i, k, g, coefficients):
    """Do the whole flight of lane i, and begin the next one."""
    x, v, w, tau, _, _ = step(lanes[X + i], lanes[V + i], lanes[W + i], k, g, coefficients, None)
    lanes[X + i], lanes[V + i], lanes[W + i], lanes[TAU + i] = x, v, w, tau
    lanes[LEFT + i] -= 1.0
    _begin_flight(lanes, i, k, g, coefficients)


@jit
def _begin_orbit(lanes, i, x, v, w, impacts, k, g, coefficients):
    """Start a new orbit in lane i."""
    lanes[X + i], lanes[V + i], lanes[W + i], lanes[TAU + i] = x, v, w, math.nan
    lanes[LEFT + i] = impacts
    _begin_flight(lanes, i, k, g, coefficients)


@jit
def _store(lanes, orbit, impacts, out):
    """Write the newest state of every lane; before the first impact it is overwritten later."""
    for i in range(orbit.size):
        j, m = orbit[i], max(int(impacts - lanes[LEFT + i]) - 1, 0)
        out[j, m, 0], out[j, m, 1] = lanes[X + i], lanes[V + i]
        out[j, m, 2], out[j, m, 3] = lanes[W + i], lanes[TAU + i]


@jit
def steps(x, v, w, k, g, impacts, tau, out):
    """Advance states x, v, w (n,) in place, with the bits of `impact.steps`; n, impacts >= 1.

    `tau` (n,) receives the times of the last flights, and `out` (n, impacts, 4), unless it is
    empty, x, v, w and tau of every impact.
    """
    coefficients = impact_coefficients(k)
    lanes = np.zeros(SIZE)
    begun = min(x.size, LANES)
    orbit = np.arange(begun)
    for i in range(LANES):
        j = min(i, x.size - 1)  # a lane without an orbit gets the last state and no impacts
        _begin_orbit(lanes, i, x[j], v[j], w[j], impacts if i < x.size else 0, k, g, coefficients)
    flying = begun
    while flying > 0:
        _gaps(lanes, k, g, coefficients)
        _march(lanes, g)
        _land(lanes)
        _follow(lanes, g)
        exceptions = _end_flights(lanes, k, g, coefficients)
        if exceptions > 0:
            for i in range(LANES):
                if lanes[ODD + i] == 0.0 or lanes[LEFT + i] == 0.0:
                    continue
                if lanes[ODD + i] != _LONG or not _stride_alone(lanes, i, g):
                    _step_alone(lanes, i, k, g, coefficients)
        if out.size > 0:
            _store(lanes, orbit, impacts, out)
        if exceptions > 0:
            for i in range(LANES):
                if lanes[ODD + i] != 0.0 and lanes[LEFT + i] == 0.0:
                    j = orbit[i]
                    x[j], v[j], w[j] = lanes[X + i], lanes[V + i], lanes[W + i]
                    tau[j] = lanes[TAU + i]
                    flying -= 1
                    if begun < x.size:
                        j = begun
                        orbit[i] = j
                        _begin_orbit(lanes, i, x[j], v[j], w[j], impacts, k, g, coefficients)
                        begun += 1
                        flying += 1
