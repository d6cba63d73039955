"""Orbits on the energy surface: Figures 2 and 8 of the paper."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from pseudorigid.dynamics.variables import rows, states_of
from pseudorigid.figures.axes.box import Box
from pseudorigid.figures.axes.limits import complete_box, cuts
from pseudorigid.figures.canvas import style

_CURVE, _SEA = 0.8, 0.4  # points


@style.pinned()
def draw(scene: dict[str, Any], orbits: xr.Dataset) -> Figure:
    """Draw orbits in (x, xdot, udot) on the opaque energy surface, chaotic ones in grey.

    Regular ones have colours from dark to light, and, if there are some, the numbers of their
    starts. Raises ValueError if nothing can be seen.
    """
    scene, states, spans = complete_box(scene, orbits), states_of(orbits), rows(orbits)
    is_regular = orbits["type"].values == "regular"
    chaotic, regular = (np.flatnonzero(is_regular == each).tolist() for each in (False, True))
    name = style.plural("chaotic orbit", len(chaotic))
    box = Box(scene, [(name, style.SEA, "o")] if chaotic else [], states)
    hues = dict(zip(regular, style.ordered(len(regular)), strict=True))
    for index in chaotic + regular:
        hue, size = (hues[index], _CURVE) if index in hues else (style.SEA, _SEA)
        box.points(states[:, spans[index]], hue, size)
    if len(regular) > 1:
        curves = [states[:, spans[index]] for index in regular]
        box.names(curves, [f"{index + 1}" for index in regular], [*hues.values()])
    return box.figure


def hidden(scene: dict[str, Any], orbits: xr.Dataset) -> Iterator[str]:
    """Say which axes cut the energy surface."""
    return cuts(scene, "impacts", orbits)
