"""Stable and unstable manifolds near one saddle, in the (x, xdot) plane: Figure 6 of the paper."""

from collections.abc import Iterator
from functools import partial
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from pseudorigid.dynamics.variables import rows
from pseudorigid.figures.axes.limits import complete, hides, refuse_empty, ticks
from pseudorigid.figures.axes.plane import Plane
from pseudorigid.figures.canvas import style

_DOT = 3.4  # points
_NAMES = style.NAMES["x"], style.NAMES["xdot"]
empty_picture = partial(Plane, axes=("x", "xdot"), names=_NAMES, high=975, right=75)


@style.pinned()
def draw(scene: dict[str, Any], manifolds: xr.Dataset) -> Figure:
    """Draw the branches inside a window around a saddle; stable ones green, unstable ones blue.

    The scene's axes default to the window's. Raises ValueError if they or the window show nothing.
    """
    x, xdot = manifolds["x"].values, manifolds["xdot"].values
    if np.isnan(x).all():
        low, high = (manifolds.attrs[f"window_{name}"] for name in ("x", "xdot"))
        raise ValueError(f"window: no branch of this length passes x {low}, xdot {high}")

    def window(name: str) -> dict[str, list[float]]:
        low, high = map(float, manifolds.attrs[f"window_{name}"])
        return {"limits": [low, high], "ticks": ticks(low, high, 4)}

    scene = complete(scene, x=partial(window, "x"), xdot=partial(window, "xdot"))
    refuse_empty(scene["axes"], {"x": x, "xdot": xdot})
    picture = empty_picture(scene)
    for stable, span in zip(manifolds["stable"].values, rows(manifolds), strict=True):
        picture.line(x[span], xdot[span], color=style.MANIFOLDS[stable], lw=0.5)
    saddle = [manifolds.attrs["point_x"]], [manifolds.attrs["point_xdot"]]
    picture.dots(*saddle, style.BLACK, _DOT, mew=0.5, mec="white")
    picture.legend(
        picture.shows(*saddle) and ("saddle", 32, {"color": style.BLACK, "dots": _DOT}),
        ("stable", 26, {"color": style.STABLE, "lw": 1.0}),
        ("unstable", 36, {"color": style.UNSTABLE, "lw": 1.0}),
    )
    return picture.figure


def hidden(scene: dict[str, Any], manifolds: xr.Dataset) -> Iterator[str]:
    """Say which axes hide a part of the window, which itself shows a part of the branches."""
    steps = np.arange(1001) / 1000
    for name in ("x", "xdot"):
        low, high = manifolds.attrs[f"window_{name}"]
        yield from hides(scene, "the window", **{name: low + (high - low) * steps})
