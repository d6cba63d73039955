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

from pseudorigid.figures.axes.limits import decades
from pseudorigid.figures.axes.panel import Axis, Panel, corner, key, letters, title
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import POINT, Sheet
from study.labels import label
from study.zero import PanelWithZeros, axis_with_zero

# Colour and mark of each family of methods. A method has one mark in all charts, open where it is
# as commonly written.
_GREY, _DARK, _USUAL = "#8a8a8a", "#5c5c5c", True
_SCANS = "scan 0.5 + bisection", "scan 0.1 + bisection", "scan 0.01 + bisection", "scan 0.5 to 0.01"
STYLES: dict[str, tuple[Any, ...]] = {
    "certified march": (style.VERMILION, "o"),
    "inflections": (style.BLUE, "D"),
    "scan by rotation": (style.GREEN, "X"),
    "march by table": (style.ORANGE, "P"),
    "careful scan (best)": (_DARK, "p"),
    "tuned heyoka": ("#882255", "s"),
    "tuned DOP853": (style.BLACK, "^"),
    "inflections (simple)": (_DARK, "D"),
    **{f"careful scan{form}": (_DARK, "8") for form in ("", " (landing)", " (simple)")},
    "tuned LSODA": (_GREY, "X"),
    "tuned RK45": (_GREY, "v"),
    "tuned CyRK DOP853": (_GREY, "<"),
    **dict.fromkeys(_SCANS, (_GREY, "h", _USUAL)),
    "time stepping": (_GREY, ">", _USUAL),
    "heyoka": ("#882255", "s", _USUAL),
    "DOP853": (style.BLACK, "^", _USUAL),
    "LSODA": (_GREY, "X", _USUAL),
    "RK45": (_GREY, "v", _USUAL),
}
# Methods that a chart of work names: those that are fast and exact, and others.
_FAST = {
    "certified march": "march",
    "inflections": "inflections",
    "scan by rotation": "scan by rotation",
    "careful scan (best)": "best scan",
}
_SLOW = {
    "scan 0.1 + bisection": "scan",
    "tuned heyoka": "heyoka",
    "heyoka": "heyoka",
    "tuned DOP853": "DOP853",
    "DOP853": "DOP853",
}
LEFT, RIGHT = 150, 1000  # pixels: ends of the frames
_ZERO_DECADE = -18  # at which zeros are drawn, below errors of a double, which are above 1e-17
_RECORD, _IMPACT = 10, 20  # places at which lines have labels
_ROW = 31  # pixels: height of a row of a table
_NEED = 130  # pixels: height of a scene in the chart of what each needs
# Colour, mark and rise in a row of each family of hard states.
_SEARCHES = (style.BLACK, "o", 0.28), ("#7a7a7a", "D", 0.0), (style.SKY, "v", -0.28)
_BAND = "#fbeedd"
_COUNTS = ["0", *(rf"$10^{e}$" for e in range(5))]  # labels
Entry = tuple[Any, ...]  # of a key: text, colour, mark, and whether it is hollow
Scene = dict[str, Any]  # a block of the checked config
method_key = partial(key, columns=3, size=7.0)


