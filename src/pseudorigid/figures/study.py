"""The charts of the study: work and precision, where methods fail, and what each figure needs."""

import math
import re

import numpy as np

from .axes.panel import Axis, Panel, corner, decades, key, log10
from .axes.raster import minor
from .canvas import style
from .canvas.sheet import POINT, Sheet

# A colour and a mark for each family of methods; what is near in kind is near in colour.
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
}
# Where methods of one family are drawn apart, some need a colour of their own.
SINGLE = {
    "scan 0.1, 1e-03": "#ecc3da",
    "scan 0.1, 1e-06": style.PURPLE,
    "scan 0.1, 1e-09": "#8f4772",
    "engine 1e-03": "#a86f00",
}
# The same for the ways to tell regular orbits from chaotic ones.
VERDICTS = {
    "growth below 3": (style.BLACK, "s"),
    "growth, best threshold": (style.BLUE, "o"),
    "SALI (two vectors)": (style.GREEN, "D"),
    "weighted Birkhoff average": (style.ORANGE, "^"),
    "as soon as safe": (style.VERMILION, "o"),
}
LEFT, RIGHT = 150, 1010  # pixels: the frames of charts
ZERO = -18  # the decade at which zeros are drawn, named so: a double's own error is above 1e-17
MAX_WRONG_SHARE = (
    0.01  # share of wrong roots above which what counts as wrong decides the worst right one
)
COSTS = {
    "evaluations": decades((0, 5), "Evaluations a flight"),
    "seconds": decades((-8, 0), "Seconds a flight"),
}


@style.pinned()
def work(data, which, cost):
    """Error and failures against cost: a work-precision diagram.

    Filled marks, full lines: the median error. Hollow marks, dashed lines: the worst of the right
    roots, where at most one in a hundred is wrong (else it is the largest error that does not count
    as wrong). Heavy bars: quartiles of the seconds. Below: the share of wrong
    roots.

    Parameters
    ----------
    data : xarray.Dataset
        Of work.counted or work.measured.
    which : int
        The set of states.
    cost : {"evaluations", "seconds"}

    Returns
    -------
    matplotlib.figure.Figure
    """
    entries, notes = _families(data), [("filled: the median", style.FRAME, "o", False)]
    if (data["wrong"].values[which] <= MAX_WRONG_SHARE).any():
        words = f"hollow: the worst right root, if at most {100 * MAX_WRONG_SHARE:.0f} % are wrong"
        notes.append((words, style.FRAME, "o", True))
    if cost == "seconds":
        notes.append(("heavy bars: quartiles of the seconds", style.FRAME, "", False, 1.6))
    lines = math.ceil(len(entries) / 2)
    sheet, top = _sheet(1010 + (lines + len(notes)) * 48)
    across = COSTS[cost]
    error = _from_zero(ZERO, 0, "Relative error of the flight time")
    upper = Panel(sheet, (LEFT, top - 560, RIGHT, top), across.blank(), error)
    share = Axis((0.0, 0.6), (0, 0.2, 0.4, 0.6), "Share of wrong roots")
    lower = Panel(sheet, (LEFT, top - 830, RIGHT, top - 630), across, share)
    for family in dict.fromkeys(data["family"].values):
        color, marker = _style(family)
        some = data.isel(set=which, method=data["family"].values == family)
        x = some[cost].values
        median, worst = (_seen(some[name].values, ZERO) for name in ("median", "worst"))
        few = some["wrong"].values <= MAX_WRONG_SHARE
        upper.line(x, median, color=color, lw=0.9)
        upper.line(x[few], worst[few], color=color, lw=0.5, ls="--")
        upper.dots(x[few], worst[few], color, hollow=True, marker=marker)
        upper.dots(x, median, color, marker=marker)
        if cost == "seconds":
            spans = some["seconds_low"].values, some["seconds_high"].values
            for low, high, y in zip(*spans, median, strict=True):
                upper.line([low, high], [y, y], color=color, lw=1.6)
        lower.line(x, some["wrong"].values, color=color, lw=0.9)
        lower.dots(x, some["wrong"].values, color, marker=marker)
    key(sheet, entries, top - 960, 2)
    key(sheet, notes, top - 960 - 48 * lines, 1)
    return sheet.figure


