"""Methods of libraries, applied to one flight at a time from the velocities after the impact."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from pseudorigid.dynamics.ball import Ball
from pseudorigid.kernel.formulas import impact_coefficients, rebound

from . import Flights, Method

FirstRoot = Callable[[float, float, float, float, float], tuple[float, int]]
# Time after the impact at which integration starts, on the exact flight: event detection looks for
# a change of sign, and the gap is 0 at the impact itself. No flight is as short as this.
AFTER = 1e-9


@dataclass
class ExternalSolver(Method):
    """A method of a library.

    `flight` takes (x, b, c, g, latest) and returns (tau, evaluations) of the flight from x with
    velocities b, c; tau is NaN if none is found. No root of the gap is later than `latest`.
    """

    name: str
    family: str
    flight: FirstRoot

    def solve(self, ball: Ball, x: np.ndarray, xdot: np.ndarray, udot: np.ndarray) -> Flights:
        """Return flight times and evaluations of states, arrays (n,)."""
        b, c, _ = rebound(xdot, udot, ball.k, impact_coefficients(ball.k))
        # the parabola below the gap, x + b t + g t^2/2 - sqrt(x^2 + c^2), is positive after that
        latest = (np.sqrt(b * b - 2.0 * ball.g * (x - np.hypot(x, c))) - b) / ball.g + 0.1
        states = zip(*(a.tolist() for a in (x, b, c, latest)), strict=True)
        flights = [self.flight(x, b, c, ball.g, latest) for x, b, c, latest in states]
        tau, count = zip(*flights, strict=True)
        return np.array(tau, dtype=float), np.array(count, dtype=np.int64)


def just_after(x: float, b: float, c: float, g: float) -> tuple[float, float, float, float]:
    """Return (x, u, xdot, udot) of the flight at the time AFTER, eq. (26)."""
    sine, cosine = math.sin(AFTER), math.cos(AFTER)
    height, strain = x + AFTER * (b + 0.5 * g * AFTER), c * sine - x * cosine
    return height, strain, b + g * AFTER, c * cosine + x * sine
