"""Many orbits at once in SIMD lanes; results equal those of `impact.iterate` bit for bit.

Each of LANES orbits has a lane, and all lanes advance by one impact together. The gap, the march
and the landing are those of `flight`: the gap is negative in flight, the march goes towards its
first root without passing it, and a landing follows once no other root is in reach. A round
evaluates the gap once in every lane, with the functions that `flight.first_impact` calls. Most
flights need two rounds; lanes whose flight needs more are moved together, and only they have
another round. LLVM vectorises a loop over lanes only if the loop has no branch and makes every
selection before its first store, so a branch of `first_impact` is a selection between two values
here. The loops are short so that the processor overlaps several iterations. A lane that leaves the
common case is handled by itself: it takes a longer step of the march (`_stride_alone`), or
`impact.step` does its whole flight (`_step_alone`).
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

# Orbits that advance together. A row's length, 8 LANES bytes, is not a multiple of 1024, because
# rows that are a large power of two apart evict each other from the processor's cache.
LANES = 264
MIN_ORBITS_FOR_LANES = 12  # fewer orbits are faster one after the other
# One flat array `lanes` (SIZE,) has all rows, and these are their offsets: lanes[T + i] is the time
# in lane i. The first four rows are of orbits, which keep their places: the state just before an
# impact, and in TAU the time of the flight that ended there. lanes[X + orbit[i]] is of lane i.
X, V, W, TAU = (i * LANES for i in range(4))
# Rows of a lane's flight: position, velocities and contact speed after the impact; the bound of the
# amplitude; the time of the next evaluation, NaN where the flight is over; the results of
# `impact_free_time`; 1 in LANDING once a bracket (LOW, HIGH) of the root is known; the results of
# an evaluation; and the step to the root by `series`, NaN where that does not apply.
X0, B, C, S, A, T, RISE, RATE, FREE, LANDING, LOW, HIGH, F, DF, DDF, P, Q, STEP = (
    i * LANES for i in range(4, 22)
)
# Rows of decisions: 1 where the flight ends, and the state and the time of flight there; the next
# time of the march and 1 if `_march` is enough to find it; and one of three cases.
ENDS, P1, V1, Q1, TAU1, AHEAD, MARCHES, CASE = (i * LANES for i in range(22, 30))
SIZE = 30 * LANES
# `impact.step` does flights of more rounds than this, and flights whose time or contact speed is
# below _TINY, near the rounding of numbers of order one.
_MOST_ROUNDS = 50
_TINY = 1e-15
# Values of CASE: the common case, a lane for `_step_alone`, and a lane whose next step of the march
# is longer than `_march` finds.
_COMMON, _ALONE, _LONG = 0.0, 1.0, 2.0


@jit
def _begin_flights(lanes, n, k, g, coefficients):
    """Begin the flights of n lanes from their states.

    A lane outside the common case gets the time inf. Its gap is then NaN, so that `_find_ends` lets
    it land and `_choose` passes it on to `_step_alone`.
    """
    for i in range(n):
        x = lanes[X + i]
        b, c, s = rebound(lanes[V + i], lanes[W + i], k, coefficients)
        size = abs(x) + abs(b) + abs(c) + abs(s) + g
        s = max(s, 0.0)
        amplitude = amplitude_bound(x, c)
        t = first_step(x, c, s, g, amplitude)
        rise, rate, free = impact_free_time(x, b, g, amplitude)
        t = free if (t < free) & (t * rate >= rise) else t
        common = (size > 1.0 / HUGE) & (size < HUGE) & (s > _TINY) & (t > _TINY) & (t < WIDE)
        t = t if common else math.inf
        lanes[X0 + i], lanes[B + i], lanes[C + i], lanes[S + i] = x, b, c, s
        lanes[A + i], lanes[T + i] = amplitude, t
        lanes[RISE + i], lanes[RATE + i], lanes[FREE + i] = rise, rate, free
        lanes[LANDING + i] = 0.0


@jit
def _gaps(lanes, n, g):
    """Evaluate the gap in n lanes."""
    for i in range(n):
        x, b, c, s, t = lanes[X0 + i], lanes[B + i], lanes[C + i], lanes[S + i], lanes[T + i]
        f, df, ddf, p, q = gap(t, x, b, c, s, g, narrow_quadrant(t))
        lanes[F + i], lanes[DF + i], lanes[DDF + i], lanes[P + i], lanes[Q + i] = f, df, ddf, p, q


@jit
def _find_ends(lanes, n, g):
    """Find the lanes whose flight ends with a step of the series; return how many are over.

    A flight is over if this step is its last one, or if `_step_alone` has done it, so that T is
    NaN. The others' LANDING, LOW, HIGH and STEP are brought up to date.
    """
    over = 0
    for i in range(n):
        f, df, ddf, p, q = lanes[F + i], lanes[DF + i], lanes[DDF + i], lanes[P + i], lanes[Q + i]
        t, amplitude = lanes[T + i], lanes[A + i]
        was_landing, low, high = lanes[LANDING + i] != 0.0, lanes[LOW + i], lanes[HIGH + i]
        below = f < 0.0
        landing = was_landing | (not below) | rises_to_its_root(-f, df, ddf, q, g, amplitude)
        low = t if (not was_landing) | below else low
        high = (high if below else t) if was_landing else math.inf
        h, applies, accurate = series(f, df, ddf, p, q, t, amplitude)
        ends = landing & applies & accurate & (df > 0.0) & (f != 0.0)
        h = h if applies else math.nan
        over += 1 if ends | math.isnan(t) else 0
        lanes[LANDING + i], lanes[LOW + i], lanes[HIGH + i] = 1.0 if landing else 0.0, low, high
        lanes[STEP + i], lanes[ENDS + i] = h, 1.0 if ends else 0.0
    return over


@jit
def _land(lanes, n, g):
    """Compute the states at the ends of flights."""
    for i in range(n):
        t, h = lanes[T + i], lanes[STEP + i]
        p, q = rotated(lanes[P + i], lanes[Q + i], h)
        tau = t + h
        v = lanes[B + i] + g * tau
        lanes[P1 + i], lanes[V1 + i], lanes[Q1 + i], lanes[TAU1 + i] = p, v, max(q, -v), tau


@jit
def _close_up(lanes, orbit, n):
    """Store the states of n lanes whose flight ends, and return how many lanes still fly."""
    flying = 0
    for i in range(n):
        j = orbit[i]
        if lanes[ENDS + i] != 0.0:
            lanes[X + j], lanes[V + j] = lanes[P1 + i], lanes[V1 + i]
            lanes[W + j], lanes[TAU + j] = lanes[Q1 + i], lanes[TAU1 + i]
        elif not math.isnan(lanes[T + i]):
            for row in range(X0, STEP + LANES, LANES):
                lanes[row + flying] = lanes[row + i]
            orbit[flying] = j
            flying += 1
    return flying


@jit
def _march(lanes, n, g):
    """Compute the next time of the march in n lanes."""
    for i in range(n):
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
def _choose(lanes, n):
    """Choose the next time of n lanes, and return 0 if every lane is in the common case.

    A lane that lands steps to its root, by the series or else by Newton's method; any other lane
    takes the step of the march.
    """
    exceptions = 0
    for i in range(n):
        f, df, ddf, p, q = lanes[F + i], lanes[DF + i], lanes[DDF + i], lanes[P + i], lanes[Q + i]
        t, h, ahead = lanes[T + i], lanes[STEP + i], lanes[AHEAD + i]
        landing, low, high = lanes[LANDING + i] != 0.0, lanes[LOW + i], lanes[HIGH + i]
        marches = lanes[MARCHES + i] != 0.0
        newton_step = newton(f, df, ddf, p, q)
        root = t + (newton_step if math.isnan(h) else h)
        lands = (df > 0.0) & (f != 0.0) & (low < root) & (root < high) & (root != t)
        after = root if landing else ahead
        common = (lands if landing else marches) & (after > _TINY) & (after < WIDE)
        case = _ALONE if landing | (not t < WIDE) else _LONG
        case = _COMMON if common else case
        lanes[T + i], lanes[CASE + i] = after if common else t, case
        exceptions += int(case)
    return exceptions


@jit
def _stride_alone(lanes, i, g):
    """Do the next step of the march of lane i, and return whether it moves the lane."""
    t = lanes[T + i]
    f, df, ddf, q = lanes[F + i], lanes[DF + i], lanes[DDF + i], lanes[Q + i]
    ahead = t + longest_stride(-f, df, ddf, q, g, lanes[A + i])
    if ahead < lanes[FREE + i] and ahead * lanes[RATE + i] >= lanes[RISE + i]:
        ahead = lanes[FREE + i]
    lanes[T + i] = ahead
    return t < ahead < WIDE


@jit
def _step_alone(lanes, orbit, i, k, g, coefficients):
    """Do the whole flight of lane i."""
    j = orbit[i]
    x, v, w, tau, _, _ = step(lanes[X + j], lanes[V + j], lanes[W + j], k, g, coefficients, None)
    lanes[X + j], lanes[V + j], lanes[W + j], lanes[TAU + j] = x, v, w, tau
    lanes[T + i] = math.nan


@jit
def advance(lanes, orbit, n, k, g, coefficients):
    """Advance n orbits by one impact. `orbit` (LANES,) is overwritten by the orbit of each lane."""
    for i in range(n):
        orbit[i] = i
    _begin_flights(lanes, n, k, g, coefficients)
    for _ in range(_MOST_ROUNDS):
        _gaps(lanes, n, g)
        if _find_ends(lanes, n, g) > 0:
            _land(lanes, n, g)
            n = _close_up(lanes, orbit, n)
        if n < 2:
            break  # a round of one lane takes longer than `_step_alone`
        _march(lanes, n, g)
        if _choose(lanes, n) > 0:
            for i in range(n):
                case = lanes[CASE + i]
                if case == _ALONE or (case == _LONG and not _stride_alone(lanes, i, g)):
                    _step_alone(lanes, orbit, i, k, g, coefficients)
    for i in range(n):
        if not math.isnan(lanes[T + i]):
            _step_alone(lanes, orbit, i, k, g, coefficients)


@jit
def iterate(x, v, w, k, g, impacts, tau, out):
    """Advance states x, v, w (n,) in place by at least one impact.

    Results equal those of `impact.iterate` bit for bit. `tau` (n,) receives the times of the last
    flights, and `out` (n, impacts, 4), unless it is empty, x, v, w and tau of every impact.
    """
    coefficients = impact_coefficients(k)
    lanes, orbit = np.empty(SIZE), np.empty(LANES, np.int64)
    for first in range(0, x.size, LANES):
        n = min(LANES, x.size - first)
        for i in range(n):
            lanes[X + i], lanes[V + i], lanes[W + i] = x[first + i], v[first + i], w[first + i]
        for m in range(impacts):
            advance(lanes, orbit, n, k, g, coefficients)
            if out.size > 0:
                for i in range(n):
                    j = first + i
                    out[j, m, 0], out[j, m, 1] = lanes[X + i], lanes[V + i]
                    out[j, m, 2], out[j, m, 3] = lanes[W + i], lanes[TAU + i]
        for i in range(n):
            j = first + i
            x[j], v[j], w[j], tau[j] = lanes[X + i], lanes[V + i], lanes[W + i], lanes[TAU + i]
