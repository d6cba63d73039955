"""Lyapunov exponents of many orbits: how they spread with length, and where the paper's lies."""

import numpy as np
import xarray as xr

from pseudorigid.dynamics.variables import final_exponents
from pseudorigid.figures.axes.limits import decades, of_data
from pseudorigid.figures.axes.panel import Axis, Panel, corner, letters, log10
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import POINT, Sheet

from ..analyses.stretches import stretches
from . import Figure, Frame, Scene

_LEFT, _RIGHT = 135, 1005  # pixels
_BAR = 0.001  # width of a bar of the histogram in the paper's case
_LONGEST = 3.0  # distances of the quartiles, below the lower one, that an axis shows
_LN10 = 2.302585092994046


@style.pinned()
def draw(scene: Scene, spread: xr.Dataset, lyapunov: xr.Dataset) -> Figure:
    """Draw exponents against length, their spread, short runs, and regular orbits."""
    sheet = Sheet(style.COLUMN, 2025)
    sheet.text(_LEFT, sheet.high - 4 * POINT, style.setting(scene), ha="left", va="top", size=8.0)
    rows = (1525, 1875), (1075, 1355), (605, 905), (112, 435)
    frames: list[Frame] = [(_LEFT, low, _RIGHT, high) for low, high in rows]
    letters(sheet, *frames)
    _lengths(sheet, frames[0], spread)
    _spread(sheet, frames[1], spread)
    _short_runs(sheet, frames[2], spread, lyapunov)
    _regular(sheet, frames[3], spread)
    return sheet.figure


def _across(lengths: list[int]) -> Axis:
    """Return an axis of lengths with whole decades around them."""
    low, high = len(str(lengths[0])) - 1, len(str(lengths[-1] - 1))
    return decades((low - 0.1, high + 0.1), "Length in impacts")


