"""The three Lyapunov exponents of an orbit, eq. (32) with the factor 1/i it lacks.

Benettin's method: an orthonormal frame is carried along by the analytic Jacobian, eq. (33), in the
same loop as the orbit, and made orthonormal again at each impact (Benettin et al. 1980, reference
[18] of the paper).
"""

import math

import numpy as np
import xarray as xr

from ..kernel import impact as kernel
from ..kernel.arithmetic import log
from ..kernel.compiled import jit
from .ball import whole_number
from .starts import start_state, start_variables
from .variables import orbit_dims


def lyapunov_spectrum(ball, state, impacts, records=400):
    """Lyapunov exponents an impact, and how they converge.

    Args:
        ball: a Ball.
        state: (x, xdot, udot) just before an impact, scalars or arrays that broadcast.
        impacts: how many impacts, at least 1.
        records: after how many equal stretches the exponents so far are kept.

    Returns:
        Dataset of exponent, dims (impact, ..., index), largest first; its last entry the final
        value. `impact` holds the number of impacts. A state of one dimension has the dim `orbit`.
        NaN from a grazing impact on, where the map has no derivative.

    Raises:
        ValueError: a state with xdot + udot < 0, impacts < 1 or records < 1.
    """
    impacts = whole_number("impacts", impacts)
    records = min(whole_number("records", records), impacts)
    state = ball.on_section(*state)
    shape = state[0].shape
    dims = orbit_dims(shape)
    at = (np.arange(1, records + 1) * impacts) // records
    out = np.empty((records, state[0].size, 3))
    columns = (a.flatten() for a in state)
    missed = _spectrum(*columns, ball.k, ball.g, at, out, ball.map.how)
    ball.map.count(impacts * state[0].size, missed)
    exponent = (
        ("impact", *dims, "index"),
        out.reshape(records, *shape, 3),
        {"long_name": "Lyapunov exponent an impact", "units": "1"},
    )
    attributes = {"long_name": "number of impacts", "units": "1"}
    return xr.Dataset({"exponent": exponent}, coords={"impact": ("impact", at, attributes)})


def scene_exponents(ball, energy, starts, impacts, records):
    """`lyapunov_spectrum` of a scene.

    Parameters
    ----------
    ball : Ball
    energy : float
    starts : list
        Where its orbits start, each as in `starts.start_state`.
    impacts : int or list of int
        How many impacts of each; where they differ `exponent` is NaN at the records of others.
    records : int
        How many records of each orbit.
    """
    states = np.array([start_state(ball, energy, start) for start in starts])
    if isinstance(impacts, list) and len(set(impacts)) > 1:
        each = [
            lyapunov_spectrum(ball, state[:, None], count, records)
            for state, count in zip(states, impacts, strict=True)
        ]
        spectrum = xr.concat(each, "orbit", join="outer").transpose("impact", "orbit", "index")
    else:
        count = impacts[0] if isinstance(impacts, list) else impacts
        spectrum = lyapunov_spectrum(ball, tuple(states.T), count, records)
    return spectrum.assign(start_variables(starts, states))


@jit
def _unit(a, b, c):
    """A vector's length and its direction."""
    length = math.sqrt((a * a + b * b) + c * c)
    return length, a / length, b / length, c / length


@jit
def _orthonormal(a, b, c):
    """Gram-Schmidt in the order given: the three lengths and the frame, each vector a tuple."""
    p, a0, a1, a2 = _unit(*a)
    d = (a0 * b[0] + a1 * b[1]) + a2 * b[2]
    q, b0, b1, b2 = _unit(b[0] - d * a0, b[1] - d * a1, b[2] - d * a2)
    d = (a0 * c[0] + a1 * c[1]) + a2 * c[2]
    c0, c1, c2 = c[0] - d * a0, c[1] - d * a1, c[2] - d * a2
    d = (b0 * c0 + b1 * c1) + b2 * c2
    r, c0, c1, c2 = _unit(c0 - d * b0, c1 - d * b1, c2 - d * b2)
    return p, q, r, (a0, a1, a2), (b0, b1, b2), (c0, c1, c2)


@jit
def _spectrum(x, v, w, k, g, at, out, how):
    """Exponents of the states (n,) after each of `at` (m,) impacts: out (m, n, 3).

    `how` and what is returned, the impacts missed, are as in `impact`.
    """
    head, low = kernel.transfer(k)
    missed = 0
    for i in range(x.size):
        y0, y1, y2 = x[i], v[i], w[i]
        a, b, c = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
        # lengths are multiplied up, and the logarithm taken before they over- or underflow
        sum_a, sum_b, sum_c = 0.0, 0.0, 0.0
        done = 0
        for j in range(at.size):
            grown_a, grown_b, grown_c = 1.0, 1.0, 1.0
            while done < at[j]:
                y0, y1, y2, _, sine, cosine, tau_x, tau_s, tau_c, late = kernel.step_with_flight(
                    y0, y1, y2, k, g, head, low, how
                )
                missed += late
                a = kernel.tangent(*a, k, g, head, low, y0, y2, sine, cosine, tau_x, tau_s, tau_c)
                b = kernel.tangent(*b, k, g, head, low, y0, y2, sine, cosine, tau_x, tau_s, tau_c)
                c = kernel.tangent(*c, k, g, head, low, y0, y2, sine, cosine, tau_x, tau_s, tau_c)
                p, q, r, a, b, c = _orthonormal(a, b, c)
                grown_a *= p
                grown_b *= q
                grown_c *= r
                done += 1
                if not (
                    1e-100 < grown_a < 1e100
                    and 1e-100 < grown_b < 1e100
                    and 1e-100 < grown_c < 1e100
                ):
                    sum_a, sum_b, sum_c = (
                        sum_a + log(grown_a),
                        sum_b + log(grown_b),
                        sum_c + log(grown_c),
                    )
                    grown_a, grown_b, grown_c = 1.0, 1.0, 1.0
            sum_a, sum_b, sum_c = sum_a + log(grown_a), sum_b + log(grown_b), sum_c + log(grown_c)
            out[j, i, 0], out[j, i, 1], out[j, i, 2] = sum_a / done, sum_b / done, sum_c / done
    return missed
