"""A cell of a sweep without `sweep.verdict`: every orbit to its end, one after the other.

The benchmark compares its time with that of a cell of a sweep.
"""

import math

import numpy as np

from ...dynamics import fixed_point
from ...dynamics.tangent_orbits import angle
from ...kernel.arithmetic import log
from ...kernel.compiled import jit
from ...kernel.impact import impact_coefficients, step_with_flight, tangent
from ...sweep.cell import sunflower_points


@jit
def _follow(x, v, w, k, centre, expected, weight, growth, winding):
    coefficients = impact_coefficients(k)
    round_y = 1.0 / math.sqrt(k * (1.0 + k))
    impacts = weight.size
    quarter = impacts // 4
    for i in range(x.size):
        a, b, c = x[i], v[i], w[i]
        dx, dv, dw = 0.0, k * c, -b
        grown, early, late, turns = 0.0, 0.0, 0.0, 0.0
        p, q = a - centre, round_y * (b - k * c)
        for j in range(impacts):
            a, b, c, _, sine, cosine, tau_x, tau_s, tau_c, _ = step_with_flight(
                a, b, c, k, 1.0, coefficients, None
            )
            dx, dv, dw = tangent(
                dx, dv, dw, k, 1.0, coefficients, a, c, sine, cosine, tau_x, tau_s, tau_c
            )
            size = (abs(dx) + abs(dv)) + abs(dw)
            if not 1e-50 < size < 1e50:
                grown += log(size)
                dx, dv, dw = dx / size, dv / size, dw / size
                size = 1.0
            if quarter <= j < 2 * quarter:
                early += grown + log(size)
            elif j >= impacts - quarter:
                late += grown + log(size)
            r, s = a - centre, round_y * (b - k * c)
            turn = angle(p * r + q * s, q * r - p * s) / (2.0 * math.pi)
            if turn < expected - 0.5:
                turn += 1.0
            elif turn > expected + 0.5:
                turn -= 1.0
            turns += weight[j] * turn
            p, q = r, s
        growth[i] = (late - early) / quarter
        winding[i] = turns


def cell(k: float, e: float, starts: int, impacts: int) -> tuple[np.ndarray, np.ndarray]:
    """Return growth and winding number of each orbit of the cell."""
    centre, _, rotation = fixed_point.numbers(k, e)
    expected = 0.5 if math.isnan(rotation) else rotation
    time = (np.arange(impacts) + 0.5) / impacts
    weight = (time * (1.0 - time)) ** 3
    growth, winding = np.empty(starts), np.empty(starts)
    states = sunflower_points(k, e, starts)
    _follow(*states, k, centre, expected, weight / weight.sum(), growth, winding)
    return growth, winding
