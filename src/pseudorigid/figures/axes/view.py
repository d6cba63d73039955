"""View of a box: its projection to a sheet, and the energy surface that hides what is behind it."""

import math
from itertools import product

import numpy as np
from numpy.typing import ArrayLike

from ...kernel.closed_forms import twice_energy_above_rest
from .direction import directions

_SIDES = 360  # of a quarter of a closed curve
# Intersections nearer than this part of the surface's size are rounding errors of the point itself.
_NEAR = 1e-5


class Projection:
    """Orthographic projection of a box, with limits (3, 2) and equal data scales, to a sheet.

    `view` has elevation and azimuth of the eye in degrees, seen from the middle of the box.
    """

    def __init__(self, limits: list[list[float]], view: dict[str, float]) -> None:
        self.corners = np.array([*product(*limits)], dtype=float).T
        self.right, self.up, self.eye = directions(**view)
        self.scale, self.shift = 1.0, (0.0, 0.0)

    def place(self, left: float, bottom: float, width: float) -> float:
        """Scale and shift the box to a left end, a bottom and a width; return its height."""
        self.scale, self.shift = 1.0, (0.0, 0.0)
        across, up = self(self.corners)
        self.scale = float(width / (across.max() - across.min()))
        self.shift = left - self.scale * across.min(), bottom - self.scale * up.min()
        return float(self.scale * (up.max() - up.min()))

    def __call__(self, points: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
        """Return (across, up) on the sheet for points (3, ...), NaN where a coordinate is NaN."""
        x, y, z = np.asarray(points)
        across = x * self.right[0] + y * self.right[1] + z * self.right[2]
        up = x * self.up[0] + y * self.up[1] + z * self.up[2]
        return across * self.scale + self.shift[0], up * self.scale + self.shift[1]


class OccludingEllipsoid:
    """The states of one energy just before an impact, eq. (29) with xdot + udot >= 0.

    They are half of the ellipsoid on which twice the energy is xdot^2 + k udot^2 + k (x - g/k)^2 -
    g^2/k. Points are arrays (3, n) of x, xdot and udot.
    """

    def __init__(self, k: float, g: float, energy: float) -> None:
        self.k, self.centre = float(k), float(g / k)
        self.radius = math.sqrt(twice_energy_above_rest(k, g, energy))

    def has(self, points: np.ndarray) -> np.ndarray:
        """Return whether points of the whole ellipsoid belong to the half."""
        return points[1] + points[2] >= 0.0

    def before(self, eye: tuple[float, float, float], points: np.ndarray) -> list[np.ndarray]:
        """Return two points of the ellipsoid from each point towards the eye, NaN if behind it."""
        x, y, z = points[0] - self.centre, points[1], points[2]
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
            point = self.centre + x + far * eye_x, y + far * eye_y, z + far * eye_z
            intersections.append(np.array(point))
        return intersections

    def ends(self) -> list[tuple[float, float]]:
        """Return the least and the largest x, xdot and udot."""
        wide, back = self.radius / math.sqrt(self.k), -self.radius / math.sqrt(1.0 + self.k)
        return [(self.centre - wide, self.centre + wide), (back, self.radius), (back, wide)]

    def rim(self) -> np.ndarray:
        """Return the closed curve on which the contact speed vanishes."""
        sine, cosine = _circle()
        along = self.radius * sine / math.sqrt(1.0 + self.k)
        x = self.centre + self.radius / math.sqrt(self.k) * cosine
        return np.array([x, along, -along])

    def outline(self, view: Projection) -> np.ndarray:
        """Return the outline of the half in a projection, x NaN where the other half has it."""
        sine, cosine = _circle()
        x, y, z = (a * cosine + b * sine for a, b in zip(view.right, view.up, strict=True))
        length = np.sqrt(x * x / self.k + y * y + z * z / self.k)
        far = self.radius / length
        curve = np.array([x * far / self.k, y * far, z * far / self.k])
        curve[0] = np.where(self.has(curve), self.centre + curve[0], np.nan)
        return curve


def _circle() -> tuple[np.ndarray, np.ndarray]:
    """Return sines and cosines of angles all around, from rational points of the circle."""
    t = np.arange(_SIDES) / _SIDES
    sine, cosine = 2.0 * t / (1.0 + t * t), (1.0 - t * t) / (1.0 + t * t)
    return (
        np.concatenate([sine, cosine, -sine, -cosine, [0.0]]),
        np.concatenate([cosine, -sine, -cosine, sine, [1.0]]),
    )
