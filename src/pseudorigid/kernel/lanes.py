"""Many orbits at once: the steps of `impact`, in SIMD lanes.

Each of LANES orbits is a lane. A round evaluates the gap once for every lane, whatever its
flight has come to, with the functions and so the bits of `flight.first_impact`. What that function
decides by a branch is here a choice between two values, in loops that the compiler turns into
vector instructions: no `if`, every choice before the first store, and each loop short enough for
the processor to work on several of its turns at once. A lane that meets anything but the common
case has its flight done by `impact.step`.
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

LANES = 32  # four turns of a loop with vectors of eight doubles, eight with vectors of four
MIN_ORBITS_FOR_LANES = 12  # fewer orbits than this are faster one after the other
# The state of a lane, the flight that led there, and how many impacts are left; of the flight under
# way the time to evaluate at, 1 once it is close to its root, the bracket then, what
# `impact_free_time` gave, and how many evaluations it took.
X, V, W, TAU, LEFT, T, LANDING, LOW, HIGH, RISE, RATE, FREE, EVALUATIONS = (
    i * LANES for i in range(13)
)
# What an evaluation gives; the next time by the march and 1 if that is a plain step of it; the step
# to the root and 1 if it is the last; then the next time, 1 for an impact there, and whether the
# lane is left to the functions for one orbit.
F, DF, DDF, P, Q, B, C, S, A = (i * LANES for i in range(13, 22))
AHEAD, MARCHES, STEP, LAST, NEXT, DONE, ODD = (i * LANES for i in range(22, 29))
SIZE = 29 * LANES
# What is left to `impact.step`: flights of more evaluations, where 2 or 3 are usual, and of times
# or speeds near the rounding of numbers of order one.
_MOST_EVALUATIONS = 50.0
_TINY = 1e-15
# The values of ODD: a lane in the common case, one that is left to `_step_alone`, and one whose
# next step of the march is longer than `_march` can tell.
_PLAIN, _ALONE, _LONG = 0.0, 1.0, 2.0


@jit
def _gaps(lanes, k, g, coefficients):
    for i in range(LANES):
        x, v, w, t = lanes[X + i], lanes[V + i], lanes[W + i], lanes[T + i]
        b, c, s = rebound(v, w, k, coefficients)
        s = max(s, 0.0)
        f, df, ddf, p, q = gap(t, x, b, c, s, g, narrow_quadrant(t))
        lanes[F + i], lanes[DF + i], lanes[DDF + i], lanes[P + i], lanes[Q + i] = f, df, ddf, p, q
        lanes[B + i], lanes[C + i], lanes[S + i], lanes[A + i] = b, c, s, amplitude_bound(x, c)


@jit
def _march(lanes, g):
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
    for i in range(LANES):
        f, df, ddf, p, q = lanes[F + i], lanes[DF + i], lanes[DDF + i], lanes[P + i], lanes[Q + i]
        h, near, last = series(f, df, ddf, p, q, lanes[T + i], lanes[A + i])
        h = h if near else newton(f, df, ddf, p, q)
        lanes[STEP + i] = h
        lanes[LAST + i] = 1.0 if last & near else 0.0


@jit
def _follow(lanes, g):
    """Where each lane goes from here, as in `flight.first_impact`."""
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
    """The next state where a flight has ended, and the flight from there.

    Returns 0 where every lane goes on in the common case and no orbit has ended.
    """
    wanting = 0
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
        wanting += int(odd)
    return wanting


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
    usual = 1.0 / HUGE < size < HUGE  # or the unit of length has to be changed
    lanes[EVALUATIONS + i] = 0.0 if usual else math.inf
    lanes[LANDING + i] = 0.0


@jit
def _stride_alone(lanes, i, g):
    """Do the next step of the march of lane i on its own; whether that moves it."""
    t = lanes[T + i]
    f, df, ddf, q = lanes[F + i], lanes[DF + i], lanes[DDF + i], lanes[Q + i]
    ahead = t + longest_stride(-f, df, ddf, q, g, lanes[A + i])
    if ahead < lanes[FREE + i] and ahead * lanes[RATE + i] >= lanes[RISE + i]:
        ahead = lanes[FREE + i]
    lanes[T + i] = ahead
    return ahead > t


@jit
def _step_alone(lanes, i, k, g, coefficients):
    """Do the whole flight of lane i on its own, and begin the next."""
    x, v, w, tau, _, _ = step(lanes[X + i], lanes[V + i], lanes[W + i], k, g, coefficients, None)
    lanes[X + i], lanes[V + i], lanes[W + i], lanes[TAU + i] = x, v, w, tau
    lanes[LEFT + i] -= 1.0
    _begin_flight(lanes, i, k, g, coefficients)


@jit
def _begin_orbit(lanes, i, x, v, w, impacts, k, g, coefficients):
    """Give lane i a new orbit."""
    lanes[X + i], lanes[V + i], lanes[W + i], lanes[TAU + i] = x, v, w, math.nan
    lanes[LEFT + i] = impacts
    _begin_flight(lanes, i, k, g, coefficients)


@jit
def _store(lanes, orbit, impacts, out):
    """The newest state of every lane; before the first impact it is overwritten later."""
    for i in range(orbit.size):
        j, m = orbit[i], max(int(impacts - lanes[LEFT + i]) - 1, 0)
        out[j, m, 0], out[j, m, 1] = lanes[X + i], lanes[V + i]
        out[j, m, 2], out[j, m, 3] = lanes[W + i], lanes[TAU + i]


@jit
def steps(x, v, w, k, g, impacts, tau, out):
    """Advance states by a number of impacts in place, with the bits of `impact.steps`.

    Parameters
    ----------
    x, v, w : ndarray, shape (n,)
        States just before an impact, n >= 1; overwritten.
    k, g : float
        The ball.
    impacts : int
        At least 1.
    tau : ndarray, shape (n,)
        The last flights' times are written here.
    out : ndarray, shape (n, impacts, 4)
        x, v, w and tau of every impact are written here, unless it is empty.
    """
    coefficients = impact_coefficients(k)
    lanes = np.zeros(SIZE)
    begun = min(x.size, LANES)
    orbit = np.arange(begun)
    for i in range(LANES):
        j = min(i, x.size - 1)  # a lane without an orbit repeats the last one, with nothing left
        _begin_orbit(lanes, i, x[j], v[j], w[j], impacts if i < x.size else 0, k, g, coefficients)
    flying = begun
    while flying > 0:
        _gaps(lanes, k, g, coefficients)
        _march(lanes, g)
        _land(lanes)
        _follow(lanes, g)
        wanting = _end_flights(lanes, k, g, coefficients)
        if wanting > 0:
            for i in range(LANES):
                if lanes[ODD + i] == 0.0 or lanes[LEFT + i] == 0.0:
                    continue
                if lanes[ODD + i] != _LONG or not _stride_alone(lanes, i, g):
                    _step_alone(lanes, i, k, g, coefficients)
        if out.size > 0:
            _store(lanes, orbit, impacts, out)
        if wanting > 0:
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