@style.pinned()
def work(scene: Scene, data: xr.Dataset) -> Figure:
    """Draw the worst error of a flight's time against its cost in time, for one set of states.

    Times are in units of the march's. Methods that are fast and exact have a panel of their own.
    The worst error is at the top if a root is wrong.
    """
    which = ("uniform", "grazing").index(scene["states"])
    times = dict(zip(data["timed_name"].values, data["timed_flight"].values[:, which], strict=True))
    data = data.isel(set=which)
    wrong = data["wrong"].values > 0.0
    worst = np.where(wrong, 1.0, data["worst"].values)
    cost = np.array([times[name] for name in data["name"].values])
    points = {
        family: (cost[own], worst[own])
        for family in [*_FAST, *_SLOW]
        if (own := data["family"].values == family).any()
    }
    sheet = Sheet(style.COLUMN, 675)
    up = axis_with_zero(_ZERO_DECADE, 1, "Worst relative error of a flight's time")
    across = decades((-0.5, 4.5), "Time of a flight (march: 1)")
    panel = PanelWithZeros(sheet, (LEFT, 165, 590, 600), across, up)
    fast = {family: points[family] for family in _FAST if family in points}
    most = 5 * math.ceil(2e15 * max(float(y.max()) for _, y in fast.values())) + 5  # in 1e-16
    near = Axis((0.8, 1.4), (0.8, 1.0, 1.2), "Time (march: 1)")
    errors = Axis((0, most), range(0, most + 1, 5), "in units of $10^{-16}$")
    detail = Panel(sheet, (705, 165, 1030, 600), near, errors)
    letters(sheet, panel.frame, detail.frame)
    _stack(detail, fast)
    box = (10**-0.3, 10**0.3), (1e-17, 1e-16 * most)
    (left, right), (low, high) = panel.place(*box)
    panel.sheet.draw(
        [left, right, right, left, left], [low, low, high, high, low], color=style.FRAME, lw=0.6
    )
    panel.note(box[0][1], box[1][0], "see (b)", shift=(3, 4))
    _curves(panel, points, _SLOW, [(left, low, right + 130, high)])
    if wrong[np.isin(data["family"].values, [*points])].any():
        sheet.text(RIGHT + 30, 40, "at $10^0$: wrong roots", ha="right", size=7.0)
    tuned = ("tuned", style.FRAME, "^"), ("as commonly written", style.FRAME, "^", True)
    key(sheet, tuned, 40, columns=2, left=LEFT, width=380, size=7.0)
    return sheet.figure


def _stack(panel: Panel, points: dict[str, tuple[np.ndarray, np.ndarray]]) -> None:
    """Draw a mark for each method, errors in 1e-16, with names above each other, in order."""
    order = sorted(points, key=lambda family: float(points[family][0][-1]))
    top = max(1e16 * float(y[-1]) for _, y in points.values())
    for i, family in enumerate(reversed(order)):
        (color, marker, *_), (x, y) = STYLES[family], points[family]
        panel.dots(x[-1:], 1e16 * y[-1:], color, marker=marker)
        (across,), (up,) = panel.place(x[-1], 1e16 * y[-1])
        _, (base,) = panel.place(x[-1], top)
        at = base + 38 + 34 * i
        # The name is right of its line, and so of the lines of the methods above it.
        panel.sheet.draw([across, across], [up, at + 24], color=color, lw=0.5, zorder=3)
        panel.sheet.text(across + 8, at + 12, _FAST[family], size=7.0, color=color)


def _curves(
    panel: Panel,
    points: dict[str, tuple[np.ndarray, np.ndarray]],
    names: dict[str, str],
    taken: Sequence[tuple[float, ...]] = (),
) -> None:
    """Draw and name the curves of some families, with a mark at the finest setting."""
    drawn, labels = [], []
    for family, name in names.items():
        if family not in points:
            continue
        (color, marker, *hollow), (x, y) = STYLES[family], points[family]
        panel.line(x, y, color=color, lw=0.9, ls="--" if hollow else "-")
        panel.dots(x[-1:], y[-1:], color, hollow=bool(hollow), marker=marker)
        drawn.append(np.stack(panel.place(x, y), axis=1))
        labels.append((x[-1], y[-1], name, color))
    if labels:
        label(panel, drawn, labels, taken)


def _lines(panel: Panel, data: xr.Dataset, over: str, name: str, at: int) -> list[Entry]:
    """Draw a variable of each method over another one, and return the entries of a key.

    Lines of scans are labelled with their tolerances at the place `at`.
    """
    entries, x = _entries(data["name"].values, data["family"].values), data[over].values
    labels, drawn = [], []
    for i, (entry, y) in enumerate(zip(entries, data[name].values, strict=True)):
        text, color, _, hollow = entry
        panel.line(x, y, color=color, lw=0.9, ls=_dashes(entry))
        drawn.append(np.stack(panel.place(x, y), axis=1))
        if text.startswith("scan ") and hollow and entry not in entries[:i]:
            labels.append((x[at], y[at], text.rpartition(", ")[2], style.BLACK))
    label(panel, drawn, labels)
    return entries


