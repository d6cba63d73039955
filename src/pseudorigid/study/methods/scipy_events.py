"""Rivals from scipy: a scan refined by brentq, and solve_ivp with a terminal event."""

import math
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from ...kernel import impact as kernel

# Event detection looks for a change of sign, and a flight begins on the surface where the sign is
# 0: it is started this much later, on the exact flight.
AFTER = 1e-9
# The first steps tried. LSODA does not look into its first one closely enough to see a flight that
# ends in it; a tiny one costs it nothing.
FIRST_STEP = {"LSODA": 1e-8}
OTHERS_FIRST_STEP = 1e-2


def launched(ball, x, xdot, udot):
    """Velocities (b, c) after the impact, and a time after every root of the gap."""
    b, c, _ = kernel.rebound(xdot, udot, ball.k, *kernel.transfer(ball.k))
    below = b * b - 2.0 * ball.g * (x - math.hypot(x, c))
    return b, c, (math.sqrt(below) - b) / ball.g + 0.1


def each(one, ball, x, xdot, udot):
    """(tau, evaluations) for arrays of states from a function of one state."""
    found = [
        one(ball, *state) for state in zip(x.tolist(), xdot.tolist(), udot.tolist(), strict=True)
    ]
    tau, count = zip(*found, strict=True)
    return np.array(tau, dtype=float), np.array(count, dtype=np.int64)


@dataclass(frozen=True)
class ScanBrentq:
    """A vectorised scan, 64 steps at a time, refined by scipy.optimize.brentq."""

    step: float
    tolerance: float
    name: str = ""
    family: str = ""

    def solve(self, ball, x, xdot, udot):
        """(tau, evaluations); NaN where there is no change of sign."""
        return each(self._one, ball, x, xdot, udot)

    def _one(self, ball, x, xdot, udot):
        g = ball.g
        b, c, end = launched(ball, x, xdot, udot)
        count = 0

        def gap(t):
            return x + t * (b + 0.5 * g * t) - x * math.cos(t) + c * math.sin(t)

        start = 0.0
        while start < end:
            t = start + self.step * np.arange(1, 65)
            above = x + t * (b + 0.5 * g * t) - x * np.cos(t) + c * np.sin(t) > 0.0
            if above.any():
                first = int(above.argmax())
                count += first + 1
                high = float(t[first])
                low = high - self.step if first or start else 0.0
                if low == 0.0:  # the root at 0 is not the one
                    low = min(1e-9, 0.5 * high)
                if gap(low) >= 0.0:
                    return low, count + 1
                root, how = brentq(
                    gap, low, high, xtol=self.tolerance, rtol=1e-15, full_output=True
                )
                return root, count + how.function_calls
            count += t.size
            start = float(t[-1])
        return math.nan, count


@dataclass(frozen=True)
class Ivp:
    """solve_ivp with a terminal event where the gap rises through 0."""

    solver: str
    rtol: float
    max_step: float = math.inf
    name: str = ""
    family: str = ""

    def solve(self, ball, x, xdot, udot):
        """(tau, evaluations of the right-hand side); NaN where the event is not seen."""
        return each(self._one, ball, x, xdot, udot)

    def _one(self, ball, x, xdot, udot):
        g = ball.g
        b, c, end = launched(ball, x, xdot, udot)
        start = [
            x + AFTER * (b + 0.5 * g * AFTER),
            c * math.sin(AFTER) - x * math.cos(AFTER),
            b + g * AFTER,
            c * math.cos(AFTER) + x * math.sin(AFTER),
        ]

        first_step = FIRST_STEP.get(self.solver, OTHERS_FIRST_STEP)
        calls = 0

        def fall(_, y):
            nonlocal calls
            calls += 1
            return y[2], y[3], g, -y[1]

        def gap(_, y):
            return y[0] + y[1]

        gap.terminal = True
        gap.direction = 1
        try:
            flight = solve_ivp(
                fall,
                (AFTER, end),
                start,
                method=self.solver,
                rtol=self.rtol,
                atol=1e-3 * self.rtol,
                events=gap,
                first_step=min(first_step, 0.5 * end),
                max_step=self.max_step,
            )
        except ValueError:  # its event search can end in "f(a) and f(b) must have different signs"
            return math.nan, calls
        found = flight.t_events[0]
        return (float(found[0]) if found.size else math.nan), calls


def brentq_method(step, tolerance):
    """Scan with this step, brentq to this tolerance."""
    return ScanBrentq(
        step, tolerance, f"brentq {step:g}, {tolerance:.0e}", f"scan {step:g} + brentq"
    )


def ivp_method(solver, rtol, max_step=math.inf):
    """solve_ivp with this solver and tolerance (atol a thousandth of rtol)."""
    limit = "" if max_step == math.inf else f", steps <= {max_step:g}"
    return Ivp(solver, rtol, max_step, f"{solver}{limit}, {rtol:.0e}", f"{solver}{limit}")


SOLVERS = {
    "RK45": (1e-3, 1e-6, 1e-9),
    "DOP853": (1e-3, 1e-6, 1e-9, 1e-12),
    "LSODA": (1e-3, 1e-6, 1e-9, 1e-12),
    "Radau": (1e-3, 1e-6, 1e-9),
}
METHODS = (
    *(brentq_method(0.1, tolerance) for tolerance in (1e-3, 1e-6, 1e-9, 1e-12)),
    *(ivp_method(solver, rtol) for solver, rtols in SOLVERS.items() for rtol in rtols),
    *(ivp_method("DOP853", rtol, 0.1) for rtol in (1e-6, 1e-12)),
)
