"""The energy surface, a half ellipsoid, as an opaque body with an outline and a rim."""

import math

import numpy as np

_SIDES = 360  # of a quarter of a closed curve
# Intersections nearer than this part of the surface's size are rounding errors of the point itself.
_NEAR = 1e-5


class OccludingEllipsoid:
    """The states of one energy just before an impact, eq. (29) with xdot + udot >= 0.

    Twice the energy is xdot^2 + k udot^2 + k (x - g/k)^2 - g^2/k.
    """

    def __init__(self, k, g, energy):
        self.k, self.centre = float(k), float(g / k)
        self.radius = math.sqrt(2.0 * energy + g * g / k)

    def has(self, x, y, z):
        """Return whether points of the whole ellipsoid belong to the half."""
        return y + z >= 0.0

    def before(self, eye, x, y, z):
        """Return two points of the ellipsoid from each point towards the eye, NaN if behind it."""
        x = x - self.centre
        eye_x, eye_y, eye_z = eye
        square = self.k * eye_x * eye_x + eye_y * eye_y + self.k * eye_z * eye_z
        half = self.k * x * eye_x + y * eye_y + self.k * z * eye_z
        rest = self.k * x * x + y * y + self.k * z * z - self.radius * self.radius
        root = half * half - square * rest
        root = np.sqrt(np.where(root >= 0.0, root, np.nan))
        intersections = []
        for end in (-root, root):
            far = (end - half) / square
            far = np.where(far > _NEAR * self.radius, far, np.nan)
            intersections.append((self.centre + x + far * eye_x, y + far * eye_y, z + far * eye_z))
        return intersections

    def rim(self):
        """Return the closed curve (x, xdot, udot) on which the contact speed vanishes."""
        sine, cosine = _circle()
        along = self.radius * sine / math.sqrt(1.0 + self.k)
        return self.centre + self.radius / math.sqrt(self.k) * cosine, along, -along

    def outline(self, view):
        """Return the outline of the half in a projection, NaN where the other half has it."""
        sine, cosine = _circle()
        x, y, z = (a * cosine + b * sine for a, b in zip(view.right, view.up, strict=True))
        length = np.sqrt(x * x / self.k + y * y + z * z / self.k)
        far = self.radius / length
        x, y, z = x * far / self.k, y * far, z * far / self.k
        return np.where(self.has(x, y, z), self.centre + x, np.nan), y, z


def _circle():
    """Return sines and cosines of angles all around, from rational points of the circle."""
    t = np.arange(_SIDES) / _SIDES
    sine, cosine = 2.0 * t / (1.0 + t * t), (1.0 - t * t) / (1.0 + t * t)
    return (
        np.concatenate([sine, cosine, -sine, -cosine, [0.0]]),
        np.concatenate([cosine, -sine, -cosine, sine, [1.0]]),
    )
