"""Greene's residues on either side of the last curve of the main island, and the orbits there."""

import numpy as np

from ..axes.panel import Axis, Panel, corner, key, log10
from ..axes.raster import linear, wider
from ..axes.section import NAME
from ..canvas import style
from ..canvas.sheet import Sheet

_LEFT, _RIGHT = 150, 1005
_CRITICAL = 0.25
_HUES = (*style.HUES, style.SEA)
_MOST = 9  # decades with a number each; of more, every second, third, ...


@style.pinned()
def draw(scene, last_curve):
    """Return the Figure of residues and of orbits, one hue for each sequence of convergents.

    Parameters
    ----------
    scene : dict
    last_curve : Dataset
        The artifact of that stage.

    Returns
    -------
    Figure
        Above: the residues of the convergents against their period. Below: what becomes of an orbit
        that starts at the last convergent, in the plane (x, y).
    """
    rows = -(-last_curve.sizes["noble"] // 2)  # of a key
    more = 75 * -(-48 * (rows - 1) // 75)
    sheet = Sheet(style.COLUMN, 1575 + 2 * more)
    _residues(sheet, (_LEFT, 1030 + more, _RIGHT, 1425 + more), last_curve)
    _orbits(sheet, (_LEFT, 105, _RIGHT, 760), last_curve)
    corner(sheet, (_LEFT, 105, _RIGHT, 760), style.setting(scene))
    names = [f"convergents of {number:.6f}" for number in last_curve["rotation"].values]
    _key(sheet, names, sheet.high - 29)
    periods = last_curve["period"].values[:, -1]
    _key(sheet, [f"orbit from period {period:.0f}" for period in periods], 850 + 48 * (rows - 1))
    return sheet.figure


def _key(sheet, names, top):
    entries = [(name, hue, "o", False) for name, hue in zip(names, _HUES, strict=False)]
    key(sheet, entries, top, 2, _LEFT, _RIGHT - _LEFT)


def _residues(sheet, frame, last_curve):
    periods = last_curve["period"].values
    size = np.abs(last_curve["residue"].values)
    ends = log10([periods.min(), periods.max()]) + np.array([-0.1, 0.1])
    across = Axis(tuple(ends.tolist()), _whole(*ends), "Period", True)
    limits = tuple(np.floor(log10([size.min(), 10.0 * size.max()])).tolist())
    up = Axis(limits, _whole(*limits), "Residue, its modulus", True)
    panel = Panel(sheet, frame, across, up)
    panel.line([1.0, 1e6], [_CRITICAL] * 2, color=style.BLACK, lw=0.7, ls="--")
    for i in range(periods.shape[0]):
        panel.line(periods[i], size[i], color=_HUES[i], lw=0.9)
        above = last_curve["residue"].values[i] > 0.0
        panel.dots(periods[i][above], size[i][above], _HUES[i])
        panel.dots(periods[i][~above], size[i][~above], _HUES[i], hollow=True)
    panel.note(periods.max(), _CRITICAL, "critical: 1/4", shift=(0, 5), ha="right")
    corner(sheet, frame, "hollow: negative")


def _whole(low, high):
    every = 1 + int(high - low) // _MOST
    return tuple(range(int(np.ceil(low / every)) * every, int(np.floor(high)) + 1, every))


def _orbits(sheet, frame, last_curve):
    x, y = last_curve["x"].values, last_curve["y"].values
    across, up = (
        linear(*wider(values.min(), values.max(), 0.04, 0.04), 6, name)
        for values, name in ((x, "$x$"), (y, NAME))
    )
    panel = Panel(sheet, frame, across, up, grid=False)
    for i in reversed(range(x.shape[0])):
        panel.dots(x[i], y[i], _HUES[i], size=0.9)
