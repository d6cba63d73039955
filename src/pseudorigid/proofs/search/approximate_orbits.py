"""Orbits that the dynamics knows, as the floats from which searches begin."""

from ...dynamics.ball import Ball
from ...dynamics.periodic import symmetric_orbits
from ...dynamics.variables import of_type


def ball(surface):
    """The Ball whose k and g are the doubles nearest to a surface's."""
    return Ball(k=float(surface.k), g=float(surface.g))


def points(surface, period, kind):
    """The points (x, y) of the first symmetric orbit of this period and type."""
    near = ball(surface)
    return chart(near, of_type(symmetric_orbits(near, float(surface.energy), period), kind))


def chart(near, orbit):
    """The points (x, y) of one orbit's Dataset."""
    x, xdot, udot = (orbit[name].values.tolist() for name in ("x", "xdot", "udot"))
    return [(a, b - near.k * c) for a, b, c in zip(x, xdot, udot, strict=True)]