@style.pinned()
def edges(scene: Scene, data: xr.Dataset) -> Figure:
    """Draw tables of failing shares in colour: methods against heights and speeds of contact."""
    order = np.argsort([[*STYLES].index(f) for f in data["family"].values], kind="stable")
    data = data.isel(method=order)
    names = [text for text, *_ in _entries(data["name"].values, data["family"].values)]
    rows, left, gap = len(names), LEFT + 180, 40
    table = _ROW * rows
    sheet, top = chart_sheet(2 * (table + 180) + 60)
    wide, frames = (RIGHT - left - gap) / 2, []
    height = "Height of the gap's maximum, + or −"
    of_rows = (
        ("touch", "depth", ("it just touches", "it just misses"), height),
        ("near", "distance", ("$x > -g$", "$x < -g$"), r"Contact speed $\dot{x}^-+\dot{u}^-$"),
    )
    for row, (variable, exponent, sides, name) in enumerate(of_rows):
        powers, high = data[exponent].values, top - row * (table + 180)
        ticks = [*range(-int(powers[-1]), -int(powers[0]), 4)]
        across = Axis((-powers[-1] - 0.5, 0.5 - powers[0]), ticks)
        across = replace(across, labels=[rf"$10^{{{tick}}}$" for tick in ticks])
        for side, text in enumerate(sides):
            start = left + side * (wide + gap)
            frames.append((start, high - table, start + wide, high))
            Panel(sheet, frames[-1], across, Axis((0, rows), ()), grid=False)
            title(sheet, frames[-1], text, size=8.0)
            for i, shares in enumerate(data[variable].values[:, side]):
                middle = high - _ROW * (i + 0.5)
                if side == 0:
                    sheet.text(left - 10, middle, names[i], ha="right", size=7.0)
                for power, share in zip(powers, shares, strict=True):
                    cell, lw = [-power - 0.5, 0.5 - power], _ROW / POINT - 0.3
                    along = start + across.between(cell) * wide
                    sheet.draw(along, [middle] * 2, color=_shade(share), lw=lw,
                               solid_capstyle="butt", zorder=1)  # fmt: skip
        sheet.text(left + wide + gap / 2, high - table - 60, name, ha="center", va="top", size=8.0)
    letters(sheet, *frames)
    shades = [(f"{share:g}", _shade(share), "s", False, 5.0) for share in (0, 0.01, 0.5, 1)]
    under = frames[-1][1] - 130
    sheet.text(LEFT, under, "share of flights that fail:", size=7.0)
    key(sheet, shades, under, columns=4, left=LEFT + 320, width=520, size=7.0)
    return sheet.figure


def _shade(share: float) -> str:
    """Return the colour of a share: pale for 0, and from yellow to dark red above."""
    if not share > 0.0:
        return "#e8eef2"
    low, high = np.array([242.0, 165.0, 50.0]), np.array([110.0, 15.0, 25.0])
    return "#" + "".join(f"{int(part):02x}" for part in low + share * (high - low))


@style.pinned()
def energy(scene: Scene, data: xr.Dataset) -> Figure:
    """Draw the energy drift of each method, and the impacts missed against the last drift.

    In the shaded part the energy is kept to 1e-6, so that a check sees nothing.
    """
    entries = _entries(data["name"].values, data["family"].values)
    named = _kinds(entries)
    sheet, top = chart_sheet(1230)
    drift = axis_with_zero(_ZERO_DECADE, 1, "Largest relative error of the energy so far")
    upper = PanelWithZeros(sheet, (LEFT, top - 430, RIGHT, top), decades((0, 6), "Impacts"), drift)
    across = decades((-13, 1), "Largest relative error of the energy after all impacts")
    up = replace(axis_with_zero(-1, 4, "Impacts missed in a million", 1), labels=_COUNTS)
    lower = PanelWithZeros(sheet, (LEFT, top - 940, RIGHT, top - 600), across, up)
    letters(sheet, upper.frame, lower.frame)
    shaded, _ = lower.place([1e-13, 1e-6], 1.0)
    wide = (shaded[1] - shaded[0]) / POINT
    lower.line([10**-9.5] * 2, [0.1, 1e4], lw=wide, color=_BAND, zorder=0.1)
    ends = zip(data["drift"].values[:, -1], data["missed"].values, strict=True)
    for name, entry, end in zip(data["name"].values, entries, ends, strict=True):
        text, color, marker, hollow = entry
        lower.dots(*end, color, size=2.4, hollow=hollow, marker=marker)
        if color == _GREY:
            is_one_of_many = entries.count(entry) > 1
            setting = name.partition(", ")[0].removeprefix("scan ")
            setting = setting if is_one_of_many else text.rpartition(", ")[2]
            rise = 4.5 if is_one_of_many or text.startswith("time") else -6
            lower.note(*end, setting, shift=(3, rise))
    _lines(upper, data, "record", "drift", _RECORD)
    lower.note(1.5e-13, 3e3, "a check to $10^{-6}$ sees nothing")
    method_key(sheet, named, top - 1075)
    return sheet.figure


