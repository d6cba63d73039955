"""Rival: heyoka's Taylor integrator with a terminal event. Its results are measurements."""

import math
from functools import cache

import heyoka as hy
import numpy as np

from .scipy_events import AFTER, launched

DIRECTIONS = {"any": hy.event_direction.any, "positive": hy.event_direction.positive}


@cache
def _integrator(g, tolerance, direction):
    """One compiled integrator, reused for every flight as its users would; the gap is the event."""
    x, u, v, w = hy.make_vars("x", "u", "v", "w")
    event = hy.t_event(x + u, direction=DIRECTIONS[direction])
    return hy.taylor_adaptive(
        [(x, v), (u, w), (v, hy.par[0]), (w, -u)],
        [0.0, 0.0, 0.0, 0.0],
        pars=[g],
        tol=tolerance,
        t_events=[event],
    )


class Taylor:
    """heyoka with a tolerance and a direction of the event."""

    def __init__(self, tolerance, direction):
        self.tolerance, self.direction = tolerance, direction
        self.name = f"heyoka {direction}, {tolerance:.0e}"
        self.family = f"heyoka, {direction} direction"

    def solve(self, ball, x, xdot, udot):
        """(tau, evaluations); NaN where the event is not seen.

        An evaluation here is one order of one Taylor step, the nearest to one of the right-hand
        side.
        """
        ta = _integrator(ball.g, self.tolerance, self.direction)
        tau, count = np.empty(x.size), np.empty(x.size, np.int64)
        for i, (position, v, w) in enumerate(
            zip(x.tolist(), xdot.tolist(), udot.tolist(), strict=True)
        ):
            b, c, end = launched(ball, position, v, w)
            ta.reset_cooldowns()
            ta.time = AFTER
            ta.state[:] = (
                position + AFTER * (b + 0.5 * ball.g * AFTER),
                c * math.sin(AFTER) - position * math.cos(AFTER),
                b + ball.g * AFTER,
                c * math.cos(AFTER) + position * math.sin(AFTER),
            )
            outcome, _, _, steps, _, _ = ta.propagate_until(end)
            hit = int(outcome) == -1  # terminal event number 0, which stops
            tau[i], count[i] = (ta.time if hit else math.nan), steps * ta.order
        return tau, count


METHODS = tuple(
    Taylor(tolerance, direction) for direction in DIRECTIONS for tolerance in (1e-6, 1e-9, 1e-15)
)
