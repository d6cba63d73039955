"""The charts of the study: work and precision, where methods fail, and what a scene needs."""

import numpy as np

from .axes.panel import Axis, Panel, key
from .canvas import style
from .canvas.sheet import POINT, Sheet

# A colour and a mark for each family of methods; what is near in kind is near in colour.
LOOKS = {
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
LEFT, RIGHT = 150, 1010


def _look(family):
    return LOOKS.get(family, (style.FRAME, "o"))


def _families(data):
    """(family, places of its methods) in the order of first appearance."""
    found = {}
    for i, family in enumerate(data["family"].values):
        found.setdefault(str(family), []).append(i)
    return found.items()


@style.pinned()
def work(data, which, cost):
    """Error and failures against cost ("evaluations" or "seconds") over the states of set `which`.

    `data` is the artifact of work.counted or work.measured. Filled: the median error; hollow: the
    worst of the right roots; below: the share of wrong roots.
    """
    families = [(family, np.array(places)) for family, places in _families(data)]
    rows = -(-len(families) // 2) + 1
    sheet = Sheet(style.COLUMN, 75 * (-(-(1050 + rows * 42) // 75)))
    top = sheet.high - 70
    names = {
        "evaluations": ("Evaluations a flight", (0, 5), range(6)),
        "seconds": ("Seconds a flight", (-8, 0), range(-8, 1)),
    }
    name, limits, ticks = names[cost]
    blank = Axis(limits, tuple(ticks), "", True, tuple("" for _ in ticks))
    error = Axis((-17, 0), tuple(range(-16, 1, 4)), "Relative error of the flight time", True)
    upper = Panel(sheet, (LEFT, top - 560, RIGHT, top), blank, error)
    across = Axis(limits, tuple(ticks), name, True)
    share = Axis((0.0, 0.6), (0, 0.2, 0.4, 0.6), "Share of wrong roots")
    lower = Panel(sheet, (LEFT, top - 830, RIGHT, top - 630), across, share)
    for family, places in families:
        color, marker = _look(family)
        x = data[cost].values[places, which]
        median = np.maximum(data["median"].values[places, which], 1e-17)
        worst = np.maximum(data["worst"].values[places, which], 1e-17)
        upper.line(x, median, color=color, lw=0.9)
        upper.line(x, worst, color=color, lw=0.5, ls="--")
        upper.dots(x, worst, color, hollow=True, marker=marker)
        upper.dots(x, median, color, marker=marker)
        if cost == "seconds":
            spread = (
                data["seconds_low"].values[places, which],
                data["seconds_high"].values[places, which],
            )
            for low, high, y in zip(*spread, median, strict=True):
                upper.line([low, high], [y, y], color=color, lw=1.6)
        wrong = data["wrong"].values[places, which]
        lower.line(x, wrong, color=color, lw=0.9)
        lower.dots(x, wrong, color, marker=marker)
    entries = [(family, *_look(family), False) for family, _ in families]
    entries += [("median", style.FRAME, "", False), ("worst right root", style.FRAME, "", True)]
    key(sheet, entries, 60, top - 960, 960, 2)
    return sheet.figure


@style.pinned()
def edges(data):
    """Failing share against the distance from grazing, and against the height of a maximum.

    `data` is the artifact of fails.edges. Above x = -g a ball that grazes comes back at once,
    below it leaves.
    """
    count = data.sizes["method"]
    sheet = Sheet(style.COLUMN, 975 + 75 * (-(-(-(-count // 2) * 42) // 75)))
    top = sheet.high - 70
    middle = 40
    half = (RIGHT - LEFT - middle) / 2
    grazing = ("near", "distance", ("$x > -g$", "$x < -g$"), r"$\dot{x}^-+\dot{u}^-$", (-12, 0))
    touch = (
        "touch",
        "depth",
        ("it just touches", "it just misses"),
        "Height of the gap's maximum, + or −",
        (-14, -2),
    )
    for row, (variable, along, sides, name, limits) in enumerate((grazing, touch)):
        values = np.array([float(f"1e-{int(e)}") for e in data[along].values])
        ticks = tuple(range(limits[0], limits[1], 4))
        for side in range(2):
            left = LEFT + side * (half + middle)
            frame = (left, top - 300 - row * 450, left + half, top - row * 450)
            up = Axis((0, 1), (0, 0.5, 1), "", labels=None if side == 0 else ("", "", ""))
            panel = Panel(sheet, frame, Axis(limits, ticks, "", True), up)
            text = f"Share failing, {sides[side]}" if side == 0 else sides[side]
            if side:
                x, y = left - middle / 2, frame[1] - 16 * POINT
                sheet.text(x, y, name, ha="center", va="top", size=7.0)
            sheet.text(left, frame[3] + 4 * POINT, text, ha="left", va="bottom", size=7.0)
            for i in range(count):
                color, marker = _one(data, i)
                share = data[variable].values[i, side]
                panel.line(values, share, color=color, lw=0.9)
                panel.dots(values, share, color, size=2.6, marker=marker)
    key(sheet, _methods(data), 60, top - 890, 960, 2)
    return sheet.figure


def _one(data, i):
    """Colour and mark of one method."""
    color, marker = _look(str(data["family"].values[i]))
    return SINGLE.get(str(data["name"].values[i]), color), marker


def _methods(data):
    """The key's entries, one a method."""
    return [(str(name), *_one(data, i), False) for i, name in enumerate(data["name"].values)]


@style.pinned()
def energy(data):
    """Energy drift along each method's orbit, and impacts missed against the drift at its end.

    `data` is the artifact of fails.orbits. In the shaded part the energy is kept to 1e-6: a check
    sees nothing.
    """
    sheet = Sheet(style.COLUMN, 1350)
    top = sheet.high - 70
    count = Axis((0, 6), tuple(range(7)), "Impacts", True)
    drift = Axis(
        (-17, 1), tuple(range(-16, 1, 4)), "Largest relative error of the energy so far", True
    )
    upper = Panel(sheet, (LEFT, top - 430, RIGHT, top), count, drift)
    across = Axis(
        (-13, 1),
        tuple(range(-12, 1, 2)),
        "Largest relative error of the energy after all impacts",
        True,
    )
    missed_axis = Axis(
        (-1, 4),
        tuple(range(-1, 5)),
        "Impacts missed in a million",
        True,
        ("0", *(rf"$10^{e}$" for e in range(5))),
    )
    lower = Panel(sheet, (LEFT, 330, RIGHT, 670), across, missed_axis)
    x0, y0 = lower.place(1e-13, 0.1)
    x1, y1 = lower.place(1e-6, 1e4)
    left, right, bottom, up = float(x0[0]), float(x1[0]), float(y0[0]), float(y1[0])
    sheet.draw(
        [(left + right) / 2] * 2,
        [bottom, up],
        lw=(right - left) / POINT,
        color="#fbeedd",
        zorder=0.1,
    )
    for i in range(data.sizes["method"]):
        color, marker = _one(data, i)
        values = data["drift"].values[i]
        upper.line(data["record"].values, np.maximum(values, 1e-17), color=color, lw=0.9)
        missed = max(float(data["missed"].values[i]), 0.1)
        lower.dots(values[-1], missed, color, marker=marker)
        if i in (0, 1):
            lower.note(values[-1], missed, str(data["name"].values[i]), shift=(3, 3.5))
    lower.note(1.5e-13, 3e3, "a check to $10^{-6}$ sees nothing")
    key(sheet, _methods(data), 60, 190, 960, 3)
    return sheet.figure


@style.pinned()
def apart(data):
    """How far each method's orbit is from the judge's, impact by impact; `data` as in `energy`."""
    sheet = Sheet(style.COLUMN, 975)
    top = sheet.high - 70
    across = Axis((0, 170), (0, 50, 100, 150), "Impacts")
    up = Axis(
        (-17, 0), tuple(range(-16, 1, 4)), "Median distance in $x$ from the proved orbit", True
    )
    panel = Panel(sheet, (LEFT, top - 600, RIGHT, top), across, up)
    for i in range(data.sizes["method"]):
        color, _ = _one(data, i)
        values = np.maximum(data["apart"].values[i], 1e-17)
        panel.line(data["impact"].values, values, color=color, lw=0.9)
    key(sheet, _methods(data), 60, top - 740, 960, 3)
    return sheet.figure


@style.pinned()
def needs(data):
    """Error of each picture by each method, in units of what it can hide, and what is spent.

    `data` is the artifact of needs.needs. Hollow: impacts were missed.
    """
    scenes = data.sizes["scene"]
    sheet = Sheet(style.COLUMN, 75 * (5 + scenes))
    top, step = sheet.high - 75, 75
    bottom = top - scenes * step
    names = tuple(str(name) for name in data["scene"].values)
    rows = tuple(scenes - 0.5 - i for i in range(scenes))
    up = Axis((0, scenes), rows, "", False, names)
    across = Axis(
        (-14, 6), tuple(range(-12, 5, 4)), "Error of the picture / what it can hide", True
    )
    panel = Panel(sheet, (110, bottom, 720, top), across, up)
    panel.line([1.0, 1.0], [0, scenes], color=style.FRAME, lw=1.0)
    sheet.text(740, top + 4 * POINT, "Evaluations an impact:", ha="left", va="bottom", size=6.0)
    for i in range(scenes):
        errors = data["error"].values[i] / data["limit"].values[i]
        for j, family in enumerate(data["family"].values):
            color, _ = _look(str(family))
            hollow = bool(data["missed"].values[i, j])
            panel.dots(max(errors[j], 1e-14), rows[i], color, hollow=hollow)
        cost = data["evaluations"].values[i]
        best = int(data["cheapest"].values[i])
        others = [j for j in np.flatnonzero(data["good"].values[i]) if j != best]
        y = float(panel.place(1.0, rows[i])[1][0])
        sheet.text(
            740,
            y + 12,
            f"{data['name'].values[best]} {cost[best]:.1f}",
            ha="left",
            va="center",
            size=6.0,
        )
        second = min(others, key=lambda j: cost[j], default=None)
        text = (
            "no other" if second is None else f"{data['name'].values[second]}: {cost[second]:.0f}"
        )
        sheet.text(740, y - 14, text, ha="left", va="center", size=6.0)
    entries = [(family, *_look(family), False) for family, _ in _families(data)]
    entries.append(("impacts missed", style.FRAME, "o", True))
    key(sheet, entries, 60, bottom - 140, 960, 2)
    return sheet.figure
