"""Rival for exponents: pynamicalsys, given this package's own map and Jacobian, compiled."""

import numba
import numpy as np
from pynamicalsys import DiscreteDynamicalSystem

from .. import impact as kernel


@numba.njit
def _mapping(u, parameters):
    """One impact, u = (x, xdot, udot), parameters = (k, g)."""
    k, g = parameters[0], parameters[1]
    head, low = kernel.transfer(k)
    x, v, w, _, _ = kernel.step(u[0], u[1], u[2], k, g, head, low)
    return np.array([x, v, w])


@numba.njit
def _jacobian(u, parameters, *_):
    """The analytic Jacobian, eq. (33)."""
    state = np.array([[u[0]], [u[1]], [u[2]]])
    out = np.empty((1, 3, 3))
    kernel.jacobians(state[0], state[1], state[2], parameters[0], parameters[1], 1, out)
    return out[0]


def spectrum(ball, state, impacts):
    """The three exponents of one orbit as pynamicalsys computes them, by QR."""
    system = DiscreteDynamicalSystem(
        mapping=_mapping, jacobian=_jacobian, system_dimension=3, number_of_parameters=2
    )
    return np.asarray(
        system.lyapunov(
            [float(a) for a in state], impacts, parameters=[ball.k, ball.g], method="QR"
        )
    )
