"""Lyapunov exponents by pynamicalsys, given this package's compiled map and Jacobian."""

import numba
import numpy as np
from pynamicalsys import DiscreteDynamicalSystem

from pseudorigid.dynamics.ball import Ball, State
from pseudorigid.kernel import impact as kernel


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


def spectrum(ball: Ball, state: State, impacts: int) -> np.ndarray:
    """Return the three Lyapunov exponents of one orbit, in nats an impact, by QR."""
    system = DiscreteDynamicalSystem(
        mapping=_mapping, jacobian=_jacobian, system_dimension=3, number_of_parameters=2
    )
    parameters = [ball.k, ball.g]
    return np.asarray(system.lyapunov(list(state), impacts, parameters=parameters, method="QR"))
