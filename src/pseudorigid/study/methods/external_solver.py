"""What the libraries' methods share: one flight at a time, from the velocities after the impact."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...kernel.impact_law import impact_coefficients, rebound

# Event detection looks for a change of sign, and a flight begins on the surface where the sign is
# 0: it is started this much later, on the exact flight; nothing returns to the floor that soon.
AFTER = 1e-9


@dataclass(frozen=True)
class ExternalSolver:
    """A method of a library.

    Parameters
    ----------
    name, family : str
    flight : callable
        (x, b, c, g, latest) -> (tau, evaluations) of one flight, from x with velocities b, c;
        tau is NaN where none is found. No root of the gap is later than `latest`.
    """

    name: str
    family: str
    flight: Callable

    def solve(self, ball, x, xdot, udot):
        """(tau, evaluations) for arrays (n,) of states."""
        b, c, _ = rebound(xdot, udot, ball.k, impact_coefficients(ball.k))
        # the parabola above the gap, x + b t + g t^2/2 - sqrt(x^2 + c^2), is positive from there on
        latest = (np.sqrt(b * b - 2.0 * ball.g * (x - np.hypot(x, c))) - b) / ball.g + 0.1
        states = zip(*(a.tolist() for a in (x, b, c, latest)), strict=True)
        found = [self.flight(x, b, c, ball.g, latest) for x, b, c, latest in states]
        tau, count = zip(*found, strict=True)
        return np.array(tau, dtype=float), np.array(count, dtype=np.int64)


def just_after(x, b, c, g):
    """(x, u, xdot, udot) of the flight at the time AFTER, eq. (26)."""
    sine, cosine = math.sin(AFTER), math.cos(AFTER)
    return (
        x + AFTER * (b + 0.5 * g * AFTER),
        c * sine - x * cosine,
        b + g * AFTER,
        c * cosine + x * sine,
    )
