"""Orbits on the energy surface: Figures 2 and 8 of the paper."""

from ..axes.box import Box
from ..axes.limits import complete_box, refuse_empty
from ..canvas import style
from ..canvas.ragged import rows

_CURVE, _SEA = 0.8, 0.4  # points


@style.pinned()
def draw(scene, orbits):
    """Return the Figure of a scene's orbits in (x, xdot, udot).

    `orbits` is the artifact of stage orbits: x, xdot, udot (point), row_size (orbit). The orbits
    with index in scene["sea"] come first, in grey; each other one has a hue of its own. What lies
    on the far side of the surface is pale and behind the rest. Axes that the scene does not give
    are those of the orbits. Raises ValueError for a sea that the scene does not have.
    """
    scene = complete_box(scene, orbits)
    refuse_empty(scene["axes"], orbits)
    box = Box(scene)
    spans = rows(orbits["row_size"].values)
    sea = set(scene["sea"])
    if not sea <= set(range(len(spans))):
        raise ValueError(f"sea {sorted(sea)}: the scene has orbits 0 to {len(spans) - 1}")
    others = [index for index in range(len(spans)) if index not in sea]
    hues = {index: style.HUES[place % len(style.HUES)] for place, index in enumerate(others)}
    near = box.near(orbits)
    for side in (False, True):
        for index in sorted(sea) + others:
            span = spans[index]
            keep = near[span] == side
            state = (orbits[name].values[span][keep] for name in style.NAMES)
            hue, size = (hues[index], _CURVE) if index in hues else (style.SEA, _SEA)
            box.points(*state, hue if side else style.pale(hue), size)
    return box.figure
