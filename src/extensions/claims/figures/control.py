"""The control experiment: regular orbits of maps that keep area, the reversor, both, or neither.

docs/method.md defines the three forms of change (twist, stir and shift) and the strength.
"""

import numpy as np
import xarray as xr

from pseudorigid.figures.axes.limits import linear
from pseudorigid.figures.axes.panel import Axis, Window, key, letters, log10, title
from pseudorigid.figures.axes.section import circle
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import Sheet

from . import Figure, Frame, Scene

_LEFT, _RIGHT, _HALF = 120, 1010, 375  # pixels: left, right, and the width of a chart
_CLASSES = (("regular", style.BLUE), ("spiral", style.VERMILION), ("chaotic", style.BACKDROP))
_UNCHANGED = "the impact map"
# What a changed map keeps, the colour, whether marks are hollow, and dashes between them. All but
# the first have a column of portraits, in this order.
_KEPT = {
    "both": ("area, reversor", style.BLACK, False, "-"),
    "area": ("area alone", style.SKY, True, "--"),
    "reversor": ("reversor alone", style.GREEN, False, "-."),
    "neither": ("neither", style.BLACK, True, ":"),
}
_FORMS = {"twist": "o", "stir": "s", "shift": "^"}  # in the order of the portraits' rows
_ROWS = 750, 350  # pixels: the bottoms of the charts' rows
_HIGH = 240  # pixels: the height of a chart
_LONG = 5  # digits of numbers of impacts that fit beside one another
_SIDE, _APART = 282, 346  # pixels: the side of a portrait, and from one to the next below


@style.pinned()
def draw(scene: Scene, control: xr.Dataset) -> Figure:
    """Draw portraits of maps, and shares and rates of all maps against the strength."""
    sheet = Sheet(style.COLUMN, 2325)
    drawn = set(control["kind"].values.ravel().tolist())
    entries = [(*_CLASSES[kind], "o", False, 3.0) for kind in range(3) if kind in drawn]
    key(sheet, entries, sheet.high - 32, 3, _LEFT, 450, 7.0)
    sheet.text(_RIGHT, sheet.high - 32, style.setting(scene), ha="right", va="center", size=7.0)
    text = "$a$, $b$: $x$ and $y$ from the centre of the section, over its half axes\n"
    text += rf"changed maps: strength $\epsilon$ = {style.number(control.attrs['shown'])}"
    sheet.text(_LEFT, _ROWS[0] + _HIGH + 110, text, size=7.0)
    letters(sheet, _portraits(sheet, control), *_charts(sheet, control))
    entries = [(text, hue, "o", hollow, 3.4) for text, hue, hollow, _ in _KEPT.values()]
    entries += [(form, style.FRAME, mark, False, 3.4) for form, mark in _FORMS.items()]
    entries.append((_UNCHANGED, style.BACKDROP, "", True, 1.2))
    key(sheet, entries, 185, 4, _LEFT - 90, 990, 7.0)
    text = "colour and filling: what is kept; shape: form of the change; bars: 95 %\n"
    text += "marks side by side: one strength (b, c, d) or one number of impacts (e)"
    sheet.text(_LEFT - 90, 70, text, size=7.0)
    return sheet.figure


def _portraits(sheet: Sheet, control: xr.Dataset) -> Frame:
    """Draw the orbits of each panel, chaotic ones first; return the first frame."""
    first = _LEFT, sheet.high - 105 - _SIDE, _LEFT + _SIDE, sheet.high - 105
    columns, last = [*_KEPT][1:], len(_FORMS) - 1
    for i, name in enumerate(control["panel"].values.tolist()):
        form, _, kept = name.partition(" ")
        if kept == "both":  # like the unchanged map
            continue
        # The impact map stands where "shift area" would: no shift keeps area.
        row = last if name == "none" else [*_FORMS].index(form)
        column = 0 if name == "none" else columns.index(kept)
        left, bottom = _LEFT + column * (_SIDE + 22), first[1] - row * _APART
        frame = left, bottom, left + _SIDE, bottom + _SIDE
        axis = Axis((-1.04, 1.04), (-0.5, 0, 0.5), "$a$")
        across = axis if row == last else axis.blank()
        up = axis.blank()
        if column == 0:
            up = Axis((-1.04, 1.04), (-0.5, 0, 0.5), labels=[style.number(-0.5), "$b$", "0.5"])
        panel = Window(sheet, frame, across, up, grid=False)
        panel.line(*circle(180), color=style.BLACK, lw=0.5)
        kinds = control["kind"].values[i]
        for kind in (2, 1, 0):
            a, b = (control[axis].values[i][kinds == kind].ravel() for axis in "ab")
            panel.dots(a, b, _CLASSES[kind][1], 0.5 if kind == 2 else 0.7)
        title(sheet, frame, _UNCHANGED if name == "none" else f"{form}: {_KEPT[kept][0]}")
    return first