@style.pinned()
def edges(data):
    """Failing share against the distance from grazing, and against the height of a maximum.

    Above x = -g a ball that grazes comes back at once, below it leaves.

    Parameters
    ----------
    data : xarray.Dataset
        Of failures.edges.

    Returns
    -------
    matplotlib.figure.Figure
    """
    methods = _methods(data)
    sheet, top = _sheet(1005 + math.ceil(len(methods) / 2) * 42)
    gap = 40
    wide = (RIGHT - LEFT - gap) / 2
    grazing = "near", "distance", ("$x > -g$", "$x < -g$"), r"$\dot{x}^-+\dot{u}^-$", (-12, 0)
    sides, name = ("it just touches", "it just misses"), "Height of the gap's maximum, + or −"
    maximum = "touch", "depth", sides, name, (-14, -2)
    for row, (variable, exponent, sides, name, limits) in enumerate((grazing, maximum)):
        x = [float(f"1e-{n}") for n in data[exponent].values]
        across = Axis(limits, range(*limits, 4), "", True)
        for side, text in enumerate(sides):
            left, high = LEFT + side * (wide + gap), top - row * 480
            up = Axis((0, 1), (0, 0.5, 1), labels=("", "", "") if side else None)
            panel = Panel(sheet, (left, high - 300, left + wide, high), across, up)
            if side:
                where = left - gap / 2, high - 300 - 16 * POINT
                sheet.text(*where, name, ha="center", va="top", size=8.0)
            title = text if side else f"Share failing, {text}"
            sheet.text(left, high + 4 * POINT, title, ha="left", va="bottom", size=8.0)
            for (_, color, marker, _), share in zip(methods, data[variable].values, strict=True):
                panel.line(x, share[side], color=color, lw=0.9)
                panel.dots(x, share[side], color, size=2.6, marker=marker)
    key(sheet, methods, top - 920, 2)
    return sheet.figure


@style.pinned()
def energy(data):
    """Energy drift along each method's orbit, and impacts missed against the drift at its end.

    In the shaded part the energy is kept to 1e-6: a check sees nothing.

    Parameters
    ----------
    data : xarray.Dataset
        Of failures.orbits.

    Returns
    -------
    matplotlib.figure.Figure
    """
    sheet, top = _sheet(1350)
    drift = _from_zero(ZERO, 1, "Largest relative error of the energy so far")
    upper = Panel(sheet, (LEFT, top - 430, RIGHT, top), decades((0, 6), "Impacts"), drift)
    across = decades((-13, 1), "Largest relative error of the energy after all impacts", every=2)
    powers = ["0", *(rf"$10^{e}$" for e in range(5))]
    up = Axis((-1, 4), range(-1, 5), "Impacts missed in a million", True, powers)
    lower = Panel(sheet, (LEFT, 330, RIGHT, 670), across, up)
    seen, _ = lower.place([1e-13, 1e-6], 1.0)
    wide = (seen[1] - seen[0]) / POINT
    lower.line([10**-9.5] * 2, [0.1, 1e4], lw=wide, color="#fbeedd", zorder=0.1)
    entries = _alike(data)
    for i, (_, color, marker, _) in enumerate(entries):
        drift = data["drift"].values[i]
        upper.line(data["record"].values, _seen(drift, ZERO), color=color, lw=0.9)
        end = drift[-1], max(float(data["missed"].values[i]), 0.1)
        lower.dots(*end, color, marker=marker)
        if entries.count(entries[i]) > 1:
            lower.note(*end, _step(data["name"].values[i]), shift=(3, 3.5))
    lower.note(1.5e-13, 3e3, "a check to $10^{-6}$ sees nothing")
    key(sheet, list(dict.fromkeys(entries)), 190, 2)
    return sheet.figure


