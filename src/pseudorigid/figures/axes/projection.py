"""Orthographic projection of a box with equal data scales, in closed form.

Matplotlib's 3-D axes multiply matrices, whose last bit depends on the processor.
"""

from fractions import Fraction
from itertools import product

import numpy as np

_PI = Fraction(31415926535897932384626433832795028841971693993751, 10**49)


class Projection:
    """The map from points (x, y, z) of a box with limits (3, 2) to a sheet.

    `view` has elevation and azimuth of the eye in degrees, seen from the middle of the box.
    """

    def __init__(self, limits, view):
        self.limits = np.array(limits, dtype=float)
        sin_a, cos_a = sincos_degrees(view["azimuth"])
        sin_e, cos_e = sincos_degrees(view["elevation"])
        self.right = (-sin_a, cos_a, 0.0)
        self.up = (-sin_e * cos_a, -sin_e * sin_a, cos_e)
        self.eye = (cos_e * cos_a, cos_e * sin_a, sin_e)
        self.scale, self.shift = 1.0, (0.0, 0.0)

    def corners(self):
        """Return the eight corners of the box as an (8, 3) array, z fastest."""
        return np.array(list(product(*self.limits)))

    def place(self, left, bottom, width):
        """Scale and shift the box to a left end, a bottom and a width; return its height."""
        self.scale, self.shift = 1.0, (0.0, 0.0)
        across, up = self(*self.corners().T)
        self.scale = width / (across.max() - across.min())
        self.shift = left - self.scale * across.min(), bottom - self.scale * up.min()
        return self.scale * (up.max() - up.min())

    def __call__(self, x, y, z):
        """Return (across, up) on the sheet for coordinates of any shape, NaN where one is NaN."""
        across = x * self.right[0] + y * self.right[1] + z * self.right[2]
        up = x * self.up[0] + y * self.up[1] + z * self.up[2]
        return across * self.scale + self.shift[0], up * self.scale + self.shift[1]


def sincos_degrees(degrees):
    """Return (sin, cos) of an angle in degrees, correctly rounded, from exact series."""
    angle = Fraction(degrees) % 360 * _PI / 180
    sine, cosine, term, order = Fraction(0), Fraction(0), Fraction(1), 0
    while order < 60:
        cosine, sine = cosine + term, sine + term * angle / (order + 1)
        term *= -angle * angle / ((order + 1) * (order + 2))
        order += 2
    return float(sine), float(cosine)
