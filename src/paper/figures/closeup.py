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
from pseudorigid.figures.canvas.names import dense
from pseudorigid.figures.canvas.sheet import pieces

_DOT = 3.4  # points
_THICK = 1.5  # points: width of stable branches that would hide unstable ones
_SHORT = 50  # pixels: pieces of lines that decide nothing
_CELL = 3  # pixels: lines that share most cells of this size coincide
_NAMES = style.NAMES["x"], style.NAMES["xdot"]
empty_picture = partial(Plane, axes=("x", "xdot"), names=_NAMES, high=975, right=75)


def draw(scene: dict[str, Any], manifolds: xr.Dataset) -> Figure:
    """Draw the branches inside a window around a saddle; stable ones green, unstable ones blue.

    Where some of both coincide, stable ones are thick and lie below the others. The scene's axes
    default to the window's. Raises ValueError if they or the window show nothing.
    """
    return drawn(scene, manifolds)[0]


@style.pinned()
def drawn(scene: dict[str, Any], manifolds: xr.Dataset) -> tuple[Figure, bool]:
    """Return the figure, and whether branches of both kinds coincide in it."""
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
    kinds, spans = manifolds["stable"].values, rows(manifolds)
    coincide = _coincide(picture, [(x[span], xdot[span]) for span in spans], kinds)
    for i in np.argsort(-kinds * coincide, kind="stable"):
        wide = _THICK if coincide and kinds[i] else 0.5
        picture.line(x[spans[i]], xdot[spans[i]], color=style.MANIFOLDS[kinds[i]], lw=wide)
    saddle = [manifolds.attrs["point_x"]], [manifolds.attrs["point_xdot"]]
    picture.dots(*saddle, style.BLACK, _DOT, mew=0.5, mec="white")
    picture.legend(
        picture.shows(*saddle) and ("saddle", 32, {"color": style.BLACK, "dots": _DOT}),
        ("stable", 26, {"color": style.STABLE, "lw": _THICK if coincide else 1.0}),
        ("unstable", 36, {"color": style.UNSTABLE, "lw": 0.5 if coincide else 1.0}),
    )
    return picture.figure, coincide


def _coincide(
    picture: Plane, lines: list[tuple[np.ndarray, np.ndarray]], kinds: np.ndarray
) -> bool:
    """Return whether one kind of lines hides more than half of what is seen of one of the other."""
    cells = []
    for line in lines:
        parts = [dense(piece, picture.frame) for piece in pieces(*picture.place(*line))]
        across, up = np.floor(np.hstack([np.empty((2, 0)), *parts]) / _CELL)
        cells.append(across + 1j * up)
    for own, kind in zip(cells, kinds, strict=True):
        others = [np.empty(0), *(cells[i] for i in np.flatnonzero(kinds != kind))]
        if np.isin(own, np.concatenate(others)).sum() > 0.5 * max(own.size, _SHORT):
            return True
    return False


def hidden(scene: dict[str, Any], manifolds: xr.Dataset) -> Iterator[str]:
    """Say which axes hide a part of the window, which itself shows a part of the branches."""
    steps = np.arange(1001) / 1000
    for name in ("x", "xdot"):
        low, high = manifolds.attrs[f"window_{name}"]
        yield from hides(scene, "the window", **{name: low + (high - low) * steps})
