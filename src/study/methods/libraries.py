"""Methods of scipy, CyRK, heyoka and pynamicalsys, which has Lyapunov exponents.

Each is there as commonly written, and tuned (src/study/README.md).
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

# Start of a flight after the impact, as commonly written: the gap is 0 at the impact, and
# events are changes of sign. Above x = -g a flight with xdot + udot below about 1e-10 may be
# shorter; its end is then wrong or missed.
AFTER = 1e-9
_START = 1e-3  # the same, tuned, in units of s: a flight lasts for 2 s/(g + A) or longer
_ATOL = 1e-3  # absolute tolerance over the relative one, in units of s, tuned
_NEAR = 4.0  # first bounds of the root up to which heyoka looks first
_CHOOSES_FIRST_STEP = ("LSODA",)  # its own fits its order, which starts at one


class Flight(NamedTuple):
    """A flight from x with the velocities b = xdot and c = udot after the impact, s = -(b + c)."""

    x: float
    b: float
    c: float
    s: float
    g: float
    latest: float  # no root of the gap is later

    def start(self, tuned: bool) -> tuple[float, np.ndarray]:
        """Return a time shortly after the impact, and (z, z', u, u') or (x, x', u, u') then."""
        x, b, c, s, g, _ = self
        if tuned:
            z, speed, _, p, q = gap(_START * s, x, b, c, s, g, quadrant(_START * s))
            return _START * s, np.array([z, speed, -p, q])
        sine, cosine = math.sin(AFTER), math.cos(AFTER)  # eq. (26)
        height, strain = x + AFTER * (b + 0.5 * g * AFTER), c * sine - x * cosine
        return AFTER, np.array([height, b + g * AFTER, strain, c * cosine + x * sine])

    def integration(
        self, solver: str, rtol: float, end: float, tuned: bool
    ) -> tuple[Any, np.ndarray, dict[str, Any]]:
        """Return span, start and options of an integration up to `end`."""
        begin, start = self.start(tuned)
        options = {"method": solver, "rtol": rtol, "atol": _ATOL * rtol, "events": [_RISING]}
        if tuned:
            options |= {"atol": _ATOL * rtol * min(self.s, 1.0), "events": _WITH_TOUCHES}
            if solver not in _CHOOSES_FIRST_STEP:
                options["first_step"] = min(0.5 * self.bound(), 0.5 * (end - begin))
        else:  # LSODA may not see a flight that ends within its first step; a tiny one costs little
            options["first_step"] = min(1e-8 if solver == "LSODA" else 1e-2, 0.5 * end)
        return (begin, end), start, options

    def bound(self) -> float:
        """Return a time at or before the first root."""
        amplitude = amplitude_bound(self.x, self.c)
        return float(first_step(self.x, self.c, self.s, self.g, amplitude))


# An integration to a time, which adds its evaluations to a list of one number. It returns dense
# output if that is asked for, or else the times of both events and the states (n, 4) of the second.
Integrate = Callable[[Flight, float, bool, list[int]], Any]


@dataclass(frozen=True)
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


def ivp_method(solver: str, rtol: float, tuned: bool = True) -> ExternalSolver:
    """Return solve_ivp, tuned or with one terminal event where the gap rises through 0."""

    def integrate(a: Flight, end: float, dense: bool, calls: list[int]) -> Any:
        def fall(_: float, y: np.ndarray) -> tuple[float, ...]:
            calls[0] += 1
            return y[1], a.g - y[2] if tuned else a.g, y[3], -y[2]

        span, start, options = a.integration(solver, rtol, end, tuned)
        solved = solve_ivp(fall, span, start, dense_output=dense, **options)
        return solved.sol if dense else (*solved.t_events, *solved.y_events[1:])

    return _method(solver, rtol, tuned, _first_root(integrate))


def cyrk_method(solver: str, rtol: float) -> ExternalSolver:
    """Return CyRK's compiled integrator, tuned, with the system and its events compiled."""

    def integrate(a: Flight, end: float, dense: bool, calls: list[int]) -> Any:
        from CyRK import pysolve_ivp

        count = np.zeros(1, np.int64)
        span, start, options = a.integration(solver, rtol, end, True)
        options |= {"args": (a.g, count), "pass_dy_as_arg": True}
        solved = pysolve_ivp(_fall, span, start, dense_output=dense, **options)
        calls[0] += int(count[0])
        if dense:
            return lambda t: solved(t)[:, 0]
        tops = solved.y_events[1]
        return *solved.t_events, tops.T if tops.ndim == 2 else tops

    return _method(f"CyRK {solver}", rtol, True, _first_root(integrate))


