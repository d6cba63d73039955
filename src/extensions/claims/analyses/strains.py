"""The strain in flight, u = c sin t - x cos t, between two impacts."""

import math

import numpy as np
import xarray as xr

from pseudorigid.dynamics.variables import rows, states_of
from pseudorigid.kernel.arithmetic import sincos
from pseudorigid.kernel.compiled import jit
from pseudorigid.kernel.formulas import impact_coefficients, rebound


@jit
def flight_strains(x: float, c: float, tau: float) -> tuple[float, float]:
    """Return the least and the largest strain of a flight of time tau.

    x is the position at its beginning, c the rate of strain just after the impact.
    """
    amplitude = math.sqrt(x * x + c * c)
    sine, cosine = sincos(tau)
    end = c * sine - x * cosine
    least, most = min(-x, end), max(-x, end)
    # in a part shorter than pi, u' changes sign at most once, at an extremum of u
    parts = int(tau / 3.0) + 1
    before = c
    for part in range(1, parts + 1):
        sine, cosine = sincos(tau * part / parts)
        after = c * cosine + x * sine
        if before > 0.0 > after:
            most = amplitude
        elif before < 0.0 < after:
            least = -amplitude
        before = after
    return least, most


def least_flight_strain(k: float, orbits: xr.Dataset) -> float:
    """Return the least strain in the flights between the impacts of a dataset's orbits."""
    (x, v, w), tau = states_of(orbits), orbits["tau"].values
    _, c, _ = rebound(v, w, k, impact_coefficients(k))
    least = [
        flight_strains(*flight)[0]
        for span in rows(orbits)
        for flight in zip(x[span][:-1], c[span][:-1], tau[span][1:], strict=True)
    ]
    return float(np.min(least))
