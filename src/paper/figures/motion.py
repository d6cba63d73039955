"""A periodic motion in time, -x(t) and u(t): Figures 3 and 4 of the paper."""

from collections.abc import Iterator
from functools import partial
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from pseudorigid.figures.axes.limits import complete, hides, of_data, refuse_empty
from pseudorigid.figures.axes.plane import Plane
from pseudorigid.figures.canvas import style

_DOT = 2.4  # points
empty_picture = partial(Plane, axes=("t", "displacement"), names=("$t$", r"$-x,\ u$"))


@style.pinned()
def draw(scene: dict[str, Any], motion: xr.Dataset) -> Figure:
    """Draw -x(t) and u(t), with their impacts; ValueError if the axes show nothing of them."""
    t, x, u = (motion[name].values for name in ("t", "position", "strain"))
    scene = complete(
        scene,
        t=lambda: of_data([0.0, scene["duration"]], room=0.0),
        displacement=lambda: of_data(-x, u),
    )
    both = {"t": [*t, np.nan, *t], "displacement": [*-x, np.nan, *u]}
    refuse_empty(scene["axes"], {name: np.array(both[name]) for name in both}, joined=True)
    picture = empty_picture(scene)
    height = {"color": style.BLUE, "lw": 1.0}
    strain = {"color": style.VERMILION, "lw": 1.0, "ls": (0, (4, 1.2))}
    picture.line(t, -x, **height)
    picture.line(t, u, **strain)
    impacts = motion["impact_t"].values, -motion["impact_position"].values
    picture.dots(*impacts, style.BLACK, _DOT)
    picture.legend(
        ("$-x(t)$", 26, height),
        ("$u(t)$", 18, strain),
        picture.shows(*impacts).any() and ("impact", 28, {"color": style.BLACK, "dots": _DOT}),
    )
    return picture.figure


def hidden(scene: dict[str, Any], motion: xr.Dataset) -> Iterator[str]:
    """Say what the axes hide of the two lines."""
    both = np.concatenate([-motion["position"].values, motion["strain"].values])
    return hides(scene, "the lines", t=motion["t"].values, displacement=both)
