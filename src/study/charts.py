"""The charts of the study: work and precision, where methods fail, and what each figure needs."""

import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import replace
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
# methods apart; similar methods have similar colours. A third entry means a hollow mark, for
# methods as they are usually written.
_GREY, _WINE, _PINK, _USUAL = "#8a8a8a", "#882255", "#cc79a7", True
STYLES: dict[str, tuple[Any, ...]] = {
    "certified march": (style.VERMILION, "o"),
    "careful scan": (_WINE, "p"),
    "careful scan (simple)": (style.ORANGE, "D"),
    "heyoka with care": (style.GREEN, "s"),
    "CyRK DOP853 with care": ("#8c510a", "^"),
    "DOP853 with care": (style.BLACK, "^"),
    "LSODA with care": (_GREY, "D"),
    "RK45 with care": (_PINK, "v"),
    "scan 0.5 + bisection": (style.SKY, "o", _USUAL),
    "scan 0.1 + bisection": (style.BLUE, "o", _USUAL),
    "scan 0.01 + bisection": ("#0b2a55", "o", _USUAL),
    "scan 0.5 to 0.01": (style.BLUE, "o", _USUAL),
    "time stepping": (style.ORANGE, ">", _USUAL),
    "heyoka": (style.GREEN, "s", _USUAL),
    "DOP853": (style.BLACK, "^", _USUAL),
    "LSODA": (_GREY, "D", _USUAL),
    "RK45": (_PINK, "v", _USUAL),
    "careful scan 1": (_WINE, "<"),
    "careful scan 0.25": (_WINE, "^"),
    "careful scan 1 (simple)": (style.ORANGE, "s"),
    "careful scan 0.5 (simple)": (style.ORANGE, "o"),
    "careful scan 0.25 (simple)": (style.ORANGE, "^"),
    "scan 0.1, 1e-03": ("#ecc3da", "o", _USUAL),
    "scan 0.1, 1e-06": (_PINK, "o", _USUAL),
    "scan 0.1, 1e-09": ("#9a4f7c", "o", _USUAL),
    "engine 1e-03": ("#5c3d00", ">", _USUAL),
}
LEFT, RIGHT = 150, 1000  # pixels: ends of the frames
_ZERO_DECADE = -18  # at which zeros are drawn, below errors of a double, which are above 1e-17
_COSTS = {"evaluations": (0, 5), "seconds": (-8, -1)}  # decades
_NEAR, _RIM = 4, 1.6  # pixels between marks that hide each other; points a hidden one is larger by
_BREAK_STROKES = (-5, 9, style.FRAME, 0.6), (5, 9, style.FRAME, 0.6)  # of a break of an axis
_SEARCHES = (style.BLACK, "o", 0.14), ("#9a9a9a", "D", -0.14)  # colour, mark and rise in a row
_COUNTS = ["0", *(rf"$10^{e}$" for e in range(5))]  # labels
_KEY_COLUMNS, _KEY_LINE = 3, 42  # of a key; pixels: height of its lines
Entry = tuple[Any, ...]  # of a key: text, colour, mark, and whether it is hollow
Scene = dict[str, Any]  # a block of the checked config
method_key = partial(key, columns=_KEY_COLUMNS, size=7.0)