@style.pinned()
def separation(data):
    """How far each method's orbit is from the proved one, impact by impact.

    Parameters
    ----------
    data : xarray.Dataset
        Of failures.orbits.

    Returns
    -------
    matplotlib.figure.Figure
    """
    sheet, top = _sheet(975)
    across = Axis((0, 170), (0, 50, 100, 150), "Impacts")
    up = _from_zero(ZERO, 0, "Median distance in $x$ from the proved orbit")
    panel = Panel(sheet, (LEFT, top - 600, RIGHT, top), across, up)
    entries = _alike(data)
    for (_, color, _, _), distance in zip(entries, data["apart"].values, strict=True):
        panel.line(data["impact"].values, _seen(distance, ZERO), color=color, lw=0.9)
    lines = [(name, color, "", False) for name, color, _, _ in dict.fromkeys(entries)]
    key(sheet, lines, top - 740, 2)
    return sheet.figure


@style.pinned()
def figure_errors(data):
    """Error of each figure by each method, in units of what it can hide, and what is spent.

    Hollow: impacts were missed.

    Parameters
    ----------
    data : xarray.Dataset
        Of study.figure_errors.

    Returns
    -------
    matplotlib.figure.Figure
    """
    scenes = data.sizes["scene"]
    sheet = Sheet(style.COLUMN, 75 * (5 + scenes))
    top, bottom = sheet.high - 75, sheet.high - 75 * (1 + scenes)
    middles = [scenes - 0.5 - i for i in range(scenes)]
    names = [re.sub(r"^fig(?=\d+$)", "Figure ", name) for name in data["scene"].values.tolist()]
    up = Axis((0, scenes), middles, labels=names)
    across = _from_zero(-16, 6, "Error of the picture / what it can hide")
    panel = Panel(sheet, (LEFT, bottom, 720, top), across, up)
    panel.line([1.0, 1.0], [0, scenes], color=style.FRAME, lw=1.0)
    heading = "Evaluations an impact, of the two cheapest that suffice"
    corner(sheet, (LEFT, bottom, sheet.wide - 15, top), heading)
    for i, middle in enumerate(middles):
        row = data.isel(scene=i)
        errors = _seen(row["error"].values / float(row["limit"]), -16)
        missed = row["missed"].values > 0
        for family, error, hollow in zip(data["family"].values, errors, missed, strict=True):
            panel.dots(error, middle, _style(family)[0], hollow=hollow)
        circles = np.where(missed, " \N{WHITE CIRCLE}", "")
        named = list(zip(row["evaluations"].values, row["name"].values, circles, strict=True))
        best = int(row["cheapest"])
        others = [named[j] for j in np.flatnonzero(row["good"].values) if j != best]
        second = "{1}: {0:.0f}{2}".format(*min(others)) if others else "no other"
        y = float(panel.place(1.0, middle)[1][0])
        for shift, text in ((14, "{1} {0:.1f}".format(*named[best])), (-16, second)):
            sheet.text(740, y + shift, _written(text), ha="left", va="center", size=7.0)
    key(sheet, [*_families(data), ("impacts missed", style.FRAME, "o", True)], bottom - 140, 2)
    return sheet.figure


