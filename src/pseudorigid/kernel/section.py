"""States of one energy on the section, eq. (22), from numbers or arrays.

In the chart (x, y = xdot - k udot) the section is the disk y^2/(1+k) + k (x - g/k)^2 <= 2E + g^2/k.
Energies are in m omega^2 R^2. Arguments are not checked: a state off the section is NaN.
"""

import numpy as np


def radius_squared(k, g, energy):
    """Return the square of the section's radius along y = 0."""
    return (2.0 * energy + g * g / k) / k


def start(k, g, energy, fraction):
    """Return the state (x, xdot, udot) on y = 0 at a fraction of the section's radius."""
    radius = np.sqrt(radius_squared(k, g, energy))
    # s^2 = (1 + k) (radius^2 - (x - centre)^2) in the chart; this form does not cancel at the rim.
    udot = radius * np.sqrt((1.0 - fraction) * (1.0 + fraction) / (1.0 + k))
    return g / k + fraction * radius, k * udot, udot


def contact_speed_squared(k, g, energy, x, y):
    """Return the square of s = xdot + udot, from 2E + 2 g x - k x^2 = (y^2 + k s^2)/(1 + k)."""
    return ((1.0 + k) * (2.0 * energy + 2.0 * g * x - k * x * x) - y * y) / k


def chart_state(k, g, energy, x, y):
    """Return the state (x, xdot, udot) at a point of the chart."""
    s = np.sqrt(contact_speed_squared(k, g, energy, x, y))
    return x, (y + k * s) / (1.0 + k), (s - y) / (1.0 + k)
