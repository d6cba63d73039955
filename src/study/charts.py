"""The charts of the study: work and precision, where methods fail, and what each figure needs."""

import math
import re
from collections.abc import Iterable, Sequence
from functools import partial
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from pseudorigid.figures.axes.limits import decades
from pseudorigid.figures.axes.panel import Axis, Frame, Panel, corner, key, letters, title
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import POINT, Sheet

# Colour and mark of each family of methods, or of a method in charts that draw one family's
# methods apart; similar methods have similar colours.
STYLES = {
    "certified march": (style.VERMILION, "o"),
    "scan 0.5 + bisection": (style.SKY, "o"),
    "scan 0.2 + bisection": ("#3d94d4", "o"),
    "scan 0.1 + bisection": (style.BLUE, "o"),
    "scan 0.05 + bisection": ("#1d5a9b", "o"),
    "scan 0.02 + bisection": ("#123f78", "o"),
    "scan 0.01 + bisection": ("#0b2a55", "o"),
    "time stepping": (style.ORANGE, "o"),
    "scan 0.1 + brentq": (style.BLUE, "s"),
    "RK45": ("#6b6b6b", "v"),
    "DOP853": (style.BLACK, "^"),
    "DOP853, steps <= 0.1": (style.BLACK, "D"),
    "LSODA": ("#6b6b6b", "s"),
    "Radau": ("#a0a0a0", "D"),
    "heyoka, any direction": (style.PURPLE, "^"),
    "heyoka, positive direction": (style.GREEN, "^"),
    "scan 0.1, 1e-03": ("#ecc3da", "o"),
    "scan 0.1, 1e-06": (style.PURPLE, "o"),
    "scan 0.1, 1e-09": ("#8f4772", "o"),
    "engine 1e-03": ("#a86f00", "o"),
}
LEFT, RIGHT = 150, 1010  # pixels: ends of the frames
_ZERO_DECADE = -18  # at which zeros are drawn, below errors of a double, which are above 1e-17
_MAX_WRONG_SHARE = 0.01  # of roots; above it the worst right root is as wrong as right roots may be
_COSTS = {"evaluations": (0, 5), "seconds": (-8, -1)}  # decades
_MOST_FLAT_SHARE = 0.02  # share below which a panel has room for the key
_NEAR, _RIM = 4, 1.6  # pixels between marks that hide each other; points a hidden one is larger by
_BREAK_STROKES = (-5, 9, style.FRAME, 0.6), (5, 9, style.FRAME, 0.6)  # of a break of an axis
_KEY_COLUMNS, _KEY_LINE = 3, 42  # of a key; pixels: height of its lines
Entry = tuple[str, str, str]  # of a key: text, colour and mark
Scene = dict[str, Any]  # a block of the checked config
method_key = partial(key, columns=_KEY_COLUMNS, size=7.0)


class AxisWithZero(Axis):
    """An axis of decades whose lower end stands for zero and for all that is less than it."""

    def fraction(self, values: ArrayLike) -> np.ndarray:
        """Return where values lie between the limits, 0 to 1."""
        return super().fraction(np.maximum(values, float(f"1e{self.limits[0]}")))


class PanelWithZeros(Panel):
    """A panel that marks the gap between zero and the powers of ten on an axis that has both."""

    def __init__(self, sheet: Sheet, frame: Frame, across: Axis, up: Axis) -> None:
        super().__init__(sheet, frame, across, up)
        left, bottom, *_ = frame
        for axis, start, level in ((across, left, bottom), (up, bottom, left)):
            if not isinstance(axis, AxisWithZero):
                continue
            for shift, rise, color, points in ((0, 0, "white", 1.6), *_BREAK_STROKES):
                along = [start + 30 + shift + end for end in (-5, 5)]
                off = [level - rise, level + rise]
                ends = (along, off) if axis is across else (off, along)
                sheet.draw(*ends, color=color, lw=points, zorder=3.5)