@style.pinned()
def verdicts(data):
    """Share of wrong verdicts against impacts an orbit, for both sets of cells.

    Bars: one standard error of the share.

    Parameters
    ----------
    data : xarray.Dataset
        Of study.verdicts.

    Returns
    -------
    matplotlib.figure.Figure
    """
    sheet, top = _sheet(1275)
    ticks = log10(data["length"].values).tolist()
    names = [f"{length:,}" for length in data["length"].values.tolist()]
    across = Axis((2.3, 4.0), ticks, "Impacts an orbit, mean", True, names)
    up = Axis((-2.75, -0.75), (-2, -1), "", True, ("1 %", "10 %"))
    orbits = data.attrs["orbits"] * data.sizes["cell"]
    for row, axis in enumerate((across.blank(), across)):
        frame = (LEFT, top - 420 - row * 500, RIGHT, top - row * 500)
        panel = Panel(sheet, frame, axis, up)
        minor(panel, across=False)
        title = f"Wrong verdicts, {data['cells'].values[row]}"
        sheet.text(LEFT, frame[3] + 4 * POINT, title, ha="left", va="bottom", size=7.0)
        if row == 1:
            corner(sheet, frame, "bars: \N{PLUS-MINUS SIGN} one standard error")
        for i, name in enumerate(data["name"].values):
            color, marker = VERDICTS[name]
            cost, wrong = data["cost"].values[row, i], data["wrong"].values[row, i]
            error = np.sqrt(wrong * (1.0 - wrong) / orbits)
            shown = np.maximum((wrong, wrong - error, wrong + error), 10.0 ** up.limits[0])
            panel.line(cost, shown[0], color=color, lw=0.9)
            panel.bars(cost, *shown[1:], color=color, lw=0.6)
            panel.dots(cost, shown[0], color, marker=marker)
    entries = [(name, *VERDICTS[name], False) for name in data["name"].values]
    key(sheet, entries, top - 1070, 2)
    return sheet.figure


def _sheet(least):
    """A sheet of at least this height in pixels, and the upper end of its first frame."""
    high = 75 * math.ceil(least / 75)  # whole quarters of an inch
    return Sheet(style.COLUMN, high), high - 70


def _from_zero(low, high, name):
    """An axis of decades whose lower end stands for zero."""
    ticks = [low, *range(-(-(low + 2) // 4) * 4, high + 1, 4)]
    labels = ["0", *(rf"$10^{{{tick}}}$" for tick in ticks[1:])]
    return Axis((low, high), ticks, name, True, labels)


def _seen(values, zero):
    """Values for such an axis: zeros at its end."""
    return np.maximum(values, float(f"1e{zero}"))


def _families(data):
    """The key's entries, one a family of methods: name, colour, mark, not hollow."""
    names = dict.fromkeys(data["family"].values)
    return [(_written(family), *_style(family), False) for family in names]


def _methods(data):
    """The same, one a method."""
    pairs = zip(data["name"].values, data["family"].values, strict=True)
    return [(_written(name), *_style(family, name), False) for name, family in pairs]


def _alike(data):
    """As `_methods`, one entry for the scans of one tolerance: their steps cannot be told apart."""
    entries, names, scans = _methods(data), data["name"].values.tolist(), {}
    for i, name in enumerate(names):
        if name.startswith("scan "):
            scans.setdefault(name.partition(", ")[2], []).append(i)
    for tolerance, places in scans.items():
        if len(places) > 1:
            first, last = (_step(names[i]) for i in (places[0], places[-1]))
            text = _written(f"scan {first} to {last}, {tolerance}")
            for i in places:
                entries[i] = (text, style.BLUE, "o", False)
    return entries


def _step(name):
    """The step of a scan, "scan STEP, TOLERANCE"."""
    return name.partition(", ")[0].removeprefix("scan ")


def _written(name):
    """A method's name with powers of ten and relations as they are printed."""
    return re.sub(r"1e-0?(\d+)", r"$10^{-\1}$", name).replace("<=", "\N{LESS-THAN OR EQUAL TO}")


def _style(family, name=""):
    """The colour and mark of a family or a method; those of a new one until it has its own."""
    color, marker = STYLES.get(family, (style.FRAME, "o"))
    return SINGLE.get(name, color), marker


CHARTS = {f.__name__: f for f in (work, edges, energy, separation, figure_errors, verdicts)}


def draw(chart, data):
    """Return the Figure of a chart: it has the name of one of CHARTS and its arguments."""
    return CHARTS[chart["chart"]](data, *chart["arguments"])
