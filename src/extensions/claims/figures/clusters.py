"""Clusters of impacts: flight times in the sea, and correlations between clusters."""

from dataclasses import replace

import numpy as np
import xarray as xr

from pseudorigid.figures.axes.limits import linear, ticks
from pseudorigid.figures.axes.panel import Axis, Panel, corner, key, letters
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import POINT, Sheet, width

from . import Figure, Frame, Scene

_LEFT, _RIGHT = 135, 1005  # pixels
_COLUMNS = (1, 135, 540), (0, 600, 1005)  # index in _NAMES, left and right of a column of panels
_LOWER = 240  # pixels: bottom of the lowest panels
_NAMES = "$x$", "$y$"
_MARKS = ("o", "s", "^", "D")
_ROOM = 1.1  # upper end of an axis, in units of the largest number
_LABEL = 0.07  # room of a cut's label, in units of the longest flight


@style.pinned()
def draw(scene: Scene, clusters: xr.Dataset) -> Figure:
    """Draw flight times, and the correlation and dependence between clusters against their lag."""
    sheet = Sheet(style.COLUMN, 1650)
    sheet.text(_LEFT, sheet.high - 4 * POINT, style.setting(scene), ha="left", va="top", size=8.0)
    frames = [(_LEFT, 1180, _RIGHT, 1500)]
    frames += [
        (a, low, b, high) for low, high in ((680, 1010), (_LOWER, 560)) for _, a, b in _COLUMNS
    ]
    letters(sheet, *frames)
    _flights(sheet, frames[0], clusters)
    correlations = [clusters[f"correlation{end}"].values for end in ("", "_low", "_high")]
    span = 0.1 * (int(_ROOM * 10.0 * float(np.abs(correlations).max())) + 1)
    shares = [clusters[f"dependence{end}"].values for end in ("", "_low", "_high")]
    most = max(np.ceil(_ROOM * 10.0 * float(np.max(shares))), 7.0) / 10.0
    for column, (i, *_) in enumerate(_COLUMNS):
        up = linear(-span, span, 9, f"Correlation of {_NAMES[i]}")
        panel = _panel_by_lag(sheet, frames[1 + column], clusters, up)
        panel.line(panel.across.limits, [0.0, 0.0], color=style.BLACK, lw=0.7)
        _marks(panel, clusters, [values[..., i, i] for values in correlations])
        name = f"Variance of {_NAMES[i]} explained"
        up = linear(min(0.0, _ROOM * float(np.min(shares))), most, 5, name)
        panel = _panel_by_lag(sheet, frames[3 + column], clusters, up)
        _marks(panel, clusters, [values[..., i] for values in shares])
    hues = style.ordered(clusters.sizes["cut"])
    entries = [
        (f"cut at {style.number(float(cut))}", hues[i], _MARKS[i % 4])
        for i, cut in enumerate(clusters["cut"].values)
    ]
    key(sheet, entries, 85, 4, _LEFT, _RIGHT - _LEFT)
    return sheet.figure


def _flights(sheet: Sheet, frame: Frame, clusters: xr.Dataset) -> None:
    """Draw the histogram of flight times with the cuts."""
    edges = clusters["bin_edge"].values
    share = clusters["flights"].values / clusters["flights"].values.sum()
    last = float(edges[-1])
    across = linear(0.0, last, 10, "Time of flight")
    highest = 0.01 * (int(100.0 * float(share.max())) + 1)
    panel = Panel(sheet, frame, across, linear(0.0, highest, 6, "Share of flights"), grid=False)
    corners = np.repeat(edges, 2)[1:-1]
    panel.line(corners, np.repeat(share, 2), color=style.FRAME, lw=0.8)
    cuts = clusters["cut"].values
    hues = style.ordered(cuts.size)
    ends = np.array([0.0, *cuts, last])  # of the room for labels
    for i, cut in enumerate(cuts):
        panel.line([cut, cut], [0.0, highest], color=hues[i], lw=0.8, ls="--")
        period = f"{float(clusters['period'].values[i]):.1f}"
        left, right = cut - ends[ends < cut].max(), ends[ends > cut].min() - cut
        crowded = right < min(left, _LABEL * last)
        side, shift = ("right", -2) if crowded else ("left", 2)
        panel.note(cut, (0.95 - 0.1 * i) * highest, period, (shift, 0), side)
    corner(sheet, frame, "dashes: cuts, and the mean time between clusters")


def _panel_by_lag(sheet: Sheet, frame: Frame, clusters: xr.Dataset, up: Axis) -> Panel:
    """Return a panel against the lag, labelled at the left and at the bottom of the sheet only."""
    last = int(clusters["lag"].values[-1])
    if frame[0] != _LEFT:
        up = replace(up, labels=[""] * len(up.ticks))
    lags = [lag for lag in ticks(0.0, last, 9) if lag >= 1.0 and lag.is_integer()]
    across = Axis((0.6, last + 0.5), lags, "Clusters later")
    return Panel(sheet, frame, across if frame[1] == _LOWER else across.blank(), up)


def _marks(panel: Panel, clusters: xr.Dataset, estimates: list[np.ndarray]) -> None:
    """Draw a mark with its interval at each lag, joined for each cut, from (value, low, high)."""
    value, low, high = estimates
    lags, cuts = clusters["lag"].values, clusters["cut"].values
    for i, hue in enumerate(style.ordered(cuts.size)):
        panel.line(lags, value[i], color=hue, lw=0.4)
        panel.bars(lags, low[i], high[i], color=hue, lw=0.7)
        panel.dots(lags, value[i], hue, size=3.2, marker=_MARKS[i % 4])
    widest = 0.5 * float((high - low).max())
    _, bottom, right, top = panel.frame
    text = f"95 %: at most \N{PLUS-MINUS SIGN}{widest:.3f}"
    at = np.linspace(1.0, lags[-1], 100)
    x, y = panel.place(np.tile(at, (len(high), 1)), [np.interp(at, lags, line) for line in high])
    taken = (x > right - 12 * POINT - width(text, 7.0)) & (y > top - 10 * POINT)
    place, va = (bottom + 3 * POINT, "bottom") if taken.any() else (top - 3 * POINT, "top")
    panel.sheet.text(right - 3 * POINT, place, text, ha="right", va=va, size=7.0)
