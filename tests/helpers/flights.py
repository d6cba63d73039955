"""Hard flights, and the error of their times.

The correct time is the first root that pseudorigid.verified.reference_solver proves in ball
arithmetic. Where that solver cannot decide about a double root, or the time in doubles is another
root, the mpmath solver of independent_solver.py decides. A slow test compares the two solvers.
"""

import math

import mpmath
import numpy as np
from mpmath import mpf

from helpers.independent_solver import condition, judge
from helpers.sections import ball_of
from pseudorigid.verified.reference_solver import first_root

# Largest relative error of tau over max(1, condition), see Verdict; measured 4.1e-16 at 102,000
# states.
TAU = 5e-16


def log_uniform(rng, low, high):
    return math.exp(rng.uniform(math.log(low), math.log(high)))


def sign(rng):
    return 1.0 if rng.random() < 0.5 else -1.0


def any_ball(rng):
    return log_uniform(rng, 0.01, 1.0), log_uniform(rng, 1e-4, 1.0)


def ahead(v, w):
    """The velocities, or their opposites, that are on the section."""
    return (v, w) if v + w >= 0.0 else (-v, -w)


def before(k, b, c):
    """(v, w) just before the impact after which the velocities are b, c."""
    return ((1 - k) * b - 2 * k * c) / (1 + k), (-2 * b - (1 - k) * c) / (1 + k)


# Each family draws one (k, g, x, v, w) with v + w >= 0.


def wide(rng):
    size = 10.0 ** rng.uniform(-3.0, 0.5)
    x, v, w = size * rng.uniform(-1.0, 1.0, 3)
    return *any_ball(rng), x, *ahead(v, w)


def near_grazing(rng):
    """v + w is at least 1e-12, and x is above, at or below -g, down to a rounding."""
    k, g = any_ball(rng)
    x = -g * (1.0 + rng.integers(-1, 2) * log_uniform(rng, 1e-16, 1.0))
    v = sign(rng) * log_uniform(rng, 1e-4, 1.0)
    return k, g, x, *ahead(v, rng.choice([1e-12, log_uniform(rng, 1e-12, 1e-2)]) - v)


def on_the_rim(rng):
    """v + w = 0 exactly: the ball rests on the floor or leaves it without speed."""
    k, g = any_ball(rng)
    x = -g * (1.0 + rng.integers(-1, 2) * log_uniform(rng, 1e-15, 30.0))
    v = sign(rng) * log_uniform(rng, 1e-6, 1.0)
    return k, g, x, v, -v


def near_miss(rng):
    """A flight that touches the floor, f(t) = f'(t) = 0, and is then perturbed."""
    while True:
        k, g = any_ball(rng)
        t = mpf(log_uniform(rng, 1e-5, 40.0))
        if rng.random() < 0.5:
            x = g * sign(rng) * log_uniform(rng, 0.1, 1e3)
        else:
            x = -g * (1.0 + sign(rng) * log_uniform(rng, 1e-12, 1.0))
        cosine, sine = mpmath.cos_sin(t)
        c = (x * (1 - t * sine - cosine) - g * t * t / 2) / (t * cosine - sine)
        b = -g * t - (x * sine + c * cosine)
        if b + c < 0 and g + x * cosine - c * sine < 0 and max(abs(b) / g, abs(c)) < 1e3:
            break
    v, w = (float(a) for a in before(mpf(k), b, c))
    off = 1.0 + sign(rng) * log_uniform(rng, 1e-14, 1e-2)
    return (k, g, x, *ahead(v * off, w)) if rng.random() < 0.5 else (k, g, x * off, *ahead(v, w))


def long_flight(rng):
    """A flight of up to thousands of vibrations."""
    k, g = log_uniform(rng, 0.01, 1.0), log_uniform(rng, 1e-4, 1e-3)
    b = -log_uniform(rng, 1e-2, 1.0)
    x, c = rng.uniform(-1.0, 1.0, 2) * log_uniform(rng, 1e-3, 1.0) * -b
    return k, g, x, *ahead(*before(k, b, c))


def convex(rng):
    """The amplitude is below g, so the gap has no inflection."""
    k, g = any_ball(rng)
    x, c = g * rng.uniform(-0.7, 0.7, 2) * log_uniform(rng, 1e-3, 1.0)
    return k, g, x, *ahead(*before(k, -abs(c) - g * log_uniform(rng, 1e-6, 30.0), c))


FAMILIES = (wide, near_grazing, on_the_rim, near_miss, long_flight, convex)


def proved(state):
    """The proved tau of a state as an mpmath number, or None at a double root."""
    try:
        root = first_root(*state).mid()
    except ArithmeticError:
        return None
    mantissa, exponent = root.man_exp()
    return mpmath.ldexp(mpf(int(mantissa)), int(exponent))


def error(state):
    """The relative error of tau over max(1, condition) at a state; inf for another root."""
    state = tuple(float(a) for a in state)
    tau = ball_of(*state[:2]).time_to_impact(*state[2:])
    true = proved(state)
    if true is not None and true > 0 and tau > 0.0:
        off = abs(float((tau - true) / true))
        if off > TAU:
            off /= max(1.0, condition(*state, true))
        if off <= TAU:
            return off
    return by_mpmath(tau, judge(*state))


def by_mpmath(tau, true):
    """The relative error of tau against a Verdict."""
    if true.tau == 0 or tau == 0.0:
        return 0.0 if true.tau == tau else math.inf
    off = abs(float((tau - true.tau) / true.tau))
    if true.rival is not None:
        # The flight touches within rounding: either root is right, and known only to sqrt(eps).
        return 0.0 if min(off, abs(float((tau - true.rival) / true.rival))) < 1e-6 else math.inf
    return off / max(1.0, true.condition)


def draw(family, seed, count):
    """States of a family, of which each seed has its own."""
    rng = np.random.default_rng([seed, FAMILIES.index(family)])
    return [tuple(float(a) for a in family(rng)) for _ in range(count)]
