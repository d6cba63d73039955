"""The regions that a hyperbolic orbit's branches close in, and the lobes of the sea's passage."""

import numpy as np

from ...dynamics.ball import Ball
from ..axes.panel import Panel, corner, key
from ..axes.raster import linear, wider
from ..axes.section import NAME, Section
from ..canvas import style
from ..canvas.sheet import POINT, Sheet

_LEFT, _WIDE = 150, 825  # pixels
_INNER, _OUTER = style.PURPLE, style.ORANGE


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
        ("edge of the inner region", _INNER, "", False),
        ("edge of the outer region", _OUTER, "", False),
        ("grazing rim", style.BLACK, "", False),
        ("crossing, and its lobe's area", style.FRAME, "o", False),
    ]
    key(sheet, entries, top - _WIDE - 130, 2, _LEFT + 10, _WIDE)
    entries = [
        ("stable branch", style.STABLE, "", False),
        ("unstable branch", style.UNSTABLE, "", False),
    ]
    key(sheet, entries, 568, 2, _LEFT + 10, _WIDE)
    panels = (
        (_outer_lobe, (_LEFT, 105, 505, 405), "Outer branches at the crossing"),
        (_inner_lobe, (680, 105, 1005, 405), "Inner: unstable less stable"),
    )
    for draw_lobe, panel, title in panels:
        draw_lobe(sheet, panel, flux)
        up = panel[3] + 18 * POINT
        sheet.text(panel[0], up, title, ha="left", va="bottom", size=7.0)
    return sheet.figure


def _regions(sheet, frame, flux):
    k, g, energy = (float(flux.attrs[name]) for name in ("k", "g", "energy"))
    radius = Ball(k, g).section(energy)[1]
    panel = Section(sheet, frame, flux.attrs, radius, 1.06, 5, ("$x$", NAME))
    panel.rim()
    for side, hue in ((1, _OUTER), (0, _INNER)):
        x, y = flux["outline_x"].values[side], flux["outline_y"].values[side]
        if np.isnan(x[0]):
            continue
        panel.line(x, y, color=hue, lw=1.1)
        digits, _, power = f"{float(flux['area'].values[side]):.3e}".partition("e")
        text = rf"area ${digits}\times 10^{{{int(power)}}}$"
        at = float(flux["crossing_x"].values[side].max())
        shift = (4.0, 0.0) if side else (-4.0, 0.0)
        panel.note(at, 0.0, text, ha="left" if side else "right", shift=shift)
        panel.dots([at], [0.0], hue)


def _no_lobe(sheet, frame):
    """Say in the place of a panel that the branches of a side close no lobe."""
    middle = 0.5 * (frame[0] + frame[2]), 0.5 * (frame[1] + frame[3])
    sheet.text(*middle, "no lobe is closed", ha="center", va="center", size=7.0)


def _outer_lobe(sheet, frame, flux):
    x, y = flux["branch_x"].values[1], flux["branch_y"].values[1]
    if np.isnan(x[0]):
        _no_lobe(sheet, frame)
        return
    high = np.abs(y).max()
    across = linear(*wider(x.min(), x.max(), 0.06, 0.06), 3, "$x$")
    up = linear(*wider(-high, high, 0.06, 0.06), 5, "$y$")
    panel = Panel(sheet, frame, across, up)
    panel.line(x, -y, color=style.STABLE, lw=1.0)
    panel.line(x, y, color=style.UNSTABLE, lw=1.0)


def _inner_lobe(sheet, frame, flux):
    x, y = flux["branch_x"].values[0], flux["branch_y"].values[0]
    if np.isnan(x[0]):
        _no_lobe(sheet, frame)
        return
    order = np.argsort(y, kind="stable")
    half = float(min(y.max(), -y.min()))
    at = half * (np.arange(-200, 201) / 200.0)
    apart = np.interp(at, y[order], x[order]) - np.interp(-at, y[order], x[order])
    power = int(f"{float(np.abs(apart).max()):e}".partition("e")[2])
    apart = apart / float(f"1e{power}")
    most = 1.1 * float(np.abs(apart).max())
    up = linear(-most, most, 5, rf"Difference of $x$ / $10^{{{power}}}$")
    panel = Panel(sheet, frame, linear(-half, half, 3, "$y$"), up)
    panel.line([-half, half], [0.0, 0.0], color=style.STABLE, lw=1.0)
    panel.line(at, apart, color=style.UNSTABLE, lw=1.0)