@style.pinned()
def work(scene: Scene, data: xr.Dataset) -> Figure:
    """Draw a work-precision diagram for one set of states: error and failures against cost.

    Filled marks and full lines are the median error. Hollow marks and dashed lines are the worst of
    the right roots, if at most one root in a hundred is wrong. Below is the share of wrong roots.
    Marks that others would hide are larger.
    """
    which, cost = ("uniform", "grazing").index(scene["states"]), scene["cost"]
    data, families = data.isel(set=which), list(dict.fromkeys(data["family"].values))
    entries, wrong = _entries(families, families), data["wrong"].values
    sheet, top = chart_sheet(1030, entries)
    across = decades(_COSTS[cost], f"{cost.capitalize()} a flight")
    error = _error_axis(_ZERO_DECADE, 0, "Relative error of the flight time")
    upper = PanelWithZeros(sheet, (LEFT, top - 560, RIGHT, top), across.blank(), error)
    shares = (0, 0.2, 0.4, 0.6) if wrong.max() > 0.1 else (0, 0.05, 0.1)
    share = Axis((0.0, shares[-1]), shares, "Share of wrong roots")
    lower = Panel(sheet, (LEFT, top - 830, RIGHT, top - 630), across, share)
    letters(sheet, upper.frame, lower.frame)
    if (wrong <= _MAX_WRONG_SHARE).any():
        corner(sheet, upper.frame, "hollow: worst right root")
    x, wrong, median, worst = (data[n].values for n in (cost, "wrong", "median", "worst"))
    worst = np.where(wrong <= _MAX_WRONG_SHARE, worst, np.nan)
    of = np.array([families.index(family) for family in data["family"].values])
    marks = (upper, worst, True), (upper, median, False), (lower, wrong, False)
    of = np.array([families.index(family) for family in data["family"].values])
    sizes = [_sizes(panel, of, x, y) for panel, y, _ in marks]
    for i, (_, color, marker) in enumerate(entries):
        own, good = of == i, (of == i) & np.isfinite(worst)
        upper.line(x[own], median[own], color=color, lw=0.9)
        upper.line(x[good], worst[good], color=color, lw=0.5, ls="--")
        lower.line(x[own], wrong[own], color=color, lw=0.9)
        for (panel, y, hollow), size in zip(marks, sizes, strict=True):
            for points in np.unique(size[own]):
                at = own & (size == points) & np.isfinite(y)
                panel.dots(x[at], y[at], color, points, hollow=hollow, marker=marker)
    method_key(sheet, entries, top - 965)
    return sheet.figure


@style.pinned()
def edges(scene: Scene, data: xr.Dataset) -> Figure:
    """Draw the failing share against the distance from grazing, and the height of a maximum.

    A ball that grazes at x > -g comes back at once, at x < -g it leaves. The key stands in a panel
    in which no method fails, if there is one. Methods whose marks coincide take turns in front.
    """
    methods = _entries(data["name"].values, data["family"].values)
    flat = [
        (v, s) for v in ("near", "touch") for s in (0, 1) if data[v][:, s].max() <= _MOST_FLAT_SHARE
    ][:1]
    sheet, top = chart_sheet(1075 if flat else 1100 + _KEY_LINE * len(methods))
    gap, frames = 40, []
    wide = (RIGHT - LEFT - gap) / 2
    height = "Height of the gap's maximum, + or −"
    rows = (
        ("near", "distance", ("$x > -g$", "$x < -g$"), r"$\dot{x}^-+\dot{u}^-$", (-12, 0)),
        ("touch", "depth", ("it just touches", "it just misses"), height, (-14, -2)),
    )
    for row, (variable, exponent, sides, name, limits) in enumerate(rows):
        x = [float(f"1e-{n}") for n in data[exponent].values]
        across = Axis(limits, range(*limits, 4), "", True)
        for side, text in enumerate(sides):
            left, high = LEFT + side * (wide + gap), top - row * 540
            up = Axis((0, 1), (0, 0.5, 1), labels=("", "", "") if side else None)
            frames.append((left, high - 360, left + wide, high))
            panel = Panel(sheet, frames[-1], across, up, grid=(variable, side) not in flat)
            if side:
                middle = left - gap / 2, high - 360 - 16 * POINT
                sheet.text(*middle, name, ha="center", va="top", size=8.0)
            title(sheet, frames[-1], text if side else f"Share failing, {text}", size=8.0)
            shares = data[variable].values[:, side]
            for (_, color, _), share in zip(methods, shares, strict=True):
                panel.line(x, share, color=color, lw=0.9)
            for column, at in enumerate(x):  # methods that coincide take turns in front
                for i in np.roll(np.arange(len(methods)), column).tolist():
                    _, color, marker = methods[i]
                    panel.dots(at, shares[i, column], color, size=2.6, marker=marker)
            if (variable, side) in flat:
                method_key(sheet, methods, high - 30, columns=1, left=left + 30)
    letters(sheet, *frames)
    if not flat:
        method_key(sheet, methods, top - 1040, columns=1)
    return sheet.figure


