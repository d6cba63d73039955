"""Methods in pseudorigid's arithmetic that count their evaluations of the gap.

Their results have the same bytes on every machine.
"""

import math
from dataclasses import dataclass

import numpy as np

from pseudorigid.dynamics.ball import Ball, State
from pseudorigid.kernel.arithmetic import sincos
from pseudorigid.kernel.compiled import jit
from pseudorigid.kernel.formulas import impact_coefficients
from pseudorigid.kernel.impact import MOST_SCAN_STEPS, rebound, scan
from pseudorigid.kernel.impact import step as certified_step

from . import Flights, Method, inflections, rotations
from .careful_scan import BEST, CUBIC, LANDING, PARABOLA, careful_scan

# Kinds of method: the certified march; the paper's, steps of constant length until the gap changes
# sign and then bisection; steps of a physics engine; a tuned scan; inflections; and rotations.
MARCH, SCAN, ENGINE, CAREFUL, PIECES, TURNS = 0, 1, 2, 3, 4, 5
Settings = tuple[int, float, float]  # kind, step, and tolerance (time units) or care
Parameters = tuple[float, float, tuple[float, float]]  # k, g and the impact's coefficients
NextImpact = tuple[float, float, float, float, int, int, int]  # tau, x, xdot, udot, COUNTS
COUNTS = "sines", "rotations", "inverses"  # sines with their cosines, and inverse functions


@jit
def _engine(x: float, b: float, c: float, g: float, step: float) -> NextImpact:
    """Take semi-implicit Euler steps from x with velocities b, c until the ball is in the floor.

    The time of flight is NaN after MOST_SCAN_STEPS steps.
    """
    position, strain, v, w = x, -x, b, c
    count = 0
    while True:
        count += 1
        v += step * g
        w -= step * strain
        position += step * v
        strain += step * w
        if position + strain >= 0.0 and v + w >= 0.0:
            return count * step, position, v, w, count, 0, 0
        if count >= MOST_SCAN_STEPS:
            return math.nan, position, v, w, count, 0, 0


@jit
def _next_impact(settings: Settings, ball: Parameters, x: float, v: float, w: float) -> NextImpact:
    """Return the next impact of a state just before an impact."""
    kind, step, tolerance = settings
    k, g, coefficients = ball
    if kind == MARCH:
        x, v, w, tau, count, _ = certified_step(x, v, w, k, g, coefficients, None)
        return tau, x, v, w, count, 0, 0
    b, c, s = rebound(v, w, k, coefficients)
    if kind == ENGINE:
        return _engine(x, b, c, g, step)
    turns, angles = 0, 0
    if kind == PIECES:
        tau, p, q, count, angles = inflections.first_impact(x, b, c, s, g, tolerance)
    elif kind == TURNS:
        tau, p, q, count, turns = rotations.first_impact(x, b, c, s, g, tolerance)
    elif kind == CAREFUL:
        tau, p, q, count = careful_scan(x, b, c, s, g, step, tolerance)
    else:
        tau, count = scan(x, b, c, g, step, tolerance)
        sine, cosine = sincos(tau)
        return tau, x * cosine - c * sine, b + g * tau, x * sine + c * cosine, 1 + count, 0, 0
    v = b + g * tau
    return tau, p, v, max(q, -v), count, turns, angles


@jit
def _flights(
    settings: Settings, ball: Parameters, states: np.ndarray, out: np.ndarray, count: np.ndarray
) -> None:
    """Write x, xdot, udot and tau after a flight from each state (3, n), and its COUNTS (3, n).

    The states are read one after the other, and may be those that are written.
    """
    for i in range(out.shape[1]):
        x, v, w = states[0, i], states[1, i], states[2, i]
        tau, x, v, w, count[0, i], count[1, i], count[2, i] = _next_impact(settings, ball, x, v, w)
        out[0, i], out[1, i], out[2, i], out[3, i] = x, v, w, tau


