"""Methods in this package's arithmetic: their results are part of the byte contract.

Each finds the flight that follows an impact at x with velocities b, c (and s = -(b + c), its exact
sum) and returns (tau, x', xdot', udot', evaluations of the gap). Three kinds:

    EXACT   the certified march of pseudorigid.flight
    SCAN    the paper's: steps of constant length until the gap changes sign, then bisection
            until the bracket is no longer than the tolerance
    ENGINE  a physics engine's: semi-implicit Euler until the ball overlaps the floor; the impact
            happens at the end of that time step
"""

import math
from dataclasses import dataclass

import numpy as np

from ...kernel import impact as kernel
from ...kernel.arithmetic import sincos
from ...kernel.compiled import jit
from ...kernel.scan import MOST, scan

EXACT, SCAN, ENGINE = 0, 1, 2


@jit
def engine(x, b, c, g, step):
    """(tau, x', xdot', udot', steps): positions and velocities as an engine has them."""
    position, strain, v, w = x, -x, b, c
    count = 0
    while True:
        count += 1
        v += step * g
        w -= step * strain
        position += step * v
        strain += step * w
        if position + strain >= 0.0 and v + w >= 0.0:
            return count * step, position, v, w, count
        if not count < MOST:
            return math.nan, position, v, w, count


@jit
def flight(kind, step, tolerance, x, v, w, k, g, head, low):
    """One impact and the flight that follows, by any kind: (tau, x', xdot', udot', evaluations)."""
    if kind == EXACT:
        p, v, q, tau, looks, _ = kernel.step(x, v, w, k, g, head, low, None)
        return tau, p, v, q, looks
    b, c, _ = kernel.rebound(v, w, k, head, low)
    if kind == ENGINE:
        return engine(x, b, c, g, step)
    tau, count = scan(x, b, c, g, step, tolerance)
    sine, cosine = sincos(tau)
    return tau, x * cosine - c * sine, b + g * tau, x * sine + c * cosine, count


@jit
def _flights(kind, step, tolerance, x, v, w, k, g, tau, count):
    head, low = kernel.transfer(k)
    for i in range(x.size):
        tau[i], _, _, _, count[i] = flight(kind, step, tolerance, x[i], v[i], w[i], k, g, head, low)


@jit
def _energy(x, v, w, k, g):
    return (0.5 * v * v + 0.5 * k * w * w) + x * (0.5 * k * x - g)


@jit
def _orbit(kind, step, tolerance, x, v, w, k, g, at, out):
    """States and largest relative energy error so far after `at` impacts: out (at.size, 4)."""
    head, low = kernel.transfer(k)
    first = _energy(x, v, w, k, g)
    worst = 0.0
    count = 0
    done = 0
    for j in range(at.size):
        while done < at[j]:
            _, x, v, w, looks = flight(kind, step, tolerance, x, v, w, k, g, head, low)
            count += looks
            done += 1
            off = abs(_energy(x, v, w, k, g) - first) / abs(first)
            if not off <= worst:
                worst = off
        out[j, 0], out[j, 1], out[j, 2], out[j, 3] = x, v, w, worst
    return count


@jit
def _missed(kind, step, tolerance, x, v, w, k, g, impacts):
    """How often it flies past an impact of the certified orbit: (missed, evaluations)."""
    head, low = kernel.transfer(k)
    missed = 0
    count = 0
    for _ in range(impacts):
        tau, _, _, _, looks = flight(kind, step, tolerance, x, v, w, k, g, head, low)
        x, v, w, truth, _, _ = kernel.step(x, v, w, k, g, head, low, None)
        if wrong(tau, truth):
            missed += 1
        count += looks
    return missed, count


@jit
def wrong(tau, truth):
    """Whether tau is off by more than a tenth of the flight or of a time unit, or NaN."""
    return not abs(tau - truth) <= 0.1 * min(truth, 1.0)


@jit
def _hard(kind, step, tolerance, x, v, w, k, g, impacts, out):
    head, low = kernel.transfer(k)
    count = 0
    for _ in range(impacts):
        tau, _, _, _, _ = flight(kind, step, tolerance, x, v, w, k, g, head, low)
        before = x, v, w
        x, v, w, truth, _, _ = kernel.step(x, v, w, k, g, head, low, None)
        if wrong(tau, truth) and count < out.shape[1]:
            out[0, count], out[1, count], out[2, count] = before
            count += 1
    return count


def hard_states(ball, state, impacts, method, most=10_000):
    """The first `most` states of the certified orbit whose next impact a method misses."""
    out = np.empty((3, most))
    how = method.kind, method.step, method.tolerance
    count = _hard(*how, *(float(a) for a in state), ball.k, ball.g, impacts, out)
    return out[:, :count].copy()


@dataclass(frozen=True)
class Counted:
    """One of the kinds above with its step and tolerance."""

    name: str
    family: str
    kind: int
    step: float = 0.0
    tolerance: float = 0.0

    def solve(self, ball, x, xdot, udot):
        """(tau, evaluations) for arrays (n,) of states; NaN where none is found."""
        tau = np.empty(x.size)
        count = np.empty(x.size, np.int64)
        _flights(*self._how, x, xdot, udot, ball.k, ball.g, tau, count)
        return tau, count

    def orbit(self, ball, state, at):
        """Its own orbit: (x, xdot, udot, largest energy error) after `at` impacts; evaluations."""
        at = np.asarray(at, np.int64)
        out = np.empty((at.size, 4))
        count = _orbit(*self._how, *(float(a) for a in state), ball.k, ball.g, at, out)
        return out, count

    def missed(self, ball, state, impacts):
        """(impacts of the certified orbit for which it gives another root, evaluations)."""
        return _missed(*self._how, *(float(a) for a in state), ball.k, ball.g, impacts)

    @property
    def _how(self):
        return self.kind, self.step, self.tolerance


OURS = Counted("certified march", "certified march", EXACT)


def scan_method(step, tolerance):
    """The paper's method with this step and tolerance."""
    return Counted(
        f"scan {step:g}, {tolerance:.0e}", f"scan {step:g} + bisection", SCAN, step, tolerance
    )


def engine_method(step):
    """A physics engine with this time step."""
    return Counted(f"engine {step:.0e}", "time stepping", ENGINE, step)


TOLERANCES = (1e-3, 1e-6, 1e-9, 1e-12)
SCANS = tuple(scan_method(step, tol) for step in (0.5, 0.1, 0.01) for tol in TOLERANCES)
ENGINES = tuple(engine_method(step) for step in (1e-1, 1e-2, 1e-3, 1e-4))
METHODS = (OURS, *SCANS, *ENGINES)