@style.pinned()
def separation(scene: Scene, data: xr.Dataset) -> Figure:
    """Draw the distance of each method's orbit from the proved one, from `stages.drift`."""
    sheet, top = chart_sheet(975)
    across = Axis((0, 170), (0, 50, 100, 150), "Impacts")
    up = axis_with_zero(_ZERO_DECADE, 0, "Median distance in $x$ from the proved orbit")
    panel = PanelWithZeros(sheet, (LEFT, top - 600, RIGHT, top), across, up)
    named = _kinds(_lines(panel, data, "impact", "apart", _IMPACT))
    method_key(sheet, [(*entry[:2], "", _dashes(entry)) for entry in named], top - 740)
    return sheet.figure


@style.pinned()
def figure_errors(scene: Scene, data: xr.Dataset) -> Figure:
    """Draw the error of each figure by each method in units of the largest invisible error.

    Hollow marks are methods that missed impacts. At the right are the evaluations per impact of the
    two cheapest methods that suffice.
    """
    scenes, names, families = data.sizes["scene"], data["name"].values, data["family"].values
    sheet = Sheet(style.COLUMN, 75 * math.ceil((_NEED * scenes + 500) / 75))
    top, bottom = sheet.high - 75, sheet.high - 75 - _NEED * scenes
    middles = [scenes - 0.5 - i for i in range(scenes)]
    labels = [re.sub(r"^fig(?=\d+$)", "Figure ", name) for name in data["scene"].values]
    up = Axis((0, scenes), middles, labels=labels)
    across = axis_with_zero(-16, 6, "Error of the picture / largest that cannot be seen")
    panel = PanelWithZeros(sheet, (LEFT, bottom, 720, top), across, up)
    panel.line([1.0, 1.0], [0, scenes], color=style.FRAME, lw=0.5)
    rows = {family: i for i, family in enumerate(dict.fromkeys(families))}  # in a scene's strip
    heading = "Evaluations per impact, of the two cheapest that suffice"
    corner(sheet, (LEFT, bottom, sheet.wide - 15, top), heading)
    methods = [text for text, *_ in _entries(names, families)]
    for i, middle in enumerate(middles):
        row = data.isel(scene=i)
        errors = row["error"].values / float(row["limit"])
        missed = row["missed"].values > 0
        for family, error, hollow in zip(families, errors, missed, strict=True):
            hue, marker, *_ = STYLES[family]
            at = middle + 0.42 - 0.84 * rows[family] / max(len(rows) - 1, 1)
            panel.dots(error, at, hue, size=2.2, hollow=hollow, marker=marker)
        circles = np.where(missed, " \N{WHITE CIRCLE}", "")
        named = list(zip(row["evaluations"].values, methods, circles, strict=True))
        best = int(row["cheapest"])
        others = [named[j] for j in np.flatnonzero(row["good"].values) if j != best]
        second = "{1}: {0:.0f}{2}".format(*min(others)) if others else "no other"
        y = float(panel.place(1.0, middle)[1][0])
        for shift, text in ((14, "{1} {0:.1f}".format(*named[best])), (-16, second)):
            sheet.text(740, y + shift, text, size=7.0)
    hidden = (
        "Cannot be seen: less than a pixel, or for a mean exponent",
        "than three standard errors.",
    )
    for i, text in enumerate(hidden):
        sheet.text(60, bottom - 122 - 36 * i, text, size=7.0)
    entries = [(*entry[:3], False) for entry in _kinds(_entries(families, families))]
    method_key(sheet, [*entries, ("impacts missed", style.FRAME, "o", True)], bottom - 205)
    return sheet.figure


