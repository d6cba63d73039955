"""Methods of scipy, CyRK, heyoka and pynamicalsys, which has Lyapunov exponents.

Each is there as it is usually written, and with care. With care means:

- The gap z and its speed are variables of the system, z'' = g - u, u'' = -u, so that near grazing
  nothing cancels.
- A flight starts on the exact flight at a thousandth of its contact speed s (a time that is shorter
  than any first root), with an absolute tolerance in proportion to s.
- The first step ends before the first root.
- A second event, where the gap's speed falls through 0, shows touches that are shorter than a step.

As usually written, (x, u) and their speeds are integrated from 1e-9 after the impact, because event
detection looks for a change of sign, and the gap is 0 at the impact itself.

CyRK, heyoka and pynamicalsys are imported when they are first used, since their packages are
installed for the study alone.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any, NamedTuple

import numba
import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from pseudorigid.dynamics.ball import Ball, State
from pseudorigid.kernel import impact as kernel
from pseudorigid.kernel.arithmetic import quadrant
from pseudorigid.kernel.flight import amplitude_bound, first_step, gap
from pseudorigid.kernel.formulas import impact_coefficients, rebound

from . import Flights, Method

# Time after the impact at which a flight begins as usually written. Above x = -g a flight with
# xdot + udot below about 1e-10 may be shorter; its end is then wrong or missed.
AFTER = 1e-9
_START = 1e-3  # the same with care, in units of s: a flight lasts for 2 s/(g + A) or longer
_ATOL = 1e-3  # absolute tolerance over the relative one, in units of s with care
_NEAR = 4.0  # first bounds of the root up to which heyoka looks first


class Flight(NamedTuple):
    """A flight from x with the velocities b = xdot and c = udot after the impact, s = -(b + c)."""

    x: float
    b: float
    c: float
    s: float
    g: float
    latest: float  # no root of the gap is later

    def exactly(self) -> list[float]:
        """Return (z, z', u, w) at the time _START * s."""
        x, b, c, s, g, _ = self
        z, speed, _, p, q = gap(_START * s, x, b, c, s, g, quadrant(_START * s))
        return [z, speed, -p, q]

    def with_care(self, rtol: float, end: float) -> tuple[Any, np.ndarray, dict[str, Any]]:
        """Return span, start and options of an integration up to `end`."""
        begin = _START * self.s
        first = min(0.5 * self.bound(), 0.5 * (end - begin))
        atol = _ATOL * rtol * min(self.s, 1.0)
        options = {"rtol": rtol, "atol": atol, "first_step": first, "events": _EVENTS}
        return (begin, end), np.array(self.exactly()), options

    def bound(self) -> float:
        """Return a time at or before the first root."""
        amplitude = amplitude_bound(self.x, self.c)
        return float(first_step(self.x, self.c, self.s, self.g, amplitude))


@dataclass
class ExternalSolver(Method):
    """A method of a library, applied to one flight at a time.

    `flight` returns (tau, evaluations); tau is NaN if none is found.
    """

    flight: Callable[[Flight], tuple[float, int]]

    def solve(self, ball: Ball, x: np.ndarray, xdot: np.ndarray, udot: np.ndarray) -> Flights:
        """Return flight times and evaluations of states, arrays (n,)."""
        b, c, s = rebound(xdot, udot, ball.k, impact_coefficients(ball.k))
        # `latest` is 0.1 after the last root of the parabola x + b t + g t^2/2 - sqrt(x^2 + c^2).
        # The gap is nowhere below it, and so positive from there on.
        latest = (np.sqrt(b * b - 2.0 * ball.g * (x - np.hypot(x, c))) - b) / ball.g + 0.1
        states = zip(*(a.tolist() for a in (x, b, c, s, ball.g + 0.0 * x, latest)), strict=True)
        flights = [self.flight(Flight._make(state)) for state in states]
        tau, count = zip(*flights, strict=True)
        return np.array(tau, dtype=float), np.array(count, dtype=np.int64)


def ivp_method(solver: str, rtol: float) -> ExternalSolver:
    """Return solve_ivp, atol = rtol/1000, with a terminal event where the gap rises through 0."""
    tolerances = {"method": solver, "rtol": rtol, "atol": 1e-3 * rtol}
    rising = _event(lambda y: y[0] + y[1], True, 1)

    def flight(a: Flight) -> tuple[float, int]:
        calls = 0

        def fall(_: float, y: np.ndarray) -> tuple[float, ...]:
            nonlocal calls
            calls += 1
            return y[2], y[3], a.g, -y[1]

        # LSODA may not see a flight that ends within its first step; a tiny one costs it nothing.
        first = min(1e-8 if solver == "LSODA" else 1e-2, 0.5 * a.latest)
        span, start = (AFTER, a.latest), _just_after(a)
        try:
            solved = solve_ivp(fall, span, start, events=rising, first_step=first, **tolerances)
        except ValueError:  # its event search can end in "f(a) and f(b) must have different signs"
            return math.nan, calls
        times = solved.t_events[0]
        return (float(times[0]) if times.size else math.nan), calls

    return ExternalSolver(f"{solver}, {rtol:.0e}", solver, flight)


def taylor_method(tolerance: float) -> ExternalSolver:
    """Return heyoka's Taylor integrator with a terminal event at a zero of the gap.

    Each order of each Taylor step counts as one evaluation of the right-hand side.
    """

    def flight(a: Flight) -> tuple[float, int]:
        integrator = _taylor_integrator(a.g, tolerance)
        integrator.reset_cooldowns()
        integrator.time = AFTER
        integrator.state[:] = _just_after(a)
        outcome, _, _, steps, _, _ = integrator.propagate_until(a.latest)
        stopped_by_event = int(outcome) == -1  # the terminal event number 0
        return (integrator.time if stopped_by_event else math.nan), steps * integrator.order

    return ExternalSolver(f"heyoka, {tolerance:.0e}", "heyoka", flight)


@cache
def _taylor_integrator(g: float, tolerance: float) -> Any:
    """Return a compiled integrator of (x, u, xdot, udot), to be reused for every flight."""
    import heyoka

    x, u, v, w = heyoka.make_vars("x", "u", "v", "w")
    return heyoka.taylor_adaptive(
        [(x, v), (u, w), (v, heyoka.par[0]), (w, -u)],
        [0.0, 0.0, 0.0, 0.0],
        pars=[g],
        tol=tolerance,
        t_events=[heyoka.t_event(x + u)],
    )


def careful_ivp_method(solver: str, rtol: float) -> ExternalSolver:
    """Return solve_ivp with care."""

    def integrate(a: Flight, end: float, dense: bool) -> tuple[Any, int]:
        calls = 0

        def fall(_: float, y: np.ndarray) -> tuple[float, ...]:
            nonlocal calls
            calls += 1
            return y[1], a.g - y[2], y[3], -y[2]

        span, start, options = a.with_care(rtol, end)
        if solver == "LSODA":  # it chooses one that suits its order, which starts at one
            options["first_step"] = None
        solved = solve_ivp(fall, span, start, method=solver, dense_output=dense, **options)
        return (solved.sol if dense else (solved.t_events, solved.y_events[1])), calls

    name = f"{solver} with care"
    return ExternalSolver(f"{name}, {rtol:.0e}", name, _with_touches(integrate))


def careful_cyrk_method(solver: str, rtol: float) -> ExternalSolver:
    """Return CyRK's compiled integrator with care, with the system and its events compiled."""

    def integrate(a: Flight, end: float, dense: bool) -> tuple[Any, int]:
        from CyRK import pysolve_ivp

        calls = np.zeros(1, np.int64)
        span, start, options = a.with_care(rtol, end)
        options |= {"method": solver, "args": (a.g, calls), "pass_dy_as_arg": True}
        solved = pysolve_ivp(_fall, span, start, dense_output=dense, **options)
        if dense:
            return (lambda t: solved(t)[:, 0]), int(calls[0])
        tops = solved.y_events[1]
        return (solved.t_events, tops.T if tops.ndim == 2 else tops), int(calls[0])

    name = f"CyRK {solver} with care"
    return ExternalSolver(f"{name}, {rtol:.0e}", name, _with_touches(integrate))


def careful_taylor_method(tolerance: float) -> ExternalSolver:
    """Return heyoka with care: it finds all zeros in a step, so that it needs no second event.

    A root at a tiny part of a step is beyond its root finder, so that a first call ends shortly
    after the bound of the first root.
    """

    def flight(a: Flight) -> tuple[float, int]:
        integrator = _careful_integrator(a.g, tolerance)
        integrator.reset_cooldowns()
        integrator.time, integrator.state[:] = _START * a.s, a.exactly()
        near, steps = _NEAR * a.bound(), 0
        for end in (near, a.latest) if near < 0.1 else (a.latest,):
            outcome, _, _, more, _, _ = integrator.propagate_until(end)
            steps += more
            if int(outcome) == -1:
                return integrator.time, steps * integrator.order
        return math.nan, steps * integrator.order

    return ExternalSolver(f"heyoka with care, {tolerance:.0e}", "heyoka with care", flight)


def taylor_orbit(ball: Ball, state: State, impacts: int) -> np.ndarray:
    """Return an orbit (4, impacts) of x, xdot, udot and tau in heyoka's own idiom.

    One call follows the whole orbit; the callback of a terminal event applies the impact law.
    """
    k, g = ball.k, ball.g
    of_xdot, of_udot = 2.0 / (1.0 + k), (1.0 - k) / (1.0 + k)
    track: list[tuple[float, ...]] = []
    last = 0.0

    def bounce(integrator: Any, _: int) -> bool:
        """Apply the impact law, eq. (25). Plain numbers: each call costs as much as a flight."""
        nonlocal last
        _, speed, u, udot = values.tolist()
        xdot, now = speed - udot, integrator.time
        track.append((-u, xdot, udot, now - last))
        last = now
        values[0], values[1], values[3] = 0.0, -speed, -of_xdot * xdot - of_udot * udot
        return len(track) < impacts

    integrator = _gap_integrator(g, 1e-15, bounce)
    values = integrator.state  # of the integrator itself, no copy
    x, xdot, udot = map(float, state)
    _, c, s = rebound(xdot, udot, k, impact_coefficients(k))
    values[:] = Flight(x, -s - c, c, s, g, math.inf).exactly()
    integrator.time = _START * s
    integrator.propagate_until(1e3 * impacts)
    return np.array(track).T


def _with_touches(
    integrate: Callable[[Flight, float, bool], tuple[Any, int]],
) -> Callable[[Flight], tuple[float, int]]:
    """Return the search for a root where z rises, or before a maximum at which z > 0.

    `integrate` to a time returns the times of both events and the states (n, 4) of the second one,
    or dense output, and its evaluations.
    """

    def flight(a: Flight) -> tuple[float, int]:
        try:
            ((ends, tops), states), calls = integrate(a, a.latest, False)
            end, low = ends[0] if len(ends) else math.nan, _START * a.s
            for top, y in zip(tops, states, strict=True):
                if y[0] > 0.0 and not top > end:
                    dense, more = integrate(a, top, True)
                    return _root(dense, low, top), calls + more
                low = top
        except ValueError:  # of their event search: "f(a) and f(b) must have different signs"
            return math.nan, 0
        return float(end), calls

    return flight


def _root(dense: Callable[[float], np.ndarray], low: float, high: float) -> float:
    """Return the root of z in dense output."""
    return float(brentq(lambda t: dense(t)[0], low, high, xtol=1e-15 * high, rtol=1e-15))


def _event(value: Callable[[np.ndarray], float], terminal: bool, direction: int) -> Any:
    """Return the compiled event of solve_ivp and CyRK where a function of the state crosses 0."""
    of_state = numba.njit(value)
    compiled = numba.njit(lambda _, y, *__: of_state(y))
    compiled.terminal, compiled.direction = terminal, direction
    return compiled


# The gap rises, and its speed falls.
_EVENTS = [_event(lambda y: y[0], True, 1), _event(lambda y: y[1], False, -1)]


@numba.njit
def _fall(dy: np.ndarray, _: float, y: np.ndarray, g: float, calls: np.ndarray) -> None:
    """Write the derivative of (z, z', u, w), and count the call."""
    dy[0], dy[1], dy[2], dy[3] = y[1], g - y[2], y[3], -y[2]
    calls[0] += 1


@cache
def _careful_integrator(g: float, tolerance: float) -> Any:
    return _gap_integrator(g, tolerance)


def _gap_integrator(g: float, tolerance: float, callback: Callable[..., bool] | None = None) -> Any:
    """Return heyoka's integrator of (z, z', u, w) with a terminal event where z rises."""
    import heyoka

    z, speed, u, w = heyoka.make_vars("z", "speed", "u", "w")
    rising = {"direction": heyoka.event_direction.positive}
    event = heyoka.t_event(z, **rising, **({"callback": callback} if callback else {}))
    return heyoka.taylor_adaptive(
        [(z, speed), (speed, heyoka.par[0] - u), (u, w), (w, -u)],
        [0.0, 0.0, 0.0, 0.0],
        pars=[g],
        tol=tolerance,
        t_events=[event],
    )


def _just_after(a: Flight) -> np.ndarray:
    """Return (x, u, xdot, udot) of the flight at the time AFTER, eq. (26)."""
    sine, cosine = math.sin(AFTER), math.cos(AFTER)
    height, strain = a.x + AFTER * (a.b + 0.5 * a.g * AFTER), a.c * sine - a.x * cosine
    return np.array([height, strain, a.b + a.g * AFTER, a.c * cosine + a.x * sine])


SOLVERS = {
    "RK45": (1e-3, 1e-6, 1e-9),
    "DOP853": (1e-3, 1e-6, 1e-9, 1e-12),
    "LSODA": (1e-3, 1e-6, 1e-9, 1e-12),
}
USUAL: list[Method] = [
    *(ivp_method(solver, rtol) for solver, rtols in SOLVERS.items() for rtol in rtols),
    *(taylor_method(tolerance) for tolerance in (1e-6, 1e-9, 1e-15)),
]
CAREFUL: list[Method] = [
    *(careful_ivp_method(solver, rtol) for solver, rtols in SOLVERS.items() for rtol in rtols),
    *(careful_cyrk_method("DOP853", rtol) for rtol in (1e-6, 1e-9, 1e-12)),
    *(careful_taylor_method(tolerance) for tolerance in (1e-6, 1e-9, 1e-15)),
]
METHODS = [*USUAL, *CAREFUL]


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
    out = np.empty((1, 3, 3))
    kernel.jacobians(u[0:1], u[1:2], u[2:3], parameters[0], parameters[1], 1, out, None)
    return out[0]
