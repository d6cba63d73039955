"""Lyapunov exponents against the number of impacts: Figure 7 of the paper."""

import numpy as np

from ...dynamics.variables import final_exponents
from ..axes.limits import complete, of_data
from ..axes.plane import Plane
from ..canvas import style


@style.pinned()
def draw(scene, lyapunov):
    """Return the Figure of the exponents' histories, one hue an orbit, named at their ends.

    `lyapunov` is the artifact of that stage: exponent (impact, orbit, index) and impact.
    """
    impact, exponent = lyapunov["impact"].values, lyapunov["exponent"].values
    scene = complete(
        scene,
        impact=lambda: of_data([0, int(impact[-1])], room=0.0),
        exponent=lambda: of_data(exponent),
    )
    picture = plane(scene)
    _, orbits, indices = exponent.shape
    for orbit in range(orbits):
        hue = style.HUES[orbit % len(style.HUES)]
        for index in range(indices):
            there = ~np.isnan(exponent[:, orbit, index])
            picture.line(impact[there], exponent[there, orbit, index], color=hue, lw=0.8)
    ends = np.median(final_exponents(lyapunov), axis=0)
    picture.beside([(ends[index], rf"$\lambda_{index + 1}$") for index in range(indices)])
    return picture.figure


def plane(scene):
    """The empty picture of a scene with its axes."""
    names = ("Number of impacts", "Lyapunov exponents")
    return Plane(scene, ("impact", "exponent"), names, right=84)