def _charts(sheet: Sheet, control: xr.Dataset) -> list[Frame]:
    """Draw shares and rates against the strength, and shares against the length; return frames."""
    strength = control["strength"].values[1:]
    across = _strength_axis(strength)
    spans = (_LEFT, _LEFT + _HALF), (_RIGHT - _HALF, _RIGHT)
    frames: list[Frame] = [(a, bottom, b, bottom + _HIGH) for bottom in _ROWS for a, b in spans]
    last = control.isel(length=-1)
    shares = [
        ("regular", "Regular share", None),
        ("spiral", "Share of spirals", linear(0.0, 1.0, 5)),
    ]
    for frame, (kind, text, up) in zip(frames[:2], shares, strict=True):
        share = _class_shares(last, kind)
        panel = _chart(sheet, frame, across, up or _share_axis(share[2]), text)
        panel.line([1e-9, 1.0], [share[0][0, 0]] * 2, color=style.BACKDROP, lw=1.2, ls="--")
        _maps(panel, control, strength, share[:, :, 1:])
    _rates(sheet, frames[2], across, control)
    _lengths(sheet, frames[3], control)
    return frames


def _strength_axis(strength: np.ndarray) -> Axis:
    """Return a logarithmic axis with a tick at each strength."""
    logs = log10(strength)
    room = max(0.08 * float(logs[-1] - logs[0]), 0.15)
    limits = float(logs[0]) - room, float(logs[-1]) + room
    labels = [style.number(value) for value in strength]
    return Axis(limits, logs.tolist(), r"Strength $\epsilon$", True, labels)


def _class_shares(control: xr.Dataset, kind: str) -> np.ndarray:
    """Return the share of a class and the ends of its interval: (3, map, ...)."""
    of_class = control.sel({"class": kind})
    return np.stack([of_class[f"class_{name}"].values for name in ("share", "low", "high")])


def _rates(sheet: Sheet, frame: Frame, across: Axis, control: xr.Dataset) -> None:
    """Draw the growth rate of the distance from the fixed point, divided by the strength."""
    strength = control["strength"].values[1:]
    # The last index, island 0, is the fixed point.
    rate = np.stack([control[f"rate{end}"].values[:, 1:, 0] for end in ("", "_low", "_high")])
    rate = rate / strength
    most = 1.15 * float(np.nanmax(np.abs(rate[0]))) if np.isfinite(rate[0]).any() else 1.0
    text = r"Rate at the fixed point, / $\epsilon$"
    panel = _chart(sheet, frame, across, linear(-most, most, 5), text)
    panel.line([1e-9, 1.0], [0.0, 0.0], color=style.FRAME, lw=0.4)
    _maps(panel, control, strength, rate, joined=False)


def _lengths(sheet: Sheet, frame: Frame, control: xr.Dataset) -> None:
    """Draw the regular share against the number of impacts at the strength that is shown."""
    lengths = control["length"].values.astype(float)
    logs = log10(lengths)
    texts = [style.number(int(n)) for n in lengths]
    if len(texts[-1]) > _LONG:
        texts[1:-1] = [""] * (len(texts) - 2)
    limits = float(logs[0]) - 0.1, float(logs[-1]) + 0.1
    across = Axis(limits, logs.tolist(), "Number of impacts", True, texts)
    at = int(np.argmin(np.abs(control["strength"].values - control.attrs["shown"])))
    share = _class_shares(control.isel(strength=at), "regular")
    text = rf"Regular share, $\epsilon$ = {style.number(control.attrs['shown'])}"
    panel = _chart(sheet, frame, across, _share_axis(share[2]), text, minor_across=False)
    _maps(panel, control, lengths, share, 1.02)


def _chart(
    sheet: Sheet, frame: Frame, across: Axis, up: Axis, text: str, minor_across: bool = True
) -> Window:
    """Return a chart with its title above it."""
    panel = Window(sheet, frame, across, up)
    panel.minor(minor_across)
    title(sheet, frame, text)
    return panel


def _share_axis(values: np.ndarray) -> Axis:
    """Return an axis from 0 to above the largest share."""
    return linear(-0.01, min(1.03, 1.1 * float(values.max()) + 0.02), 5)


def _maps(
    panel: Window, control: xr.Dataset, at: np.ndarray, estimates: np.ndarray,
    apart: float = 1.04, joined: bool = True,
) -> None:  # fmt: skip
    """Draw values with intervals, (3, map, abscissa), of the changed maps side by side.

    Marks of neighbouring maps are apart by a factor, less if abscissae are near one another, and
    joined by lines from abscissa to abscissa.
    """
    apart = min(apart, 1.0 + 0.08 * float((at[1:] / at[:-1] - 1.0).min(initial=1.0)))
    for i, name in enumerate(control["map"].values.tolist()):
        form, _, kept = name.partition(" ")
        _, hue, hollow, dashes = _KEPT[kept]
        beside = at * apart ** (i - 4.5)
        value, low, high = estimates[:, i]
        if joined:
            panel.line(beside, value, color=hue, lw=0.5, ls=dashes)
        panel.bars(beside, low, high, color=style.FRAME, lw=0.6)
        shown = np.isfinite(value)
        panel.dots(beside[shown], value[shown], hue, 3.0, hollow=hollow, marker=_FORMS[form])
