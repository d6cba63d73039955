"""Stable and unstable manifolds on the energy surface: Figure 5 of the paper."""

import numpy as np

from ...dynamics.variables import of_type, states_of
from ..axes.box import Box
from ..axes.limits import complete_box, refuse_empty
from ..canvas import style
from ..canvas.ragged import rows

_BACKDROP, _SADDLE, _END = 0.5, 3.6, 2.6  # points
_WORDS = dict(enumerate(("one", "two", "three", "four", "five", "six"), 1))
# Stable branches first and broader: both show where they all but coincide.
_BRANCHES = ((1, style.STABLE, 0.8), (0, style.UNSTABLE, 0.5))


@style.pinned()
def draw(scene, orbits, manifolds, periodic):
    """A hyperbolic orbit's branches over a backdrop of orbits.

    Stable branches are green, unstable ones blue; a line ends in an open dot where it was
    not followed further, or where the map jumps. What the surface hides is not drawn.

    Parameters
    ----------
    scene : dict
    orbits, manifolds, periodic : xarray.Dataset
        Of these stages; `orbits` are the backdrop, and the saddles marked are the points of the
        first orbit of `periodic` whose type is scene["type"].

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    ValueError
        Nothing lies within the axes, or no orbit has that type.
    """
    scene = complete_box(scene, orbits, manifolds)
    refuse_empty(scene["axes"], manifolds)
    saddles = states_of(of_type(periodic, scene["type"]))
    count = saddles.shape[1]
    entries = [
        ("stable", style.STABLE, "", False),
        ("unstable", style.UNSTABLE, "", False),
        (f"period-{_WORDS.get(count, count)} points", style.VERMILION, "o", False),
        ("sea and islands", style.BACKDROP, "o", False),
        ("end of a line", style.UNSTABLE, "o", True),
    ]
    box = Box(scene, entries)
    box.points(*states_of(orbits), style.BACKDROP, _BACKDROP)
    _branches(box, manifolds)
    box.points(*saddles, "white", _SADDLE + 1.2)
    box.points(*saddles, style.VERMILION, _SADDLE)
    return box.figure


def _branches(box, manifolds):
    spans, state = rows(manifolds), states_of(manifolds)
    ends = []
    for stable, hue, width in _BRANCHES:
        for span in (spans[i] for i in np.flatnonzero(manifolds["stable"].values == stable)):
            line = state[:, span]
            box.line(*line, hue, width)
            gap = np.isnan(line[0])
            end = ~gap & (np.append(gap[1:], True) | np.insert(gap[:-1], 0, False))
            ends.append((*line[:, end], hue))
    for end in ends:
        box.points(*end, _END, mfc="white", mew=0.6)