def taylor_method(tolerance: float, tuned: bool = True) -> ExternalSolver:
    """Return heyoka's Taylor integrator, tuned or with a terminal event at a zero of the gap.

    It finds all zeros in a step, so that it needs no second event. Tuned, a first call ends
    shortly after the bound of the first root, since a root at a tiny part of a step is beyond its
    root finder. Each order of each Taylor step counts as one evaluation of the right-hand side.
    """

    def flight(a: Flight) -> tuple[float, int]:
        integrator = _kept_integrator(a.g, tolerance, tuned)
        integrator.reset_cooldowns()
        integrator.time, integrator.state[:] = a.start(tuned)
        near, steps = _NEAR * a.bound(), 0
        for end in (near, a.latest) if tuned and near < 0.1 else (a.latest,):
            outcome, _, _, more, _, _ = integrator.propagate_until(end)
            steps += more
            if int(outcome) == -1:  # the terminal event number 0
                return integrator.time, steps * integrator.order
        return math.nan, steps * integrator.order

    return _method("heyoka", tolerance, tuned, flight)


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

    integrator = _integrator(g, 1e-15, True, bounce)
    values = integrator.state  # of the integrator itself, no copy
    x, xdot, udot = map(float, state)
    _, c, s = rebound(xdot, udot, k, impact_coefficients(k))
    integrator.time, values[:] = Flight(x, -s - c, c, s, g, math.inf).start(True)
    integrator.propagate_until(1e3 * impacts)
    return np.array(track).T


def _method(
    library: str, setting: float, tuned: bool, flight: Callable[[Flight], tuple[float, int]]
) -> ExternalSolver:
    """Return a method, named by its library, its setting and whether it is tuned."""
    family = f"tuned {library}" if tuned else library
    return ExternalSolver(f"{family}, {setting:.0e}", family, flight)


def _first_root(integrate: Integrate) -> Callable[[Flight], tuple[float, int]]:
    """Return the search for a root where the gap rises, or before a maximum at which z > 0."""

    def flight(a: Flight) -> tuple[float, int]:
        calls = [0]
        try:
            ends, *touches = integrate(a, a.latest, False, calls)
            end, low = ends[0] if len(ends) else math.nan, _START * a.s
            for top, y in zip(*touches, strict=True):
                if y[0] > 0.0 and not top > end:
                    return _root(integrate(a, top, True, calls), low, top), calls[0]
                low = top
        except ValueError:  # of their event search: "f(a) and f(b) must have different signs"
            return math.nan, calls[0]
        return float(end), calls[0]

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


_RISING = _event(lambda y: y[0] + y[2], True, 1)
# Tuned: the gap rises, and its speed falls.
_WITH_TOUCHES = [_event(lambda y: y[0], True, 1), _event(lambda y: y[1], False, -1)]


@numba.njit
def _fall(dy: np.ndarray, _: float, y: np.ndarray, g: float, count: np.ndarray) -> None:
    """Write the derivative of (z, z', u, u'), and count the call."""
    dy[0], dy[1], dy[2], dy[3] = y[1], g - y[2], y[3], -y[2]
    count[0] += 1


def _integrator(
    g: float, tolerance: float, tuned: bool, callback: Callable[..., bool] | None = None
) -> Any:
    """Return heyoka's integrator with a terminal event where the gap rises or, usually, is 0."""
    import heyoka

    height, speed, u, w = heyoka.make_vars("height", "speed", "u", "w")
    weight, event = heyoka.par[0], heyoka.t_event(height + u)
    if tuned:
        options = {"direction": heyoka.event_direction.positive}
        options |= {"callback": callback} if callback else {}
        weight, event = weight - u, heyoka.t_event(height, **options)
    system = [(height, speed), (speed, weight), (u, w), (w, -u)]
    return heyoka.taylor_adaptive(system, [0.0] * 4, pars=[g], tol=tolerance, t_events=[event])


_kept_integrator = cache(_integrator)  # to be reused for every flight

RTOLS = {
    "RK45": (1e-3, 1e-6, 1e-9),
    "DOP853": (1e-3, 1e-6, 1e-9, 1e-12),
    "LSODA": (1e-3, 1e-6, 1e-9, 1e-12),
}
USUAL, TUNED = (
    [
        *(ivp_method(solver, rtol, tuned) for solver in RTOLS for rtol in RTOLS[solver]),
        *(cyrk_method("DOP853", rtol) for rtol in (1e-6, 1e-9, 1e-12) if tuned),
        *(taylor_method(tolerance, tuned) for tolerance in (1e-6, 1e-9, 1e-15)),
    ]
    for tuned in (False, True)
)
METHODS: list[Method] = [*USUAL, *TUNED]


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