@style.pinned()
def energy(scene: Scene, data: xr.Dataset) -> Figure:
    """Draw the energy drift of each method, and the impacts missed against the last drift.

    In the shaded part the energy is kept to 1e-6, so that a check sees nothing.
    """
    entries = _methods_with_merged_scans(data)
    named = list(dict.fromkeys(entries))
    sheet, top = chart_sheet(1135, named)
    drift = _error_axis(_ZERO_DECADE, 1, "Largest relative error of the energy so far")
    upper = PanelWithZeros(sheet, (LEFT, top - 430, RIGHT, top), decades((0, 6), "Impacts"), drift)
    across = decades((-13, 1), "Largest relative error of the energy after all impacts")
    powers = ["0", *(rf"$10^{e}$" for e in range(5))]
    up = AxisWithZero((-1, 4), range(-1, 5), "Impacts missed in a million", True, powers)
    lower = PanelWithZeros(sheet, (LEFT, top - 940, RIGHT, top - 600), across, up)
    letters(sheet, upper.frame, lower.frame)
    shaded, _ = lower.place([1e-13, 1e-6], 1.0)
    wide = (shaded[1] - shaded[0]) / POINT
    lower.line([10**-9.5] * 2, [0.1, 1e4], lw=wide, color="#fbeedd", zorder=0.1)
    for i, (_, color, marker) in enumerate(entries):
        drift = data["drift"].values[i]
        upper.line(data["record"].values, drift, color=color, lw=0.9)
        end = drift[-1], float(data["missed"].values[i])
        lower.dots(*end, color, marker=marker)
        if entries.count(entries[i]) > 1:
            lower.note(*end, _scan_step(data["name"].values[i]), shift=(3, 3.5))
    lower.note(1.5e-13, 3e3, "a check to $10^{-6}$ sees nothing")
    method_key(sheet, named, top - 1075)
    return sheet.figure


@style.pinned()
def separation(scene: Scene, data: xr.Dataset) -> Figure:
    """Draw the distance of each method's orbit from the proved one, from `stages.drift`."""
    sheet, top = chart_sheet(975)
    across = Axis((0, 170), (0, 50, 100, 150), "Impacts")
    up = _error_axis(_ZERO_DECADE, 0, "Median distance in $x$ from the proved orbit")
    panel = PanelWithZeros(sheet, (LEFT, top - 600, RIGHT, top), across, up)
    entries = _methods_with_merged_scans(data)
    for (_, color, _), distance in zip(entries, data["apart"].values, strict=True):
        panel.line(data["impact"].values, distance, color=color, lw=0.9)
    method_key(sheet, [entry[:2] for entry in dict.fromkeys(entries)], top - 740)
    return sheet.figure


