"""The sets of a horseshoe along a connection, over the manifolds, and one covering relation."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from pseudorigid.dynamics.variables import chart, rows, states_of
from pseudorigid.figures.axes import section
from pseudorigid.figures.axes.limits import complete, hides, inside, of_data, refuse_empty
from pseudorigid.figures.axes.panel import Axis, Window, corner, key, letters
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import Sheet

_HIGH = 1575  # pixels
_WIDTHS, _RIM = (0.5, 1.0), 0.8  # points: of unstable and of stable branches, and of the rim
_ABOVE, _BELOW = (135, 765, 1005, 1335), (135, 135, 1005, 600)
_HALF = "${}$, in half sides of the middle set"
_ROOM = 1.3  # height of the lower panel over that of its square; the square's name is above it


@style.pinned()
def draw(scene: dict[str, Any], manifolds: xr.Dataset, horseshoe: xr.Dataset) -> Figure:
    """Draw the sets of a horseshoe, as large dots over the manifolds, and one covering relation.

    Raises ValueError if the axes show none of the sets or nothing of the image.
    """
    line_x, line_y = chart(horseshoe.attrs["k"], *states_of(manifolds))
    rim_x, rim_y = section.rim(scene)  # around all that can be drawn
    scene = complete(
        scene,
        x=lambda: of_data(rim_x),
        y=lambda: of_data(rim_y),
        p=lambda: of_data(horseshoe["image_p"].values),
        q=lambda: of_data([-_ROOM, _ROOM], room=0.0),
    )
    refuse_empty(scene["axes"], {name: horseshoe[name].values for name in "xy"})
    for name in "pq":
        refuse_empty(scene["axes"], {name: horseshoe[f"image_{name}"].values})
    sheet = Sheet(style.COLUMN, _HIGH)
    names = {"x": "$x$", "y": section.NAME, "p": _HALF.format("p"), "q": _HALF.format("q")}
    x, y, p, q = (Axis(**scene["axes"][axis], name=name) for axis, name in names.items())
    panel = Window(sheet, _ABOVE, x, y)
    for stable, span in zip(manifolds["stable"].values, rows(manifolds), strict=True):
        panel.line(line_x[span], line_y[span], color=style.MANIFOLDS[stable], lw=_WIDTHS[stable])
    panel.line(rim_x, rim_y, color=style.RIM, lw=_RIM)
    _sets(panel, horseshoe)
    _relation(Window(sheet, _BELOW, p, q), horseshoe)
    corner(sheet, _BELOW, style.setting(scene))
    letters(sheet, _ABOVE, _BELOW)
    return sheet.figure


def hidden(scene: dict[str, Any], manifolds: xr.Dataset, horseshoe: xr.Dataset) -> Iterator[str]:
    """Say which axes hide sets, branches, or the image and square below."""
    lines = chart(horseshoe.attrs["k"], *states_of(manifolds))
    both = {n: np.append(horseshoe[n], line) for n, line in zip("xy", lines, strict=True)}
    yield from hides(scene, "the sets and branches", **both)
    square = np.linspace(-1.0, 1.0, 201)
    yield from hides(scene, "the image", p=horseshoe["image_p"].values)
    yield from hides(scene, "the middle set", p=square, q=square)


def _sets(panel: Window, horseshoe: xr.Dataset) -> None:
    """Draw the centres of the sets, and the key.

    `chain` is a set's index along the chain: below 0 on the way out, 0 for the middle set, above 0
    on the way back, and NaN for the sets at the saddles.
    """
    x, y, chain = (horseshoe[name].values for name in ("x", "y", "chain"))
    out, back = (style.BLUE, "o", False, 3.0), (style.VERMILION, "^", False, 3.6)
    saddles, middle = (style.BLACK, "s", False, 4.0), (style.VERMILION, "D", False, 4.4)
    for sets, (hue, mark, _, size) in (
        (chain < 0.0, out),
        (chain > 0.0, back),
        (np.isnan(chain), saddles),
        (chain == 0.0, middle),
    ):
        panel.dots(x[sets], y[sets], "white", size=size + 1.2, marker=mark)
        panel.dots(x[sets], y[sets], hue, size=size, marker=mark)
    entries = (
        ("at the saddles", *saddles),
        ("middle set", *middle),
        ("stable", style.STABLE, "", False, _WIDTHS[1]),
        ("on the way out", *out),
        ("on the way back", *back),
        ("unstable", style.UNSTABLE, "", False, _WIDTHS[0]),
        ("grazing rim", style.RIM, "", False, _RIM),
    )
    left, _, right, _ = panel.frame
    key(panel.sheet, entries, _HIGH - 29, 3, left, right - left)


def _relation(panel: Window, horseshoe: xr.Dataset) -> None:
    """Draw the image of the set before the middle one, across the square of the middle one.

    `image_p` and `image_q` (edge, point) are in half widths of the middle set. The edges are the
    images of p = -1 and 1, drawn last and heavy, and before them those of q = -1 and 1.
    """
    p, q = horseshoe["image_p"].values, horseshoe["image_q"].values
    square = [-1.0, 1.0, 1.0, -1.0, -1.0], [-1.0, -1.0, 1.0, 1.0, -1.0]
    panel.line(*square, color=style.VERMILION, lw=1.6)
    for edge, wide in ((2, 0.8), (3, 0.8), (0, 2.0), (1, 2.0)):
        panel.line(p[edge], q[edge], color=style.BLUE, lw=wide)
    texts = (
        (1.0, 5.5, "the middle set"),
        (0.0, 6.5, "image of the set before it"),
        (0.0, -6.5, "(heavy: its two ends)"),
    )
    for up, gap, text in texts:
        if inside((panel.across.limits, panel.up.limits), (0.0, up)):
            panel.note(0.0, up, text, shift=(0.0, gap), ha="center")
