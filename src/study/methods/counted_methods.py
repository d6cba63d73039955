"""Methods in this package's arithmetic, whose results have the same bytes on every machine.

There are three kinds of method to find the flight after an impact:

    MARCH   the certified march of pseudorigid.kernel.flight
    SCAN    the paper's method: steps of constant length until the gap changes sign, then bisection
            until the bracket is no longer than the tolerance
    ENGINE  a physics engine: semi-implicit Euler steps until the ball overlaps the floor; the
            impact happens at the end of that time step
"""

import math
from dataclasses import dataclass

import numpy as np

from pseudorigid.kernel import impact as kernel
from pseudorigid.kernel.arithmetic import sincos
from pseudorigid.kernel.compiled import jit
from pseudorigid.kernel.impact import MOST_SCAN_STEPS, scan

MARCH, SCAN, ENGINE = 0, 1, 2


@jit
def _engine(x, b, c, g, step):
    """Return (tau, x', xdot', udot', steps) of a flight that begins at x with velocities b, c."""
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
        if not count < MOST_SCAN_STEPS:
            return math.nan, position, v, w, count


@jit
def _flight(kind, step, tolerance, x, v, w, k, g, coefficients):
    """Return (tau, x', xdot', udot', evaluations) of one impact and the flight that follows."""
    if kind == MARCH:
        p, v, q, tau, count, _ = kernel.step(x, v, w, k, g, coefficients, None)
        return tau, p, v, q, count
    b, c, _ = kernel.rebound(v, w, k, coefficients)
    if kind == ENGINE:
        return _engine(x, b, c, g, step)
    tau, count = scan(x, b, c, g, step, tolerance)
    sine, cosine = sincos(tau)
    return tau, x * cosine - c * sine, b + g * tau, x * sine + c * cosine, count


@jit
def _flights(kind, step, tolerance, x, v, w, k, g, tau, count):
    coefficients = kernel.impact_coefficients(k)
    for i in range(x.size):
        tau[i], _, _, _, count[i] = _flight(
            kind, step, tolerance, x[i], v[i], w[i], k, g, coefficients
        )


@jit
def _orbit(kind, step, tolerance, x, v, w, k, g, out):
    coefficients = kernel.impact_coefficients(k)
    total = 0
    for i in range(out.shape[1]):
        tau, x, v, w, count = _flight(kind, step, tolerance, x, v, w, k, g, coefficients)
        out[0, i], out[1, i], out[2, i], out[3, i] = x, v, w, tau
        total += count
    return total


@dataclass(frozen=True)
class CountedMethod:
    """A method of one of the kinds above, with its step and tolerance in time units."""

    name: str
    family: str
    kind: int
    step: float = 0.0
    tolerance: float = 0.0

    def solve(self, ball, x, xdot, udot) -> tuple[np.ndarray, np.ndarray]:
        """Return flight times and evaluations of states, arrays (n,); NaN if no root is found."""
        tau, count = np.empty(x.size), np.empty(x.size, np.int64)
        _flights(self.kind, self.step, self.tolerance, x, xdot, udot, ball.k, ball.g, tau, count)
        return tau, count

    def orbit(self, ball, state, impacts: int) -> tuple[np.ndarray, int]:
        """Return the method's own orbit from `state`, and the evaluations of all flights.

        The rows of the orbit (4, impacts) are x, xdot, udot just before each impact after the
        start, and the time tau of the flight that ends there.
        """
        track, settings = np.empty((4, impacts)), (self.kind, self.step, self.tolerance)
        return track, _orbit(*settings, *(float(a) for a in state), ball.k, ball.g, track)


OURS = CountedMethod("certified march", "certified march", MARCH)


def scan_method(step: float, tolerance: float) -> CountedMethod:
    """Return the paper's method with a step and a tolerance."""
    name, family = f"scan {step:g}, {tolerance:.0e}", f"scan {step:g} + bisection"
    return CountedMethod(name, family, SCAN, step, tolerance)


def engine_method(step: float) -> CountedMethod:
    """Return a physics engine with a time step."""
    return CountedMethod(f"engine {step:.0e}", "time stepping", ENGINE, step)


TOLERANCES = (1e-3, 1e-6, 1e-9, 1e-12)
SCANS = tuple(scan_method(step, tol) for step in (0.5, 0.1, 0.01) for tol in TOLERANCES)
ENGINES = tuple(engine_method(step) for step in (1e-1, 1e-2, 1e-3, 1e-4))
METHODS = (OURS, *SCANS, *ENGINES)