@dataclass(frozen=True)
class CountedMethod(Method):
    """A method of one of the kinds above."""

    settings: Settings

    def solve(self, ball: Ball, x: np.ndarray, xdot: np.ndarray, udot: np.ndarray) -> Flights:
        """Return flight times of states, and evaluations: all of COUNTS but rotations."""
        tau, (sines, _, inverses) = self.counted(ball, x, xdot, udot)
        return tau, sines + inverses

    def counted(self, ball: Ball, x: np.ndarray, xdot: np.ndarray, udot: np.ndarray) -> Flights:
        """Return flight times of states, arrays (n,), and COUNTS (3, n)."""
        out = np.empty((4, x.size))
        return out[3], self._fly(ball, np.array([x, xdot, udot]), out)

    def orbit(self, ball: Ball, state: State, impacts: int) -> tuple[np.ndarray, int]:
        """Return the method's own orbit from `state`, and the evaluations of all flights.

        The rows of the orbit (4, impacts) are x, xdot, udot just before each impact after the
        start, and the time tau of the flight that ends there.
        """
        track = np.empty((4, 1 + impacts))
        track[:3, 0] = state
        sines, _, inverses = self._fly(ball, track[:3, :-1], track[:, 1:]).sum(axis=1)
        return track[:, 1:], int(sines + inverses)

    def _fly(self, ball: Ball, states: np.ndarray, out: np.ndarray) -> np.ndarray:
        """Write a flight from each state, and return their COUNTS."""
        count = np.empty((3, out.shape[1]), np.int64)
        _flights(self.settings, (ball.k, ball.g, impact_coefficients(ball.k)), states, out, count)
        return count


OURS = CountedMethod("certified march", "certified march", (MARCH, 0.0, 0.0))
INFLECTIONS = CountedMethod("inflections", "inflections", (PIECES, 0.0, inflections.BEST))
_SIMPLE = "inflections (simple)"
SIMPLE_INFLECTIONS = CountedMethod(_SIMPLE, _SIMPLE, (PIECES, 0.0, inflections.SIMPLE))
ROTATED_SCAN = CountedMethod("scan by rotation", "scan by rotation", (TURNS, 0.0, rotations.SCAN))
ROTATED_MARCH = CountedMethod("march by table", "march by table", (TURNS, 0.0, rotations.MARCH))


def scan_method(step: float, tolerance: float) -> CountedMethod:
    """Return the paper's method with a step and a tolerance."""
    name, family = f"scan {step:g}, {tolerance:.0e}", f"scan {step:g} + bisection"
    return CountedMethod(name, family, (SCAN, step, tolerance))


def careful_method(step: float, care: float = CUBIC) -> CountedMethod:
    """Return a tuned scan, with a step and what it takes from the march."""
    form = {PARABOLA: " (simple)", CUBIC: "", LANDING: " (landing)", BEST: " (best)"}[care]
    name, family = f"careful scan {step:g}{form}", f"careful scan{form}"
    return CountedMethod(name, family, (CAREFUL, step, care))


def engine_method(step: float) -> CountedMethod:
    """Return a physics engine with a time step."""
    return CountedMethod(f"engine {step:.0e}", "time stepping", (ENGINE, step, 0.0))


TOLERANCES = (1e-3, 1e-6, 1e-9, 1e-12)
SCANS = tuple(scan_method(step, tol) for step in (0.5, 0.1, 0.01) for tol in TOLERANCES)
ENGINES = tuple(engine_method(step) for step in (1e-1, 1e-2, 1e-3, 1e-4))
CAREFUL_SCANS = tuple(
    careful_method(step, care) for care in (CUBIC, PARABOLA) for step in (1.0, 0.5, 0.25)
)
BEST_SCAN = careful_method(1.0, BEST)
BEST_METHODS = OURS, INFLECTIONS, ROTATED_SCAN, ROTATED_MARCH, BEST_SCAN
_OTHERS = SIMPLE_INFLECTIONS, careful_method(1.0, LANDING)
METHODS = *BEST_METHODS, *_OTHERS, *CAREFUL_SCANS, *SCANS, *ENGINES[:3]