@style.pinned()
def figure_errors(scene: Scene, data: xr.Dataset) -> Figure:
    """Draw the error of each figure by each method in units of the largest invisible error.

    Hollow marks are methods that missed impacts. At the right are the evaluations an impact of the
    two cheapest methods that suffice.
    """
    scenes, families = data.sizes["scene"], data["family"].values
    sheet = Sheet(style.COLUMN, 75 * (4 + scenes))
    top, bottom = sheet.high - 75, sheet.high - 75 * (1 + scenes)
    middles = [scenes - 0.5 - i for i in range(scenes)]
    names = [re.sub(r"^fig(?=\d+$)", "Figure ", name) for name in data["scene"].values]
    up = Axis((0, scenes), middles, labels=names)
    across = _error_axis(-16, 6, "Error of the picture / what it can hide")
    panel = PanelWithZeros(sheet, (LEFT, bottom, 720, top), across, up)
    panel.line([1.0, 1.0], [0, scenes], color=style.FRAME, lw=1.0)
    heading = "Evaluations an impact, of the two cheapest that suffice"
    corner(sheet, (LEFT, bottom, sheet.wide - 15, top), heading)
    methods = [text for text, *_ in _entries(data["name"].values, families)]
    for i, middle in enumerate(middles):
        row = data.isel(scene=i)
        errors = row["error"].values / float(row["limit"])
        missed = row["missed"].values > 0
        for family, error, hollow in zip(families, errors, missed, strict=True):
            panel.dots(error, middle, STYLES[family][0], hollow=hollow)
        circles = np.where(missed, " \N{WHITE CIRCLE}", "")
        named = list(zip(row["evaluations"].values, methods, circles, strict=True))
        best = int(row["cheapest"])
        others = [named[j] for j in np.flatnonzero(row["good"].values) if j != best]
        second = "{1}: {0:.0f}{2}".format(*min(others)) if others else "no other"
        y = float(panel.place(1.0, middle)[1][0])
        for shift, text in ((14, "{1} {0:.1f}".format(*named[best])), (-16, second)):
            sheet.text(740, y + shift, text, size=7.0)
    entries = dict.fromkeys(_entries(families, families))
    method_key(sheet, [*entries, ("impacts missed", style.FRAME, "o", True)], bottom - 135)
    return sheet.figure


def chart_sheet(least: int, entries: Sequence[Entry] = ()) -> tuple[Sheet, int]:
    """Return a sheet for a height in pixels and a key, and the upper end of its first frame."""
    lines = math.ceil(len(entries) / _KEY_COLUMNS)
    high = 75 * math.ceil((least + lines * _KEY_LINE) / 75)  # whole quarters of an inch
    return Sheet(style.COLUMN, high), high - 70


def _sizes(panel: Panel, family: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return sizes of marks, larger ones in a family if later ones hide each of its marks."""
    places = np.stack(panel.place(x, y), axis=1)
    near = np.abs(places[:, None] - places).max(axis=2) < _NEAR
    later = near & (family > family[:, None])
    over = np.array([len(set(family[row])) for row in later])
    hidden = [over[(family == each) & np.isfinite(y)].all() for each in family]
    return np.where(hidden, 3.2 + _RIM * over, 3.2)


def _error_axis(low: int, high: int, name: str) -> AxisWithZero:
    """Return an axis of decades with ticks at its lower end, which stands for zero, and above."""
    ticks = [low, *range(-(-(low + 2) // 4) * 4, high + 1, 4)]
    labels = ["0", *(rf"$10^{{{tick}}}$" for tick in ticks[1:])]
    return AxisWithZero((low, high), ticks, name, True, labels)


def _entries(names: Iterable[str], families: Iterable[str]) -> list[Entry]:
    """Return an entry of the key, (text, colour, mark), for each method or family."""
    pairs = zip(names, families, strict=True)
    return [(_printed(name, fam), *STYLES.get(name, STYLES[fam])) for name, fam in pairs]


def _methods_with_merged_scans(data: xr.Dataset) -> list[Entry]:
    """Return an entry for each method; scans of one tolerance look alike and share theirs."""
    entries = _entries(data["name"].values, data["family"].values)
    scans: dict[str, list[int]] = {}  # by tolerance
    for i, name in enumerate(data["name"].values):
        if name.startswith("scan "):
            scans.setdefault(name.partition(", ")[2], []).append(i)
    for tolerance, same in scans.items():
        if len(same) > 1:
            first, last = (_scan_step(data["name"].values[i]) for i in (same[0], same[-1]))
            for i in same:
                entries[i] = (_printed(tolerance, f"scan {first} to {last}"), style.BLUE, "o")
    return entries


def _scan_step(name: str) -> str:
    """Return STEP of a method named "scan STEP, TOLERANCE"."""
    return name.partition(", ")[0].removeprefix("scan ")


def _printed(name: str, family: str) -> str:
    """Return a family's name, and the tolerance or step that ends the name of a method, typeset."""
    family = family.removesuffix(" + bisection").removesuffix(" direction")
    setting = re.search(r"1e-0?(\d+)$", name)
    text = family.replace("<=", "\N{LESS-THAN OR EQUAL TO}")
    return rf"{text}, $10^{{-{setting[1]}}}$" if setting else text
