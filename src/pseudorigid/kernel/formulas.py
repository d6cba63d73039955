"""Section, eq. (22), and impact law, eq. (25), for numbers and arrays; not compiled.

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


def impact_coefficients(k):
    """Return 2/(1 + k) as the sum of its first 26 bits and a double.

    With one rounded constant every impact would add the same relative error, 1e-16, to the energy.
    """
    total = 1.0 + k
    missing = k - (total - 1.0)
    ratio = 2.0 / total
    cut = 134217729.0 * ratio
    high = cut - (cut - ratio)
    cut = 134217729.0 * total
    upper = cut - (cut - total)
    rest = ((2.0 - high * upper) - high * (total - upper)) - high * missing
    return high, rest / total


def rebound(v, w, k, coefficients):
    """Return the velocities b = xdot and c = udot just after an impact, eq. (25), and s = v + w.

    v (R omega) and w (omega) are xdot and udot just before the impact, `coefficients` those from
    `impact_coefficients`; all may be arrays or sympy expressions. The impact reverses the contact
    speed s: b + c = -s without rounding.
    """
    high, low = coefficients
    s = v + w
    e = s * high + s * low
    return v - k * e, w - e, s
