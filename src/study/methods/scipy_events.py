"""Methods of scipy: a scan refined by brentq, and solve_ivp with a terminal event."""

import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from .external_solver import AFTER, ExternalSolver, just_after


class RisingGap:
    """The terminal event of solve_ivp where the gap rises through 0."""

    terminal, direction = True, 1

    def __call__(self, _: float, y: np.ndarray) -> float:
        """Return the gap of (x, u, xdot, udot)."""
        return float(y[0] + y[1])


def brentq_method(step: float, tolerance: float) -> ExternalSolver:
    """Return a scan that scipy.optimize.brentq refines to a tolerance."""

    def flight(x: float, b: float, c: float, g: float, latest: float) -> tuple[float, int]:
        def gap(t: float) -> float:
            return x + t * (b + 0.5 * g * t) - x * math.cos(t) + c * math.sin(t)

        count = 1
        while not gap(count * step) > 0.0:
            if count * step >= latest:
                return math.nan, count
            count += 1
        low, high = (count - 1) * step, count * step
        if count == 1:  # exclude the root at 0
            low = min(AFTER, 0.5 * high)
        if gap(low) >= 0.0:
            return low, count + 1
        root, report = brentq(gap, low, high, xtol=tolerance, rtol=1e-15, full_output=True)
        return root, count + report.function_calls

    return ExternalSolver(f"brentq {step:g}, {tolerance:.0e}", f"scan {step:g} + brentq", flight)


def ivp_method(solver: str, rtol: float, max_step: float = math.inf) -> ExternalSolver:
    """Return solve_ivp, atol = rtol/1000, with a terminal event where the gap rises through 0."""
    steps = {"method": solver, "rtol": rtol, "atol": 1e-3 * rtol, "max_step": max_step}
    rising = RisingGap()

    def flight(x: float, b: float, c: float, g: float, latest: float) -> tuple[float, int]:
        calls = 0

        def fall(_: float, y: np.ndarray) -> tuple[float, ...]:
            nonlocal calls
            calls += 1
            return y[2], y[3], g, -y[1]

        # LSODA may not see a flight that ends within its first step; a tiny one costs it nothing.
        first = min(1e-8 if solver == "LSODA" else 1e-2, 0.5 * latest)
        span, start = (AFTER, latest), just_after(x, b, c, g)
        try:
            solved = solve_ivp(fall, span, start, events=rising, first_step=first, **steps)
        except ValueError:  # its event search can end in "f(a) and f(b) must have different signs"
            return math.nan, calls
        times = solved.t_events[0]
        return (float(times[0]) if times.size else math.nan), calls

    family = solver if max_step == math.inf else f"{solver}, steps <= {max_step:g}"
    return ExternalSolver(f"{family}, {rtol:.0e}", family, flight)


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
