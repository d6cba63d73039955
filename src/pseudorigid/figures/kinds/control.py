"""Regular orbits of maps that keep area, are reversible, both, or neither."""

import numpy as np

from ..axes.limits import decades, linear
from ..axes.panel import Axis, Window, key, log10, title
from ..canvas import style
from ..canvas.sheet import POINT, Sheet

_LEFT, _RIGHT, _HALF = 120, 1010, 375  # pixels: left, right, and the width of a chart
_CLASSES = (("regular", style.BLUE), ("spiral", style.VERMILION), ("chaotic", style.SEA))
_UNCHANGED = "the impact map"
# What a changed map keeps, in the order of the portraits' columns.
_KEPT = {
    "both": ("area, reversor", style.BLACK),
    "area": ("area alone", style.PURPLE),
    "reversor": ("reversor alone", style.GREEN),
    "neither": ("neither", style.ORANGE),
}
_FORMS = {"twist": "o", "stir": "s", "shift": "^"}  # in the order of the portraits' rows
_ROWS = 1040, 655, 270  # pixels: the bottoms of the charts' rows
_HIGH = 225  # pixels: the height of a chart
_LONG = 5  # digits of numbers of impacts that fit beside one another
_SIDE = 222  # pixels: the side of a portrait


@style.pinned()
def draw(scene, control):
    """Draw portraits of the maps, and shares, exponents and rates against the strength."""
    sheet = Sheet(style.COLUMN, 2325)
    drawn = set(control["kind"].values.ravel().tolist())
    entries = [(*_CLASSES[kind], "o", False, 3.0) for kind in range(3) if kind in drawn]
    key(sheet, entries, sheet.high - 32, 5, 45, 800, 7.0)
    sheet.text(_RIGHT, sheet.high - 32, style.setting(scene), ha="right", va="center", size=7.0)
    _portraits(sheet, control)
    _charts(sheet, control)
    entries = [(text, hue, "o", False, 3.4) for text, hue in _KEPT.values()]
    entries += [(form, style.BLACK, mark, True, 3.4) for form, mark in _FORMS.items()]
    entries.append((_UNCHANGED, style.BACKDROP, "", True, 1.2))
    key(sheet, entries, 105, 4, _LEFT - 90, 990, 7.0)
    sheet.text(
        _LEFT - 90, 25, "colours: what is kept; marks: form of the change; bars: 95 %", size=7.0
    )
    return sheet.figure


def _portraits(sheet, control):
    """Draw the orbits of each panel, chaotic ones first."""
    from ...kernel.arithmetic import sincos_each

    bottom = 0.0
    for i, name in enumerate(control["panel"].values.tolist()):
        form, _, kept = name.partition(" ")
        row = len(_FORMS) - 1 if name == "none" else list(_FORMS).index(form)
        left = 45 + (0 if name == "none" else list(_KEPT).index(kept)) * (_SIDE + 24)
        bottom = sheet.high - 110 - row * (_SIDE + 62) - _SIDE
        unit = Axis((-1.04, 1.04), ())
        panel = Window(sheet, (left, bottom, left + _SIDE, bottom + _SIDE), unit, unit)
        sine, cosine = sincos_each(np.arange(181) * (np.pi / 90.0))
        panel.line(cosine, sine, color=style.RIM, lw=0.5)
        kinds = control["kind"].values[i]
        for kind in (2, 1, 0):
            a, b = (control[axis].values[i][kinds == kind].ravel() for axis in "ab")
            panel.dots(a, b, _CLASSES[kind][1], 0.35 if kind == 2 else 0.7)
        text = _UNCHANGED if name == "none" else f"{form}: {_KEPT[kept][0]}"
        title(sheet, panel.frame, text, size=6.2)
    text = rf"the changed maps at strength $\epsilon$ = {style.number(control.attrs['shown'])}"
    sheet.text(_RIGHT, bottom - 4 * POINT, text, ha="right", va="top", size=7.0)


