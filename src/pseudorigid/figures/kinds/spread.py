"""Lyapunov exponents of many orbits: how they spread with length, and where the paper's lies."""

import numpy as np

from ...dynamics.variables import final_exponents
from ...evidence.spread import stretches
from ..axes.panel import Axis, Panel, corner, log10
from ..canvas import style
from ..canvas.sheet import POINT, Sheet

_LEFT, _RIGHT = 135, 1005
_SHORT = 200_000  # impacts of a run of Figure 7
_PAPER = 0.235
_WIDE = 0.001  # of a bar of the histogram
_LN10 = 2.302585092994046


@style.pinned()
def draw(scene, spread, lyapunov):
    """Return the Figure of exponents against length, and of the distribution of short runs.

    Parameters
    ----------
    scene : dict
    spread, lyapunov : Dataset
        The artifacts of these stages; of the second, Figure 7's, the last exponents are marked.

    Returns
    -------
    Figure
        Above: range, quartiles and mean of the largest exponent over all stretches of a length.
        Middle: the histogram of stretches as long as a run of Figure 7. Below: exponents of regular
        orbits, and ln n/n.
    """
    sheet = Sheet(style.COLUMN, 1575)
    sheet.text(_LEFT, sheet.high - 4 * POINT, style.setting(scene), ha="left", va="top", size=8.0)
    _lengths(sheet, (_LEFT, 1075, _RIGHT, 1425), spread)
    _short_runs(sheet, (_LEFT, 605, _RIGHT, 905), spread, final_exponents(lyapunov)[:, 0])
    _regular(sheet, (_LEFT, 105, _RIGHT, 435), spread)
    return sheet.figure


def _lengths(sheet, frame, spread):
    first, blocks = int(spread.attrs["block_impacts"]), spread.sizes["block"]
    lengths = [first << i for i in range((blocks - 1).bit_length())] + [first * blocks]
    low, high = len(str(lengths[0])) - 1, len(str(lengths[-1] - 1))  # whole decades around them
    across = Axis((low - 0.1, high + 0.1), tuple(range(low, high + 1)), "Length in impacts", True)
    least = float(stretches(spread, first).min())
    ticks = tuple(0.01 * (4 * i) for i in range(int(least / 0.04), 7))
    up = Axis((ticks[0], 0.27), ticks, "Largest exponent in the sea")
    panel = Panel(sheet, frame, across, up)
    panel.line([1.0, 1e30], [_PAPER] * 2, color=style.BLUE, lw=0.7, ls="--")
    panel.note(lengths[-1], _PAPER, "the paper: 0.235", ha="right", shift=(0, 5))
    for length in lengths:
        values = np.sort(stretches(spread, length))
        last = values.size - 1
        panel.line([length] * 2, values[[0, last]], color=style.VERMILION, lw=0.7)
        panel.line([length] * 2, values[[last // 4, 3 * last // 4]], color=style.VERMILION, lw=2.4)
        panel.dots([length], [values.mean()], style.BLACK, size=2.0)
    corner(sheet, frame, "thin: range, thick: quartiles, dot: mean")


def _short_runs(sheet, frame, spread, paper_runs):
    runs = stretches(spread, _SHORT)
    low, high = 0.205, 0.255
    edges = low + _WIDE * np.arange(round((high - low) / _WIDE) + 1)
    counts = np.histogram(np.clip(runs, low, high), bins=edges)[0] / runs.size
    tall = 0.02 * (int(float(counts.max()) / 0.02) + 1)
    across = Axis((low, high), (0.21, 0.22, 0.23, 0.24, 0.25), "Exponent of 200,000 impacts")
    ticks = tuple(0.04 * i for i in range(int(tall / 0.04 + 1e-9) + 1))
    panel = Panel(sheet, frame, across, Axis((0.0, tall), ticks, "Share of runs"), grid=False)
    for count, left in zip(counts[counts > 0.0], edges[:-1][counts > 0.0], strict=True):
        outline = [left, left, left + _WIDE, left + _WIDE]
        panel.line(outline, [0.0, count, count, 0.0], color=style.FRAME, lw=0.5)
    mean = float(runs.mean())
    panel.line([mean] * 2, [0.0, tall], color=style.BLACK, lw=0.9)
    panel.note(mean, tall, "mean", ha="right", va="top", shift=(-3, -4))
    panel.line([_PAPER] * 2, [0.0, tall], color=style.BLUE, lw=0.9, ls="--")
    panel.note(_PAPER, tall, "the paper", va="top", shift=(3, -4))
    panel.dots(paper_runs, [0.35 * counts.max()] * paper_runs.size, style.VERMILION, size=3.4)
    corner(sheet, frame, f"{runs.size:,} runs; dots: Figure 7's")


def _regular(sheet, frame, spread):
    keep = spread["length"].values >= 16
    n, values = spread["length"].values[keep], spread["regular_exponent"].values[keep]
    high = len(str(int(n[-1])))
    across = Axis((1.0, high), tuple(range(1, high + 1)), "Length in impacts", True)
    up = Axis((-5.0, 0.0), (-5, -4, -3, -2, -1, 0), "Largest exponent in the islands", True)
    panel = Panel(sheet, frame, across, up)
    largest = values.max(axis=-1)
    for island in range(spread.sizes["island"]):
        one = np.where(largest[:, island] > 0.0, largest[:, island], np.nan)
        panel.line(n, one, color=style.HUES[island % len(style.HUES)], lw=0.8)
    panel.line(n, _LN10 * log10(n) / n, color=style.BLACK, lw=1.0, ls="--")
    corner(sheet, frame, "one colour an orbit; dashes: $\\ln\\,n/n$")
