"""Stable and unstable manifolds on the energy surface: Figure 5 of the paper."""

import numpy as np

from ...dynamics.variables import of_type
from ..axes.box import Box
from ..axes.limits import complete_box, refuse_empty
from ..canvas import style
from ..canvas.ragged import rows

_BACKDROP, _SADDLE = 0.5, 3.6  # points
# Stable branches first and broader: both show where they all but coincide.
_BRANCHES = ((1, style.STABLE, 0.8), (0, style.UNSTABLE, 0.5))


@style.pinned()
def draw(scene, orbits, manifolds, periodic):
    """Return the Figure of a hyperbolic orbit's branches over a backdrop of orbits.

    `orbits` (the backdrop), `manifolds` and `periodic` are artifacts of these stages; the saddles
    marked are the points of the first orbit of `periodic` whose type is scene["type"]. Stable
    branches are green, unstable ones blue; what lies on the surface's far side is pale.
    """
    scene = complete_box(scene, orbits, manifolds)
    refuse_empty(scene["axes"], manifolds)
    box = Box(scene)
    near = box.near(orbits)
    for side in (False, True):
        state = (orbits[name].values[near == side] for name in style.NAMES)
        box.points(*state, style.BACKDROP if side else style.pale(style.BACKDROP), _BACKDROP)
    _branches(box, manifolds)
    saddle = of_type(periodic, scene["type"])
    state = [saddle[name].values for name in style.NAMES]
    box.points(*state, "white", _SADDLE + 1.2)
    box.points(*state, style.VERMILION, _SADDLE)
    return box.figure


def _branches(box, manifolds):
    near = box.near(manifolds)
    spans = rows(manifolds["row_size"].values)
    for side in (False, True):
        for stable, hue, width in _BRANCHES:
            for span in (spans[i] for i in np.flatnonzero(manifolds["stable"].values == stable)):
                hide = near[span] != side
                # Keep the first hidden vertex on each side, so that pale and full parts meet.
                hide[1:-1] &= (near[span] != side)[2:] & (near[span] != side)[:-2]
                state = [
                    np.where(hide, np.nan, manifolds[name].values[span]) for name in style.NAMES
                ]
                box.line(*state, hue if side else style.pale(hue), width)