def _charts(sheet, control):
    """Draw shares, exponents and rates."""
    strength = control["strength"].values[1:]
    logs = log10(strength)
    low, high = float(logs.min()), float(logs.max())
    room = max(0.08 * (high - low), 0.15)
    if np.ceil(low - 1e-9) + 1 > np.floor(high + 1e-9):  # there would be fewer than two ticks
        low, high = float(np.floor(low)), float(np.ceil(high + 1e-9))
    across = decades((low - room, high + room), r"Strength $\epsilon$")
    blank = across.blank()
    left, right = ((at, at + _HALF) for at in (_LEFT, _RIGHT - _HALF))
    frames = [(a, bottom, b, bottom + _HIGH) for bottom in _ROWS for a, b in (left, right)]
    last = control.isel(length=-1)
    regular, spiral = (
        [last[f"class_{name}"].sel({"class": kind}).values for name in ("share", "low", "high")]
        for kind in ("regular", "spiral")
    )
    exponent, attraction, rate = (
        [control[f"{name}{end}"].values for end in ("", "_low", "_high")]
        for name in ("exponent", "attraction", "rate")
    )
    attraction = [-values for values in attraction]
    for frame, axis, up, text, estimate in (
        (frames[0], blank, _share_axis(regular[2]), "Regular share", regular),
        (frames[1], blank, linear(0.0, 1.0, 5), "Share of spirals", spiral),
        (frames[2], blank, _axis_to(exponent[2]), "Exponent of chaotic orbits", exponent),
        (frames[3], across, _axis_to(attraction[1]), "Contraction of area on spirals", attraction),
    ):
        panel = _chart(sheet, frame, axis, up, text)
        unchanged = estimate[0][0, 0]
        if np.isfinite(unchanged):
            limits = [10.0 ** axis.limits[0], 10.0 ** axis.limits[1]]
            panel.line(limits, [unchanged] * 2, color=style.BACKDROP, lw=1.2, ls="--")
        _maps(panel, control, strength, [part[:, 1:] for part in estimate])
    rate = [part[:, 1:, 0] / strength for part in rate]
    finite = np.abs(rate[0][np.isfinite(rate[0])])
    most = 1.15 * float(finite.max()) if finite.size else 1.0
    up = linear(-most, most, 5)
    panel = _chart(sheet, frames[4], across, up, r"Rate at the fixed point, / $\epsilon$")
    panel.line([1e-9, 1.0], [0.0, 0.0], color=style.FRAME, lw=0.4)
    _maps(panel, control, strength, rate, joined=False)
    _lengths(sheet, frames[5], control)


def _chart(sheet, frame, across, up, text, minor_across=True):
    """Return a chart with its title above it."""
    panel = Window(sheet, frame, across, up)
    panel.minor(minor_across)
    title(sheet, frame, text)
    return panel


def _axis_to(values):
    """Return an axis from 0 to above the largest of some values."""
    finite = values[np.isfinite(values)]
    return linear(0.0, 1.08 * float(finite.max()) if finite.size and finite.max() > 0.0 else 1.0, 4)


def _share_axis(values):
    """Return an axis from 0 to above the largest share."""
    return linear(-0.01, min(1.03, 1.1 * float(values.max()) + 0.02), 5)


def _maps(panel, control, at, estimate, apart=1.04, joined=True):
    """Draw the changed maps' values with intervals, (map, abscissa), side by side."""
    for i, name in enumerate(control["map"].values.tolist()):
        form, _, kept = name.partition(" ")
        hue, mark = _KEPT[kept][1], _FORMS[form]
        beside = at * apart ** (i - 4.5)
        value, low, high = (part[i] for part in estimate)
        if joined:
            panel.line(beside, value, color=style.pale(hue), lw=0.8)
        panel.bars(beside, low, high, color=hue, lw=0.7)
        shown = np.isfinite(value)
        panel.dots(beside[shown], value[shown], hue, 3.0, False, mark)


def _lengths(sheet, frame, control):
    """Draw the regular share against the number of impacts at the strength that is shown."""
    lengths = control["length"].values.astype(float)
    logs = log10(lengths)
    texts = [style.number(int(n)) for n in lengths]
    if len(texts[-1]) > _LONG:
        texts[1:-1] = [""] * (len(texts) - 2)
    limits = float(logs[0]) - 0.1, float(logs[-1]) + 0.1
    across = Axis(limits, logs.tolist(), "Number of impacts", True, texts)
    at = int(np.argmin(np.abs(control["strength"].values - control.attrs["shown"])))
    kind = control.sel({"class": "regular"})
    estimate = [kind[f"class_{name}"].values[:, at] for name in ("share", "low", "high")]
    text = rf"Regular share, $\epsilon$ = {style.number(control.attrs['shown'])}"
    up = _share_axis(estimate[2])
    panel = _chart(sheet, frame, across, up, text, minor_across=False)
    _maps(panel, control, lengths, estimate, 1.02)
