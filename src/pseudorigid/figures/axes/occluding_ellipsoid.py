"""The energy surface, a half ellipsoid, as an opaque body: what it hides, its outline and rim."""

import math

import numpy as np

_SIDES = 360  # of a quarter of a closed curve
_NEAR = 1e-5  # of the surface's size: nearer in front, it is the point itself, but for rounding


class OccludingEllipsoid:
    """The states of one energy just before an impact, eq. (29) with xdot + udot >= 0.

    Twice the energy is xdot^2 + k udot^2 + k (x - g/k)^2 - g^2/k.

    Parameters
    ----------
    k, g, energy : float
    """

    def __init__(self, k, g, energy):
        self.k, self.centre = float(k), float(g / k)
        self.radius = math.sqrt(2.0 * energy + g * g / k)

    def has(self, x, y, z):
        """Whether points of the whole ellipsoid belong to the half."""
        return y + z >= 0.0

    def before(self, eye, x, y, z):
        """Where the rays from points to the eye meet the whole ellipsoid, two places each.

        Parameters
        ----------
        eye : tuple of float
            The direction to it.
        x, y, z : ndarray of shape (n,)

        Returns
        -------
        list of tuple of ndarray
            NaN where there is none in front of the point.
        """
        x = x - self.centre
        one, other, up = eye
        square = self.k * one * one + other * other + self.k * up * up
        half = self.k * x * one + y * other + self.k * z * up
        rest = self.k * x * x + y * y + self.k * z * z - self.radius * self.radius
        root = half * half - square * rest
        root = np.sqrt(np.where(root >= 0.0, root, np.nan))
        found = []
        for end in (-root, root):
            far = (end - half) / square
            far = np.where(far > _NEAR * self.radius, far, np.nan)
            found.append((self.centre + x + far * one, y + far * other, z + far * up))
        return found

    def rim(self):
        """Where the contact speed vanishes, as a closed curve (x, xdot, udot)."""
        sine, cosine = _circle()
        along = self.radius * sine / math.sqrt(1.0 + self.k)
        return self.centre + self.radius / math.sqrt(self.k) * cosine, along, -along

    def outline(self, view):
        """The outermost line of the half, NaN elsewhere, as a projection shows it."""
        sine, cosine = _circle()
        x, y, z = (a * cosine + b * sine for a, b in zip(view.right, view.up, strict=True))
        length = np.sqrt(x * x / self.k + y * y + z * z / self.k)
        far = self.radius / length
        x, y, z = x * far / self.k, y * far, z * far / self.k
        return np.where(self.has(x, y, z), self.centre + x, np.nan), y, z


def _circle():
    """Sines and cosines of angles all around, by the rational points of the circle."""
    t = np.arange(_SIDES) / _SIDES
    sine, cosine = 2.0 * t / (1.0 + t * t), (1.0 - t * t) / (1.0 + t * t)
    return (
        np.concatenate([sine, cosine, -sine, -cosine, [0.0]]),
        np.concatenate([cosine, -sine, -cosine, sine, [1.0]]),
    )