def _without_tail(values: np.ndarray) -> np.ndarray:
    """Return values of which those far below the lower quartile are raised to _LONGEST below it."""
    values = np.sort(values)
    low, high = values[values.size // 4], values[3 * (values.size - 1) // 4]
    return np.clip(values, low - _LONGEST * (high - low), None)


def _lengths(sheet: Sheet, frame: Frame, spread: xr.Dataset) -> None:
    """Draw range, quartiles and mean against the length; a triangle if the range is cut off."""
    lengths = spread["run"].values.tolist()
    axis = of_data(_without_tail(stretches(spread, lengths[0])))
    up = Axis(axis["limits"], axis["ticks"], "Largest exponent in the sea")
    panel = Panel(sheet, frame, _across(lengths), up)
    if printed := spread.attrs.get("printed_exponent"):
        panel.line([1.0, 1e30], [printed] * 2, color=style.BLUE, lw=0.7, ls="--")
        panel.note(lengths[-1], printed, f"the paper: {printed}", ha="right", shift=(0, 5))
    for length in lengths:
        values = np.sort(stretches(spread, length))
        last = values.size - 1
        panel.line([length] * 2, values[[0, last]], color=style.VERMILION, lw=0.7)
        if values[0] < axis["limits"][0]:
            panel.dots([length], values[:1], style.VERMILION, marker="v")
        panel.line([length] * 2, values[[last // 4, 3 * last // 4]], color=style.VERMILION, lw=2.4)
        panel.dots([length], [values.mean()], style.BLACK, size=2.0)
    corner(sheet, frame, "thin: range, thick: quartiles, dot: mean")


def _spread(sheet: Sheet, frame: Frame, spread: xr.Dataset) -> None:
    """Draw the standard deviation of runs times the square root of their length n."""
    lengths, root = spread["run"].values, np.sqrt(spread["run"].values)
    scaled, error = root * spread["deviation"].values, root * spread["deviation_error"].values
    ends = scaled + np.array([-1.0, 1.0])[:, None] * np.where(np.isnan(error), 0.0, error)
    axis = of_data(ends, most=5)
    up = Axis(axis["limits"], axis["ticks"], r"Their standard deviation times $\sqrt{n}$")
    panel = Panel(sheet, frame, _across(lengths.tolist()), up)
    panel.line([1.0, 1e30], [scaled[0]] * 2, color=style.BLACK, lw=1.0, ls="--")
    panel.bars(lengths, *ends, color=style.VERMILION, lw=1.0)
    panel.dots(lengths, scaled, style.VERMILION, size=2.4)
    corner(sheet, frame, "dashes: falls like $n^{-1/2}$")


def _short_runs(sheet: Sheet, frame: Frame, spread: xr.Dataset, lyapunov: xr.Dataset) -> None:
    """Draw the histogram of short runs, with their mean and the marked orbits."""
    marked = final_exponents(lyapunov)[:, 0]
    block, blocks = int(spread.attrs["block_impacts"]), spread.sizes["block"]
    # Runs are as long as those of the marked orbits, as far as blocks allow.
    short = block * min(max(int(lyapunov["impact"].values[-1]) // block, 1), blocks)
    runs = stretches(spread, short)
    printed = spread.attrs.get("printed_exponent") if short == 200_000 else None
    axis = of_data(_without_tail(runs), marked)
    low, high = axis["limits"]
    bar = _BAR if printed else (high - low) / 50
    edges = low + bar * np.arange(round((high - low) / bar) + 1)
    share = np.histogram(np.clip(runs, low, high), bins=edges)[0] / runs.size
    room = 1.2  # for the names of the lines
    highest = 0.02 * (int(room * float(share.max()) / 0.02) + 1)
    across = Axis(axis["limits"], axis["ticks"], f"Exponent of {short:,} impacts")
    step = 0.04 if highest <= 0.24 else 0.1 if highest <= 0.6 else 0.2
    ticks = tuple(step * i for i in range(int(highest / step + 1e-9) + 1))
    panel = Panel(sheet, frame, across, Axis((0.0, highest), ticks, "Share of runs"), grid=False)
    for height, left in zip(share[share > 0.0], edges[:-1][share > 0.0], strict=True):
        outline = [left, left, left + bar, left + bar]
        panel.line(outline, [0.0, height, height, 0.0], color=style.FRAME, lw=0.5)
    mean = float(runs.mean())
    panel.line([mean] * 2, [0.0, highest], color=style.BLACK, lw=0.9)
    panel.note(mean, highest, "mean", ha="right", va="top", shift=(-3, -4))
    if printed:
        panel.line([printed] * 2, [0.0, highest], color=style.BLUE, lw=0.9, ls="--")
        panel.note(printed, highest, "the paper", va="top", shift=(3, -4))
    panel.dots(marked, [0.35 * share.max()] * marked.size, style.VERMILION, size=3.4)
    orbits = "Figure 7's" if printed else "orbits from starts"
    corner(sheet, frame, f"{runs.size:,} runs; dots: {orbits}")


def _regular(sheet: Sheet, frame: Frame, spread: xr.Dataset) -> None:
    """Draw the exponents of the orbits that should be regular against their length."""
    long = spread["length"].values >= 16
    n, values = spread["length"].values[long], spread["regular_exponent"].values[long]
    across = decades((1, len(str(int(n[-1])))), "Length in impacts")
    largest = values.max(axis=-1)
    types = spread["regular_type"].values
    chaotic = types != "regular"
    lowest = log10(np.append(largest[largest > 0.0], _LN10 * log10(n[-1]) / n[-1])).min()
    lowest = min(-5, int(np.floor(lowest)))
    highest = max(0, int(np.ceil(log10(max(float(largest.max()), 1e-5))[0])))
    name = "Largest exponent" if chaotic.any() else "Largest exponent in the islands"
    up = decades((lowest, highest), name)
    panel = Panel(sheet, frame, across, up)
    for island in range(spread.sizes["island"]):
        positive = np.where(largest[:, island] > 0.0, largest[:, island], np.nan)
        hue, dashes = (style.SEA, "-.") if chaotic[island] else (style.BLUE, "-")
        panel.line(n, positive, color=hue, lw=0.8, ls=dashes)
    panel.line(n, _LN10 * log10(n) / n, color=style.BLACK, lw=1.0, ls="--")
    grey = f"grey: {' and '.join(sorted({*types[chaotic]}))}; " if chaotic.any() else ""
    corner(sheet, frame, f"{grey}dashes: $\\ln\\,n/n$")
