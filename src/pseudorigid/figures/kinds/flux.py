"""The regions that a hyperbolic orbit's branches close in, and the lobes of the sea's passage."""

import numpy as np

from ...analyses.flux import SIDES
from ...dynamics.ball import Ball
from ..axes.panel import Panel, corner, key, vacant
from ..axes.raster import linear, wider
from ..axes.section import NAME, Section
from ..canvas import style
from ..canvas.sheet import POINT, Sheet, width

_LEFT, _WIDE = 150, 825  # pixels
_INNER, _OUTER = style.PURPLE, style.ORANGE
_SEEN = 2.0  # times what straight sides miss of the line: a smaller difference is theirs


@style.pinned()
def draw(scene, flux):
    """Return the Figure of regions and lobes.

    Parameters
    ----------
    scene : dict
    flux : Dataset
        The artifact of that stage.

    Returns
    -------
    Figure
        Above: the section with both regions, whose edges are pieces of unstable and stable
        branches, and the crossings of these on y = 0. Below, left: the outer branches near theirs,
        where they close in two lobes of one area. Below, right: how far the inner unstable branch
        lies from the stable one near theirs, since both are one line to the eye.
    """
    sheet = Sheet(style.COLUMN, 1725)
    top = sheet.high - 75
    above = _LEFT, top - _WIDE, _LEFT + _WIDE, top
    _regions(sheet, above, flux)
    corner(sheet, above, style.setting(scene))
    entries = [
        (_edge(flux, 0), _INNER, "", False),
        (_edge(flux, 1), _OUTER, "", False),
        ("grazing rim", style.BLACK, "", False),
        ("crossing, and its lobe's area", style.FRAME, "o", False),
    ]
    key(sheet, entries, top - _WIDE - 130, 2, _LEFT + 10, _WIDE)
    entries = [
        ("stable branch", style.STABLE, "", False),
        ("unstable branch", style.UNSTABLE, "", False),
    ]
    key(sheet, entries, 568, 2, _LEFT + 10, _WIDE)
    for side, panel in ((1, (_LEFT, 105, 505, 405)), (0, (680, 105, 1005, 405))):
        title = _lobe(
            sheet, panel, side, flux["branch_x"].values[side], flux["branch_y"].values[side]
        )
        up = panel[3] + 18 * POINT
        sheet.text(panel[0], up, title, ha="left", va="bottom", size=7.0)
    return sheet.figure


def _edge(flux, side):
    """The name of a region's edge, or why there is none."""
    name = SIDES[side]
    if np.isnan(flux["area"].values[side]):
        return f"{name} region: none"
    cut = np.isnan(flux["region"].values[side])
    return f"{name} edge: cut by a jump" if cut else f"edge of the {name} region"


def _regions(sheet, frame, flux):
    k, g, energy = (float(flux.attrs[name]) for name in ("k", "g", "energy"))
    radius = Ball(k, g).section(energy)[1]
    panel = Section(sheet, frame, flux.attrs, radius, 1.06, 5, ("$x$", NAME))
    panel.rim()
    for side, hue in ((1, _OUTER), (0, _INNER)):
        if np.isnan(flux["area"].values[side]):
            continue
        x, y = flux["outline_x"].values[side], flux["outline_y"].values[side]
        panel.line(x, y, color=hue, lw=1.1)
        digits, _, power = f"{float(flux['area'].values[side]):.3e}".partition("e")
        text = rf"area ${digits}\times 10^{{{int(power)}}}$"
        at = float(flux["crossing_x"].values[side].max())
        panel.dots([at], [0.0], hue)
        left = panel.centre - radius if np.isnan(x[0]) else x.min()
        ends = [left, panel.centre + radius]
        (end, dot), _ = panel.place([ends[side], at], [0.0, 0.0])
        if abs(end - dot) > width(text, panel.small) + 8.0 * POINT:
            shift = (4.0, 0.0) if side else (-4.0, 0.0)
            panel.note(at, 0.0, text, ha="left" if side else "right", shift=shift)
        else:  # no room inside the rim, or the region: outside, in a corner
            place = (
                frame[2 if side else 0] + (-3.0 if side else 3.0) * POINT,
                frame[3] - 3.0 * POINT,
            )
            ha = "right" if side else "left"
            sheet.text(*place, f"{SIDES[side]}: {text}", ha=ha, va="top", size=panel.small)


def _lobe(sheet, frame, side, x, y):
    """Draw the branches at their crossing, or how far they are apart, and return what that is."""
    if np.isnan(x[0]):
        vacant(sheet, frame, "no lobe is closed")
    elif side == 0 and (np.all(np.diff(y) >= 0.0) or np.all(np.diff(y) <= 0.0)):
        _difference(sheet, frame, x, y)
        return "Inner: unstable less stable"
    else:
        _both(sheet, frame, x, y)
    return f"{SIDES[side].title()} branches at the crossing"


def _both(sheet, frame, x, y):
    high = np.abs(y).max()
    across = linear(*wider(x.min(), x.max(), 0.06, 0.06), 3, "$x$")
    up = linear(*wider(-high, high, 0.06, 0.06), 5, "$y$")
    panel = Panel(sheet, frame, across, up)
    panel.line(x, -y, color=style.STABLE, lw=1.0)
    panel.line(x, y, color=style.UNSTABLE, lw=1.0)


def _difference(sheet, frame, x, y):
    y, order = np.unique(y, return_index=True)
    x = x[order]
    half = float(min(y.max(), -y.min()))
    at = half * (np.arange(-200, 201) / 200.0)
    apart = np.interp(at, y, x) - np.interp(-at, y, x)
    # a side misses a smooth line by a quarter of what a side twice as long does
    missed = 0.25 * np.abs(x[1:-1] - np.interp(y[1:-1], y[::2], x[::2])).max()
    if float(np.abs(apart).max()) < _SEEN * missed:
        vacant(sheet, frame, "too small for lines this coarse")
        return
    power = int(f"{float(np.abs(apart).max()):e}".partition("e")[2])
    apart = apart / float(f"1e{power}")
    most = 1.1 * float(np.abs(apart).max())
    up = linear(-most, most, 5, rf"Difference of $x$ / $10^{{{power}}}$")
    panel = Panel(sheet, frame, linear(-half, half, 3, "$y$"), up)
    panel.line([-half, half], [0.0, 0.0], color=style.STABLE, lw=1.0)
    panel.line(at, apart, color=style.UNSTABLE, lw=1.0)
