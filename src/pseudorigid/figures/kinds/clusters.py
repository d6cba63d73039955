"""Clusters of impacts: flight times in the sea, and what one cluster says of the next."""

import numpy as np

from ..axes.panel import Axis, Panel, corner, key
from ..canvas import style
from ..canvas.sheet import POINT, Sheet

_LEFT, _RIGHT = 135, 1005
_MARKS = ("o", "s", "^", "D")
_ENDS = ("", "_low", "_high")


@style.pinned()
def draw(scene, clusters):
    """Return the Figure of flight times and of the memory from cluster to cluster.

    Parameters
    ----------
    scene : dict
    clusters : Dataset
        The artifact of that stage.

    Returns
    -------
    Figure
        Above: the distribution of flight times, with the cuts. Middle: correlation of x, and of y,
        at the beginning of a cluster with the same so many clusters later. Below: share of the
        variance of y there that is explained by where the earlier cluster began. Bars are 95 %
        intervals.
    """
    sheet = Sheet(style.COLUMN, 1650)
    sheet.text(_LEFT, sheet.high - 4 * POINT, style.setting(scene), ha="left", va="top", size=8.0)
    _flights(sheet, (_LEFT, 1180, _RIGHT, 1500), clusters)
    correlation = clusters["correlation"].values
    span = 0.1 * (int(10.0 * float(np.abs(correlation).max())) + 1)
    ticks = tuple(0.1 * i for i in range(-8, 9, 2) if abs(0.1 * i) <= span + 1e-9)
    up = Axis((-span, span), ticks, "Correlation of $x$ (filled), $y$ (hollow)")
    panel = _by_lag(sheet, (_LEFT, 680, _RIGHT, 1010), clusters, up, named=False)
    for i in range(2):
        rows = [clusters[f"correlation{end}"].values[..., i, i] for end in _ENDS]
        _bars(panel, clusters, rows, shift=0.04 * i, hollow=i == 1)
    panel.line([0.0, 99.0], [0.0, 0.0], color=style.BLACK, lw=0.7)
    up = Axis((0.0, 0.7), (0, 0.2, 0.4, 0.6), "Share of the variance of $y$ explained")
    panel = _by_lag(sheet, (_LEFT, 240, _RIGHT, 560), clusters, up, named=True)
    rows = [clusters[f"dependence{end}"].values[..., 1] for end in _ENDS]
    _bars(panel, clusters, rows, shift=0.0, hollow=False)
    names = [f"cut at {style.number(float(cut))}" for cut in clusters["cut"].values]
    entries = [(name, style.HUES[i], _MARKS[i % 4], False) for i, name in enumerate(names)]
    key(sheet, entries, 75, 4, _LEFT, _RIGHT - _LEFT)
    return sheet.figure


def _flights(sheet, frame, clusters):
    edges = clusters["bin_edge"].values
    share = clusters["flights"].values / clusters["flights"].values.sum()
    last = float(edges[-1])
    across = Axis((0.0, last), tuple(range(int(last) + 1)), "Time of flight")
    tall = 0.01 * (int(100.0 * float(share.max())) + 1)
    ticks = tuple(0.01 * i for i in range(round(100 * tall) + 1))
    panel = Panel(sheet, frame, across, Axis((0.0, tall), ticks, "Share of flights"), grid=False)
    corners = np.repeat(edges, 2)[1:-1]
    panel.line(corners, np.repeat(share, 2), color=style.FRAME, lw=0.8)
    for i, cut in enumerate(clusters["cut"].values):
        panel.line([cut, cut], [0.0, tall], color=style.HUES[i], lw=0.8, ls="--")
        period = f"{float(clusters['period'].values[i]):.1f}"
        panel.note(cut, (0.95 - 0.1 * i) * tall, period, shift=(2, 0))
    corner(sheet, frame, "dashes: cuts, and the mean time between clusters")


def _by_lag(sheet, frame, clusters, up, named):
    lags = clusters["lag"].values.tolist()
    across = Axis((0.6, lags[-1] + 0.5), lags, "Clusters later")
    return Panel(sheet, frame, across if named else across.blank(), up)


def _bars(panel, clusters, rows, shift, hollow):
    lags, cuts = clusters["lag"].values, clusters["cut"].values
    for i in range(cuts.size):
        at = lags + 0.12 * (i - 0.5 * (cuts.size - 1)) + shift
        panel.bars(at, rows[1][i], rows[2][i], color=style.HUES[i], lw=0.7)
        panel.dots(at, rows[0][i], style.HUES[i], hollow=hollow, marker=_MARKS[i % 4])
