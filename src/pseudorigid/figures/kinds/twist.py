"""The fixed point's twist against the energy, and where it vanishes."""

import numpy as np

from ..axes.limits import complete, of_data
from ..axes.plane import Plane
from ..canvas import style
from ..canvas.sheet import POINT

_DOT = 3.2  # points


@style.pinned()
def draw(scene, twist):
    """The twist coefficient of the fixed point over the energy.

    Parameters
    ----------
    scene : dict
        Its marks, energies among its own, are marked as dots and named, the zero as a ring.
    twist : xarray.Dataset
        As from `proofs.theorems.pictures.twist_data`.

    Returns
    -------
    matplotlib.figure.Figure
    """
    energy, values = twist["energy"].values, twist["twist"].values
    scene = complete(
        scene,
        energy=lambda: of_data([0.0, *energy], room=0.0),
        twist=lambda: of_data(values),
    )
    names = ("Energy $E$", r"Twist $\tau_1$ of the fixed point")
    plane = Plane(scene, ("energy", "twist"), names, energy=False)
    (left, right), (bottom, _) = plane.across.limits, plane.up.limits
    zero = float(twist["zero"])
    plane.line([left, right], [0.0, 0.0], color=style.BACKDROP, lw=0.6)
    plane.line([zero, zero], [bottom, 0.0], color=style.BACKDROP, lw=0.6)
    plane.line(energy, values, color=style.BLUE, lw=1.1)
    for mark in scene["marks"]:
        at = int(np.argmin(np.abs(energy - mark)))
        plane.dots([energy[at]], [values[at]], style.BLUE, _DOT)
        _name(plane, energy[at], values[at], f"$E$ = {style.number(mark)}")
    plane.dots([zero], [0.0], "white", _DOT + 0.6, mew=1.0, mec=style.VERMILION)
    _name(plane, zero, 0.0, f"$E$ = {zero:.6f}", left=True)
    return plane.figure


def _name(plane, x, y, text, left=False):
    """Write a text above a point, to its right or left."""
    across, up = (float(a[0]) for a in plane.place(x, y))
    across, up = across + (-10 if left else 4) * POINT, up + (-14 if left else 2) * POINT
    ha = "right" if left else "left"
    plane.sheet.text(across, up, text, ha=ha, va="bottom", size=style.PLAIN)
