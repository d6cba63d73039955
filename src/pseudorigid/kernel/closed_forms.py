"""Closed formulas for any kind of number; to import them loads no compiler.

k is the Euler inertia, eq. (5), and g gravity. Lengths are in R, times in 1/omega and energies in m
omega^2 R^2. The section and the bounds of the energy are exact for Fractions.
"""

from collections.abc import Callable
from typing import Any


def energy(k: Any, g: Any, x: Any, xdot: Any, udot: Any) -> Any:
    """Return the total energy of a state just before an impact, eq. (29)."""
    return 0.5 * xdot * xdot + 0.5 * k * udot * udot - g * x + 0.5 * k * x * x


def twice_energy_above_rest(k: Any, g: Any, energy: Any) -> Any:
    """Return 2E + g^2/k, twice the energy above that of the ball at rest.

    The section is the disk y^2/(1+k) + k (x - g/k)^2 <= 2E + g^2/k in the chart (x, y = xdot - k
    udot).
    """
    return 2 * energy + g * g / k


def energy_bounds(k: Any, g: Any) -> tuple[Any, Any]:
    """Return the energy at rest on the floor, and the upper bound, eq. (31), that keeps u > -1."""
    return -g * g / (2 * k), k / 2 - g


def fixed_point(
    k: float, theta: float, sincos: Callable[[float], tuple[float, float]]
) -> tuple[float, float]:
    """Return E/g^2 and the trace of the symmetric fixed point with a flight of 2 theta < 2 pi.

    `dynamics.fixed_point` has these formulas, and numbers that follow from them, with the kernel's
    sine and cosine.
    """
    sine, cosine = sincos(theta)
    rest = 1 - theta * cosine / sine
    energy = ((1 + k) * theta * theta + rest * rest - 1) / (2 * k)
    sine, cosine = sincos(2 * theta)
    shear = rest * (2 * theta - sine) / (theta * (1 + k))
    return energy, 2 * (1 + k * (cosine - shear)) / (1 + k)