class AxisWithZero(Axis):
    """An axis of decades whose lower end stands for zero and for all that is less than it."""

    def fraction(self, values: ArrayLike) -> np.ndarray:
        """Return where values lie between the limits, 0 to 1."""
        return super().fraction(np.maximum(values, float(f"1e{self.limits[0]}")))

    def texts(self) -> Sequence[str]:
        """Return the labels of the ticks, the first of which is zero."""
        return self.labels or ["0", *super().texts()[1:]]


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
    """Draw a work-precision diagram for one set of states: median and worst error against cost.

    The worst error is at the top if a root is wrong. Marks that others would hide are larger.
    CyRK evaluates as often as DOP853, so that it is drawn against seconds alone.
    """
    which = ("uniform", "grazing").index(scene["states"])
    cost = "seconds" if "seconds" in data else "evaluations"
    drawn = [not (f.startswith("CyRK") and cost == "evaluations") for f in data["family"].values]
    data = data.isel(set=which, method=drawn)
    present = set(data["family"].values)
    families = [family for family in STYLES if family in present]
    entries = _entries(families, families)
    sheet, top = chart_sheet(1280, entries)
    across = decades(_COSTS[cost], f"{cost.capitalize()} per flight")
    median = _from_zero(_ZERO_DECADE, 0, "Median relative error of the flight time")
    worst = replace(median, name="Worst relative error")
    panels = (
        PanelWithZeros(sheet, (LEFT, top - 480, RIGHT, top), across.blank(), median),
        PanelWithZeros(sheet, (LEFT, top - 1045, RIGHT, top - 565), across, worst),
    )
    letters(sheet, *(panel.frame for panel in panels))
    if data["wrong"].values.any():
        corner(sheet, panels[1].frame, "at the top: some roots are wrong")
    x, of = data[cost].values, np.array([families.index(f) for f in data["family"].values])
    worst_error = np.where(data["wrong"].values > 0.0, 1.0, data["worst"].values)
    for panel, y in zip(panels, (data["median"].values, worst_error), strict=True):
        size = _sizes(panel, len(families) - of, x, y)
        for i, (_, color, marker, hollow) in reversed([*enumerate(entries)]):
            own = np.flatnonzero(of == i)
            panel.line(x[own], y[own], color=color, lw=0.5 if hollow else 0.9)
            for points in np.unique(size[own]):
                at = own[(size[own] == points) & np.isfinite(y[own])]
                panel.dots(x[at], y[at], color, points, hollow=hollow, marker=marker)
    method_key(sheet, entries, top - 1180)
    return sheet.figure


@style.pinned()
def edges(scene: Scene, data: xr.Dataset) -> Figure:
    """Draw the failing share against the distance from grazing, and the height of a maximum.

    A ball that grazes at x > -g comes back at once, at x < -g it leaves. Methods whose marks
    coincide take turns in front.
    """
    order = np.argsort([[*STYLES].index(f) for f in data["family"].values], kind="stable")
    data = data.isel(method=order)
    methods = _entries(data["name"].values, data["family"].values)
    sheet, top = chart_sheet(1130 + _KEY_LINE * math.ceil(len(methods) / 2))
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
            panel = Panel(sheet, frames[-1], across, up)
            if side:
                middle = left - gap / 2, high - 360 - 16 * POINT
                sheet.text(*middle, name, ha="center", va="top", size=8.0)
            title(sheet, frames[-1], text if side else f"Share failing, {text}", size=8.0)
            shares = data[variable].values[:, side]
            for (_, color, _, hollow), share in zip(methods, shares, strict=True):
                panel.line(x, share, color=color, lw=0.5 if hollow else 0.9)
            for column, at in enumerate(x):  # methods that coincide take turns in front
                for i in np.roll(np.arange(len(methods)), -1 - column).tolist():
                    _, color, marker, hollow = methods[i]
                    panel.dots(at, shares[i, column], color, 2.6, hollow=hollow, marker=marker)
    letters(sheet, *frames)
    method_key(sheet, methods, top - 1040, columns=2)
    return sheet.figure


