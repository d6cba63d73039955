"""The fixed point's twist against the energy, and where it vanishes."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from pseudorigid.figures.axes.limits import complete, hides, of_data, refuse_empty
from pseudorigid.figures.axes.plane import Plane
from pseudorigid.figures.canvas import style

_DOT = 3.2  # points
_RIGHTMOST = 0.75  # of the width of the frame: a text beside a point beyond it would leave it


@style.pinned()
def draw(scene: dict[str, Any], twist: xr.Dataset) -> Figure:
    """Draw the twist of the fixed point against the energy, with scene["marks"] and a ring at 0.

    Raises ValueError if the axes show nothing of the line.
    """
    energy, values = twist["energy"].values, twist["twist"].values
    scene = complete(
        scene,
        energy=lambda: of_data([0.0, *energy], room=0.0),
        twist=lambda: of_data(values, room=0.1),  # for the texts beside the marks
    )
    refuse_empty(scene["axes"], {"energy": energy, "twist": values}, joined=True)
    names = ("Energy $E$", r"Twist $\tau_1$ of the fixed point")
    plane = Plane(scene, ("energy", "twist"), names, energy=False)
    (left, right), (bottom, _) = plane.across.limits, plane.up.limits
    zero = float(twist["zero"])
    plane.line([left, right], [0.0, 0.0], color=style.BACKDROP, lw=0.6)
    if not np.isnan(zero):
        plane.line([zero, zero], [bottom, 0.0], color=style.BACKDROP, lw=0.6)
    plane.line(energy, values, color=style.BLUE, lw=1.1)
    for mark in scene["marks"]:
        at = int(np.argmin(np.abs(energy - mark)))
        plane.dots([energy[at]], [values[at]], style.BLUE, _DOT)
        text = f"$E$ = {style.number(mark)}"
        if plane.shows(energy[at], values[at]):
            if plane.across.between(energy[at]) > _RIGHTMOST:  # below a line that mostly falls
                plane.note(energy[at], values[at], text, (-4, -2), "right", "top")
            else:
                plane.note(energy[at], values[at], text, (4, 2), "left", "bottom")
    if plane.shows(zero, 0.0):
        plane.dots([zero], [0.0], "white", _DOT + 0.6, mew=1.0, mec=style.VERMILION)
        plane.note(zero, 0.0, f"$E$ = {zero:.6f}", shift=(-10, -14), ha="right", va="bottom")
    return plane.figure


def hidden(scene: dict[str, Any], twist: xr.Dataset) -> Iterator[str]:
    """Say which axes hide computed values."""
    energy, values = twist["energy"].values, twist["twist"].values
    return hides(scene, f"{energy.size} energies", energy=energy, twist=values)
