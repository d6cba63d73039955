"""heyoka's Taylor integrator, with a terminal event where the gap x + u is zero."""

import math
from functools import cache

import heyoka as hy

from .external_solver import AFTER, ExternalSolver, just_after

# Signs of the gap's derivative at which a zero counts as an event.
DIRECTIONS = {"any": hy.event_direction.any, "positive": hy.event_direction.positive}


@cache
def _integrator(g: float, tolerance: float, direction: str) -> hy.taylor_adaptive:
    """Return a compiled integrator of (x, u, xdot, udot), to be reused for every flight."""
    x, u, v, w = hy.make_vars("x", "u", "v", "w")
    return hy.taylor_adaptive(
        [(x, v), (u, w), (v, hy.par[0]), (w, -u)],
        [0.0, 0.0, 0.0, 0.0],
        pars=[g],
        tol=tolerance,
        t_events=[hy.t_event(x + u, direction=DIRECTIONS[direction])],
    )


def taylor_method(tolerance: float, direction: str) -> ExternalSolver:
    """Return the method with a tolerance and a direction of the event, a key of DIRECTIONS.

    Each order of each Taylor step counts as one evaluation of the right-hand side.
    """

    def flight(x: float, b: float, c: float, g: float, latest: float) -> tuple[float, int]:
        ta = _integrator(g, tolerance, direction)
        ta.reset_cooldowns()
        ta.time = AFTER
        ta.state[:] = just_after(x, b, c, g)
        outcome, _, _, steps, _, _ = ta.propagate_until(latest)
        hit = int(outcome) == -1  # stopped by the terminal event number 0
        return (ta.time if hit else math.nan), steps * ta.order

    name, family = f"heyoka {direction}, {tolerance:.0e}", f"heyoka, {direction} direction"
    return ExternalSolver(name, family, flight)


METHODS = tuple(
    taylor_method(tolerance, direction)
    for direction in DIRECTIONS
    for tolerance in (1e-6, 1e-9, 1e-15)
)