@style.pinned()
def energy(scene: Scene, data: xr.Dataset) -> Figure:
    """Draw the energy drift of each method, and the impacts missed against the last drift.

    In the shaded part the energy is kept to 1e-6, so that a check sees nothing.
    """
    entries = _entries(data["name"].values, data["family"].values)
    named = list(dict.fromkeys(entries))
    sheet, top = chart_sheet(1135, named)
    drift = _from_zero(_ZERO_DECADE, 1, "Largest relative error of the energy so far")
    upper = PanelWithZeros(sheet, (LEFT, top - 430, RIGHT, top), decades((0, 6), "Impacts"), drift)
    across = decades((-13, 1), "Largest relative error of the energy after all impacts")
    up = replace(_from_zero(-1, 4, "Impacts missed in a million", 1), labels=_COUNTS)
    lower = PanelWithZeros(sheet, (LEFT, top - 940, RIGHT, top - 600), across, up)
    letters(sheet, upper.frame, lower.frame)
    shaded, _ = lower.place([1e-13, 1e-6], 1.0)
    wide = (shaded[1] - shaded[0]) / POINT
    lower.line([10**-9.5] * 2, [0.1, 1e4], lw=wide, color="#fbeedd", zorder=0.1)
    for i, (_, color, marker, hollow) in enumerate(entries):
        drift = data["drift"].values[i]
        upper.line(data["record"].values, drift, color=color, lw=0.9, ls=_dashes(entries[i]))
        end = drift[-1], float(data["missed"].values[i])
        lower.dots(*end, color, hollow=hollow, marker=marker)
        if entries.count(entries[i]) > 1:
            step = data["name"].values[i].partition(", ")[0].removeprefix("scan ")
            lower.note(*end, step, shift=(3, 4.5))
    lower.note(1.5e-13, 3e3, "a check to $10^{-6}$ sees nothing")
    method_key(sheet, named, top - 1075)
    return sheet.figure


@style.pinned()
def separation(scene: Scene, data: xr.Dataset) -> Figure:
    """Draw the distance of each method's orbit from the proved one, from `stages.drift`."""
    sheet, top = chart_sheet(975)
    across = Axis((0, 170), (0, 50, 100, 150), "Impacts")
    up = _from_zero(_ZERO_DECADE, 0, "Median distance in $x$ from the proved orbit")
    panel = PanelWithZeros(sheet, (LEFT, top - 600, RIGHT, top), across, up)
    entries = _entries(data["name"].values, data["family"].values)
    lines = [(*entry[:2], "", _dashes(entry)) for entry in entries]
    for (_, color, _, dashes), distance in zip(lines, data["apart"].values, strict=True):
        panel.line(data["impact"].values, distance, color=color, lw=0.9, ls=dashes)
    method_key(sheet, dict.fromkeys(lines), top - 740)
    return sheet.figure


@style.pinned()
def figure_errors(scene: Scene, data: xr.Dataset) -> Figure:
    """Draw the error of each figure by each method in units of the largest invisible error.

    Hollow marks are methods that missed impacts. At the right are the evaluations per impact of the
    two cheapest methods that suffice.
    """
    scenes, families = data.sizes["scene"], data["family"].values
    sheet = Sheet(style.COLUMN, 75 * (5 + scenes))
    top, bottom = sheet.high - 75, sheet.high - 75 * (1 + scenes)
    middles = [scenes - 0.5 - i for i in range(scenes)]
    names = [re.sub(r"^fig(?=\d+$)", "Figure ", name) for name in data["scene"].values]
    up = Axis((0, scenes), middles, labels=names)
    across = _from_zero(-16, 6, "Error of the picture / what it can hide")
    panel = PanelWithZeros(sheet, (LEFT, bottom, 720, top), across, up)
    panel.line([1.0, 1.0], [0, scenes], color=style.FRAME, lw=1.0)
    heading = "Evaluations per impact, of the two cheapest that suffice"
    corner(sheet, (LEFT, bottom, sheet.wide - 15, top), heading)
    methods = [text for text, *_ in _entries(data["name"].values, families)]
    for i, middle in enumerate(middles):
        row = data.isel(scene=i)
        errors = row["error"].values / float(row["limit"])
        missed = row["missed"].values > 0
        for family, error, hollow in zip(families, errors, missed, strict=True):
            hue, marker, *_ = STYLES[family]
            panel.dots(error, middle, hue, hollow=hollow, marker=marker)
        circles = np.where(missed, " \N{WHITE CIRCLE}", "")
        named = list(zip(row["evaluations"].values, methods, circles, strict=True))
        best = int(row["cheapest"])
        others = [named[j] for j in np.flatnonzero(row["good"].values) if j != best]
        second = "{1}: {0:.0f}{2}".format(*min(others)) if others else "no other"
        y = float(panel.place(1.0, middle)[1][0])
        for shift, text in ((14, "{1} {0:.1f}".format(*named[best])), (-16, second)):
            sheet.text(740, y + shift, text, size=7.0)
    entries = dict.fromkeys(entry[:3] for entry in _entries(families, families))
    method_key(sheet, [*entries, ("impacts missed", style.FRAME, "o", True)], bottom - 135)
    return sheet.figure


