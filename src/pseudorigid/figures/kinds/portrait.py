"""Orbits on the energy surface: Figures 2 and 8 of the paper."""

from ..axes.box import Box
from ..axes.limits import complete_box, refuse_empty
from ..canvas import style
from ..canvas.ragged_rows import rows

_CURVE, _SEA = 0.8, 0.4  # points


@style.pinned()
def draw(scene, orbits):
    """A scene's orbits in (x, xdot, udot).

    The orbits with index in scene["sea"] come first, in grey; each other one has a hue of its own.
    What the surface hides is not drawn.

    Parameters
    ----------
    scene : dict
        Axes that it does not give are those of the orbits.
    orbits : xarray.Dataset
        Of that stage: x, xdot, udot (point), row_size (orbit).

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    ValueError
        A sea that the scene does not have, axes that show nothing, or a view that does.
    """
    scene = complete_box(scene, orbits)
    refuse_empty(scene["axes"], {name: orbits[name].values for name in style.NAMES})
    spans = rows(orbits)
    sea = set(scene["sea"])
    if not sea <= set(range(len(spans))):
        raise ValueError(f"sea {sorted(sea)}: the scene has orbits 0 to {len(spans) - 1}")
    entries = [("chaotic orbit", style.SEA, "o", False)] if sea else []
    box = Box(scene, entries)
    box.refuse_hidden(*(orbits[name].values for name in style.NAMES))
    others = [index for index in range(len(spans)) if index not in sea]
    hues = {index: style.HUES[place % len(style.HUES)] for place, index in enumerate(others)}
    for index in sorted(sea) + others:
        state = (orbits[name].values[spans[index]] for name in style.NAMES)
        hue, size = (hues[index], _CURVE) if index in hues else (style.SEA, _SEA)
        box.points(*state, hue, size)
    return box.figure
