"""Periodic orbits in doubles, from which searches begin."""

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.periodic import symmetric_orbits
from pseudorigid.dynamics.variables import chart, of_type, states_of
from study.enclosure.surface import Surface

from .certificate_text import Theorem


def ball(surface: Surface) -> Ball:
    """Return the Ball whose k and g are the doubles nearest to a surface's."""
    return Ball(k=float(surface.k), g=float(surface.g))


def points_of(theorem: Theorem, kind: str) -> list[list[float]]:
    """Return the points (x, y) near which a theorem states an orbit of this type."""
    return points(theorem.bounds["surface"], theorem.bounds["period"], kind)


def points(surface: Surface, period: int, kind: str) -> list[list[float]]:
    """Return the points (x, y) of the first symmetric orbit of this period and type."""
    near = ball(surface)
    orbits = symmetric_orbits(near, float(surface.energy), period)
    return chart(near.k, *states_of(of_type(orbits, kind))).T.tolist()
