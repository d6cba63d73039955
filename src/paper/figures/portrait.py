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
_MOST = 4  # orbits that are not regular, whose starts the key has


def draw(scene: dict[str, Any], orbits: xr.Dataset) -> Figure:
    """Draw orbits in (x, xdot, udot) on the opaque energy surface, those not regular in grey.

    Regular ones have colours from dark to light, and, if several are seen, the numbers of their
    starts. Raises ValueError if nothing can be seen.
    """
    return drawn(scene, orbits)[0]


@style.pinned()
def drawn(scene: dict[str, Any], orbits: xr.Dataset) -> tuple[Figure, np.ndarray]:
    """Return the figure, and how many points of each orbit are seen."""
    scene, states, spans = complete_box(scene, orbits), states_of(orbits), rows(orbits)
    types = orbits["type"].values
    others, regular = (np.flatnonzero((types == "regular") == each) for each in (False, True))
    trial = Box(scene, shown=states)
    seen = np.array([trial.seen(states[:, span]).sum() for span in spans])
    name = style.irregular(types[seen > 0].tolist())
    numbered = np.sum(seen[regular] > 0) > 1
    if name and numbered and len(others) <= _MOST:
        numbers = [f"{index + 1}" for index in others.tolist() if seen[index]]
        name += f", {style.plural('start', len(numbers))} {', '.join(numbers)}"
    entries = [(name, style.SEA, "o")] if name else []
    hues = dict(zip(regular.tolist(), style.ordered(len(regular)), strict=True))
    if numbered:
        first = next(hue for index, hue in hues.items() if seen[index])
        entries.append(("regular orbits, numbered by start", first, "o"))
    box = Box(scene, entries)
    for index in [*others.tolist(), *hues]:
        hue, size = (hues[index], _CURVE) if index in hues else (style.SEA, _SEA)
        box.points(states[:, spans[index]], hue, size)
    if numbered:
        curves = [states[:, spans[index]] for index in hues]
        sea = np.hstack([np.empty((3, 0)), *(states[:, spans[index]] for index in others)])
        box.names(curves, [f"{index + 1}" for index in hues], [*hues.values()], sea)
    return box.figure, seen


def hidden(scene: dict[str, Any], orbits: xr.Dataset) -> Iterator[str]:
    """Say which axes cut the energy surface."""
    return cuts(scene, "impacts", orbits)
