"""The sets of a horseshoe along a connection, over the tangle, and one set's image magnified."""

import numpy as np

from ..axes.panel import Axis, Panel, corner
from ..canvas import style
from ..canvas.ragged import rows
from ..canvas.sheet import POINT, Sheet

_HIGH = 1425
_ABOVE, _BELOW = (135, 765, 1005, 1335), (135, 135, 1005, 600)
_SIZE = 8.0  # points: text


@style.pinned()
def draw(scene, manifolds, horseshoe):
    """The sets of a horseshoe in the chart (x, y = xdot - k udot), over the tangle.

    Above: the sets, drawn as dots, far larger than they are, at the saddles and along the
    connection. Below: the middle set of the chain as the square from -1 to 1, and across it the
    image of the set before it, whose two ends, beyond the square, are heavy.

    Parameters
    ----------
    scene : dict
        Its axes are x, y, p and q.
    manifolds : xarray.Dataset
        Of that stage.
    horseshoe : xarray.Dataset
        As from `proofs.theorems.pictures.horseshoe_data`.

    Returns
    -------
    matplotlib.figure.Figure
    """
    sheet = Sheet(style.COLUMN, _HIGH)
    axes = {
        name: Axis(tuple(axis["limits"]), tuple(axis["ticks"]), label)
        for (name, axis), label in zip(
            ((name, scene["axes"][name]) for name in ("x", "y", "p", "q")),
            ("$x$", "$y$", "$p$", "$q$"),
            strict=True,
        )
    }
    _tangle(Panel(sheet, _ABOVE, axes["x"], axes["y"]), manifolds, horseshoe)
    _relation(Panel(sheet, _BELOW, axes["p"], axes["q"]), horseshoe)
    corner(sheet, _BELOW, style.setting(scene))
    return sheet.figure


def _tangle(panel, manifolds, horseshoe):
    k = horseshoe.attrs["k"]
    x = manifolds["x"].values
    y = manifolds["xdot"].values - k * manifolds["udot"].values
    stable = manifolds["stable"].values
    for branch, span in enumerate(rows(manifolds["row_size"].values)):
        hue = style.STABLE if stable[branch] else style.UNSTABLE
        panel.line(x[span], y[span], color=style.pale(hue), lw=0.4)
    chain = horseshoe["chain"].values
    saddle, middle = np.isnan(chain), chain == 0.0
    before, after = chain < 0.0, chain > 0.0
    x, y = horseshoe["x"].values, horseshoe["y"].values
    panel.dots(x[before], y[before], style.BLUE, size=2.0)
    panel.dots(x[after], y[after], style.GREEN, size=2.0)
    panel.dots(x[saddle], y[saddle], style.VERMILION, size=3.6)
    panel.dots(x[middle], y[middle], style.BLACK, size=3.6)
    sizes = (("saddles", 46, style.VERMILION), ("leaving", 46, style.BLUE),
             ("middle", 42, style.BLACK), ("returning", 48, style.GREEN))  # fmt: skip
    _, _, at, top = panel.frame
    for text, width, hue in reversed(sizes):
        at -= width * POINT
        up = top + 9 * POINT
        panel.sheet.draw([at], [up], ls="none", marker="o", ms=3.2, color=hue, mew=0)
        panel.sheet.text(at + 4 * POINT, up, text, ha="left", va="center", size=_SIZE)


def _relation(panel, horseshoe):
    p, q = horseshoe["image_p"].values, horseshoe["image_q"].values
    square = [-1.0, 1.0, 1.0, -1.0, -1.0], [-1.0, -1.0, 1.0, 1.0, -1.0]
    panel.line(*square, color=style.BLACK, lw=1.0)
    for edge in (2, 3):
        panel.line(p[edge], q[edge], color=style.BLUE, lw=0.8)
    for edge in (0, 1):
        panel.line(p[edge], q[edge], color=style.BLUE, lw=2.0)
    for up, gap, text in ((1.0, 5.5, "the middle set"), (0.0, 6.5, "image of the set before it")):
        at = [float(a[0]) for a in panel.place(0.0, up)]
        panel.sheet.text(at[0], at[1] + gap * POINT, text, ha="center", va="center", size=_SIZE)
