"""Periodic orbits in doubles, from which searches begin."""

import xarray as xr

from ...dynamics.ball import Ball
from ...dynamics.periodic import symmetric_orbits
from ...dynamics.variables import of_type
from ..enclosure.surface import Surface


def ball(surface: Surface) -> Ball:
    """Return the Ball whose k and g are the doubles nearest to a surface's."""
    return Ball(k=float(surface.k), g=float(surface.g))


def points(surface: Surface, period: int, kind: str) -> list[tuple[float, float]]:
    """Return the points (x, y) of the first symmetric orbit of this period and type."""
    near = ball(surface)
    orbits = symmetric_orbits(near, float(surface.energy), period)
    return chart_points(near, of_type(orbits, kind))


def chart_points(near: Ball, orbit: xr.Dataset) -> list[tuple[float, float]]:
    """Return the points (x, y) of an orbit's Dataset."""
    x, xdot, udot = (orbit[name].values.tolist() for name in ("x", "xdot", "udot"))
    return [(a, b - near.k * c) for a, b, c in zip(x, xdot, udot, strict=True)]
