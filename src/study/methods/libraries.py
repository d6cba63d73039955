"""Methods of scipy, heyoka and pynamicalsys, which has Lyapunov exponents.

A flight begins just after the impact: event detection looks for a change of sign, and the gap is 0
at the impact itself. heyoka and pynamicalsys are imported when they are first used, since their
packages are installed for the study alone.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

import numba
import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from pseudorigid.dynamics.ball import Ball, State
from pseudorigid.kernel import impact as kernel
from pseudorigid.kernel.formulas import impact_coefficients, rebound

from . import Flights, Method

FirstRoot = Callable[[float, float, float, float, float], tuple[float, int]]
# Time after the impact at which a flight begins. Above x = -g a flight with xdot + udot below about
# 1e-10 may be shorter; its end is then wrong or missed.
AFTER = 1e-9
DIRECTIONS = "any", "positive"  # signs of the gap's slope at which heyoka's zeros are events


@dataclass
class ExternalSolver(Method):
    """A method of a library, applied to one flight at a time.

    `flight` takes (x, b, c, g, latest) and returns (tau, evaluations) of the flight from x with the
    velocities b = xdot and c = udot after the impact; tau is NaN if none is found. No root of the
    gap is later than `latest`.
    """

    flight: FirstRoot

    def solve(self, ball: Ball, x: np.ndarray, xdot: np.ndarray, udot: np.ndarray) -> Flights:
        """Return flight times and evaluations of states, arrays (n,)."""
        b, c, _ = rebound(xdot, udot, ball.k, impact_coefficients(ball.k))
        # `latest` is 0.1 after the last root of the parabola x + b t + g t^2/2 - sqrt(x^2 + c^2).
        # The gap is nowhere below it, and so positive from there on.
        latest = (np.sqrt(b * b - 2.0 * ball.g * (x - np.hypot(x, c))) - b) / ball.g + 0.1
        states = zip(*(a.tolist() for a in (x, b, c, latest)), strict=True)
        flights = [self.flight(x, b, c, ball.g, latest) for x, b, c, latest in states]
        tau, count = zip(*flights, strict=True)
        return np.array(tau, dtype=float), np.array(count, dtype=np.int64)


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
        span, start = (AFTER, latest), _just_after(x, b, c, g)
        try:
            solved = solve_ivp(fall, span, start, events=rising, first_step=first, **steps)
        except ValueError:  # its event search can end in "f(a) and f(b) must have different signs"
            return math.nan, calls
        times = solved.t_events[0]
        return (float(times[0]) if times.size else math.nan), calls

    family = solver if max_step == math.inf else f"{solver}, steps <= {max_step:g}"
    return ExternalSolver(f"{family}, {rtol:.0e}", family, flight)


def taylor_method(tolerance: float, direction: str) -> ExternalSolver:
    """Return heyoka's Taylor integrator with a terminal event at a zero of the gap.

    `direction` is one of DIRECTIONS. Each order of each Taylor step counts as one evaluation of
    the right-hand side.
    """

    def flight(x: float, b: float, c: float, g: float, latest: float) -> tuple[float, int]:
        integrator = _taylor_integrator(g, tolerance, direction)
        integrator.reset_cooldowns()
        integrator.time = AFTER
        integrator.state[:] = _just_after(x, b, c, g)
        outcome, _, _, steps, _, _ = integrator.propagate_until(latest)
        stopped_by_event = int(outcome) == -1  # the terminal event number 0
        return (integrator.time if stopped_by_event else math.nan), steps * integrator.order

    name, family = f"heyoka {direction}, {tolerance:.0e}", f"heyoka, {direction} direction"
    return ExternalSolver(name, family, flight)


@cache
def _taylor_integrator(g: float, tolerance: float, direction: str) -> Any:
    """Return a compiled integrator of (x, u, xdot, udot), to be reused for every flight."""
    import heyoka

    x, u, v, w = heyoka.make_vars("x", "u", "v", "w")
    event = heyoka.t_event(x + u, direction=getattr(heyoka.event_direction, direction))
    return heyoka.taylor_adaptive(
        [(x, v), (u, w), (v, heyoka.par[0]), (w, -u)],
        [0.0, 0.0, 0.0, 0.0],
        pars=[g],
        tol=tolerance,
        t_events=[event],
    )


def _just_after(x: float, b: float, c: float, g: float) -> tuple[float, float, float, float]:
    """Return (x, u, xdot, udot) of the flight at the time AFTER, eq. (26)."""
    sine, cosine = math.sin(AFTER), math.cos(AFTER)
    height, strain = x + AFTER * (b + 0.5 * g * AFTER), c * sine - x * cosine
    return height, strain, b + g * AFTER, c * cosine + x * sine


SOLVERS = {
    "RK45": (1e-3, 1e-6, 1e-9),
    "DOP853": (1e-3, 1e-6, 1e-9, 1e-12),
    "LSODA": (1e-3, 1e-6, 1e-9, 1e-12),
    "Radau": (1e-3, 1e-6, 1e-9),
}
METHODS: list[Method] = [
    *(brentq_method(0.1, tolerance) for tolerance in (1e-3, 1e-6, 1e-9, 1e-12)),
    *(ivp_method(solver, rtol) for solver, rtols in SOLVERS.items() for rtol in rtols),
    *(ivp_method("DOP853", rtol, 0.1) for rtol in (1e-6, 1e-12)),
    *(taylor_method(tol, direction) for direction in DIRECTIONS for tol in (1e-6, 1e-9, 1e-15)),
]


def lyapunov_exponents(ball: Ball, state: State, impacts: int) -> np.ndarray:
    """Return the exponents of one orbit, in nats an impact, by QR of pynamicalsys.

    pynamicalsys is given this package's compiled map and Jacobian.
    """
    from pynamicalsys import DiscreteDynamicalSystem

    system = DiscreteDynamicalSystem(
        mapping=_mapping, jacobian=_jacobian, system_dimension=3, number_of_parameters=2
    )
    parameters = [ball.k, ball.g]
    return np.asarray(system.lyapunov(list(state), impacts, parameters=parameters, method="QR"))


@numba.njit
def _mapping(u: np.ndarray, parameters: np.ndarray) -> np.ndarray:
    """Return the state after u = (x, xdot, udot); parameters = (k, g)."""
    k, g = parameters[0], parameters[1]
    coefficients = kernel.impact_coefficients(k)
    x, v, w, _, _, _ = kernel.step(u[0], u[1], u[2], k, g, coefficients, None)
    return np.array([x, v, w])


@numba.njit
def _jacobian(u: np.ndarray, parameters: np.ndarray, *_: float) -> np.ndarray:
    """Return the analytic Jacobian, eq. (33)."""
    k, g = parameters[0], parameters[1]
    coefficients = kernel.impact_coefficients(k)
    p, _, q, _, sine, cosine, tau_x, tau_s, tau_c, _ = kernel.step_with_flight(
        u[0], u[1], u[2], k, g, coefficients, None
    )
    out = np.empty((3, 3))
    for j in range(3):
        out[0, j], out[1, j], out[2, j] = kernel.tangent(
            1.0 if j == 0 else 0.0, 1.0 if j == 1 else 0.0, 1.0 if j == 2 else 0.0,
            k, g, coefficients, p, q, sine, cosine, tau_x, tau_s, tau_c,
        )  # fmt: skip
    return out