@style.pinned()
def misses(scene: Scene, data: xr.Dataset) -> Figure:
    """Draw impacts missed against flights, and the share of hard states at which methods fail.

    Marks above the same number of flights stand side by side.
    """
    names, searched = data["name"].values.tolist(), data["searched_name"].values.tolist()
    styles = dict(zip(names, _entries(names, data["family"].values), strict=True))
    rows = len(searched)
    sheet, top = chart_sheet(930 + 56 * rows, [*styles.values()])
    up = replace(_from_zero(-1, 4.3, "Impacts missed", 1), labels=_COUNTS)
    flights = [*data["flights"].values, *data["long_flights"].values]
    powers = [len(str(n)) - 1 for n in flights]
    labels, limits = [rf"$10^{power}$" for power in powers], (2.5, powers[-1] + 0.5)
    across = Axis(limits, powers, "Flights of the chaotic sea", labels=labels)
    upper = PanelWithZeros(sheet, (LEFT, top - 470, RIGHT, top), across, up)
    for i, (name, (_, color, marker, hollow)) in enumerate(styles.items()):
        aside = 0.09 * (i - 0.5 * (len(styles) - 1))
        own = (data[f"{part}missed"].values[data[f"{part}name"] == name] for part in ("", "long_"))
        count = np.concatenate([row for rows in own for row in rows])
        x = np.array(powers[: count.size]) + aside
        upper.line(x, count, color=color, lw=0.6)
        upper.dots(x, count, color, hollow=hollow, marker=marker)
    method_key(sheet, [*styles.values()], top - 610)
    high = top - 660 - _KEY_LINE * math.ceil(len(styles) / _KEY_COLUMNS)
    frame = (LEFT + 215, high - 56 * rows, RIGHT, high)
    share = _from_zero(-7, 0, "Share of hard states at which it fails", 2)
    middles = [rows - 0.5 - i for i in range(rows)]
    labels = [_printed(name, re.sub(" with care, 1e.*", "", name)) for name in searched]
    lower = PanelWithZeros(sheet, frame, share, Axis((0, rows), middles, labels=labels))
    shares = data["failed"].values / data["tried"].values
    families = []
    for j, (color, marker, rise) in enumerate(_SEARCHES):
        lower.dots(shares[:, j], np.array(middles) + rise, color, marker=marker)
        families.append((data["families"].values[j].replace("_", " "), color, marker))
    method_key(sheet, families, frame[1] - 130)
    letters(sheet, upper.frame, lower.frame)
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


def _from_zero(low: int, high: float, name: str, every: int = 4) -> AxisWithZero:
    """Return an axis of decades with ticks at its lower end, which stands for zero, and above."""
    ticks = [low, *range(-(-(low + 1) // every) * every, int(high) + 1, every)]
    return AxisWithZero((low, high), ticks, name, True)


def _entries(names: Iterable[str], families: Iterable[str]) -> list[Entry]:
    """Return an entry of the key for each method or family."""
    pairs = zip(names, families, strict=True)
    styles = [(_printed(name, fam), *STYLES.get(name, STYLES[fam])) for name, fam in pairs]
    return [(*entry, False)[:4] for entry in styles]


def _dashes(entry: Entry) -> str:
    """Return the dashes of a line without marks: none for a method used with care."""
    text, _, _, hollow = entry
    return ":" if text.startswith("time stepping") else "--" if hollow else "-"


def _printed(name: str, family: str) -> str:
    """Return a family's name, and the tolerance or step that ends the name of a method, typeset."""
    text = name if name.startswith("careful") else family.removesuffix(" + bisection")
    text = text.replace("CyRK DOP853 with", "CyRK with")
    setting = re.search(r"1e-0?(\d+)$", name)
    return rf"{text}, $10^{{-{setting[1]}}}$" if setting else text