@style.pinned()
def misses(scene: Scene, data: xr.Dataset) -> Figure:
    """Draw impacts missed against flights, and the share of hard states at which methods fail.

    Each method that misses an impact has a line, and a note names the others.
    """
    names, searched = data["name"].values.tolist(), data["searched_name"].values.tolist()
    entries = dict(zip(names, _entries(names, data["family"].values), strict=True))
    rows = len(searched)
    sheet, top = chart_sheet(1040 + 56 * rows)
    up = replace(axis_with_zero(-1, 4.3, "Impacts missed", 1), labels=_COUNTS)
    flights = [*data["flights"].values, *data["long_flights"].values]
    powers = [len(str(n)) - 1 for n in flights]
    labels, limits = [rf"$10^{power}$" for power in powers], (2.8, powers[-1] + 2.1)
    across = Axis(limits, powers, "Flights of the chaotic sea", labels=labels)
    upper = PanelWithZeros(sheet, (LEFT, top - 470, RIGHT, top), across, up)
    none, notes, drawn = [], [], []
    for name, (text, color, marker, hollow) in entries.items():
        own = (data[f"{part}missed"].values[data[f"{part}name"] == name] for part in ("", "long_"))
        count = np.concatenate([row for rows in own for row in rows])
        if not count.any():
            none.append(f"{text}, $10^{powers[count.size - 1]}$")
            continue
        x = np.array(powers[: count.size])
        upper.line(x, count, color=color, lw=0.6)
        upper.dots(x, count, color, hollow=hollow, marker=marker)
        short = re.sub(r"careful (scan) (.*) \((.*)\)", r"\3 \1 \2", text).partition(",")[0]
        notes.append((x[-1], count[-1], short, style.BLACK))
        drawn.append(np.stack(upper.place(x, count), axis=1))
    label(upper, drawn, notes)
    none = [", ".join(none[i : i + 3]) for i in range(0, len(none), 3)]
    for i, text in enumerate(["Misses none among: " + none[0], *none[1:]] if none else []):
        sheet.text(60, top - 600 - 38 * i, text, size=7.0)
    high = top - 800
    frame = (LEFT + 215, high - 56 * rows, RIGHT, high)
    share = axis_with_zero(-7, 0, "Share of hard states at which it fails", 2)
    middles = [rows - 0.5 - i for i in range(rows)]
    labels = [_printed(name, re.sub("tuned |, 1e.*", "", name)) for name in searched]
    lower = PanelWithZeros(sheet, frame, share, Axis((0, rows), middles, labels=labels))
    shares = data["failed"].values / data["tried"].values
    families = []
    for j, (color, marker, rise) in enumerate(_SEARCHES):
        lower.dots(shares[:, j], np.array(middles) + rise, color, size=3.0, marker=marker)
        families.append((data["families"].values[j].replace("_", " "), color, marker))
    method_key(sheet, families, frame[1] - 130)
    title(sheet, frame, "States that are hard to decide", size=8.0)
    letters(sheet, upper.frame, lower.frame)
    return sheet.figure


def chart_sheet(least: int) -> tuple[Sheet, int]:
    """Return a sheet at least as high as that in pixels, and the upper end of its first frame."""
    high = 75 * math.ceil(least / 75)  # whole quarters of an inch
    return Sheet(style.COLUMN, high), high - 70


def _entries(names: Iterable[str], families: Iterable[str]) -> list[Entry]:
    """Return an entry of the key for each method or family."""
    pairs = zip(names, families, strict=True)
    styles = [(_printed(name, fam), *STYLES.get(name, STYLES[fam])) for name, fam in pairs]
    return [(*entry, False)[:4] for entry in styles]


def _kinds(entries: Sequence[Entry]) -> list[Entry]:
    """Return an entry of the key for each colour and mark, without steps and tolerances if grey."""
    named = {entry[1:]: entry for entry in reversed(entries)}
    short = (re.sub(r" [\d.].*|, .*", "", e[0]) if e[1] == _GREY else e[0] for e in named.values())
    return [(text, *entry[1:]) for text, entry in zip(short, named.values(), strict=True)][::-1]


def _dashes(entry: Entry) -> str:
    """Return the dashes of a line without marks: none for a tuned method."""
    text, _, _, hollow = entry
    return ":" if text.startswith("time stepping") else "--" if hollow else "-"


def _printed(name: str, family: str) -> str:
    """Return a family's name, and the tolerance or step that ends the name of a method, typeset."""
    text = name if name.startswith("careful") else family.removesuffix(" + bisection")
    setting = re.search(r"1e-0?(\d+)$", name)
    return rf"{text}, $10^{{-{setting[1]}}}$" if setting else text
