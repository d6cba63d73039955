"""The regular share of maps that keep area, the reversor, both, or neither, a row for each."""

import numpy as np
import xarray as xr

from pseudorigid.figures.axes.limits import linear
from pseudorigid.figures.axes.panel import Axis, Window, key, letters, log10, title
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import Sheet

from . import Figure, Frame, Scene
from .control import FORMS, KEPT, UNCHANGED

_SPANS = (120, 535), (605, 1020)  # pixels: left and right of the columns
_HIGH, _APART = 210, 275  # pixels: the height of a panel, and from one to the next below
_HUES = dict(zip(FORMS, (style.BLACK, style.GREEN, style.ORANGE), strict=True))


@style.pinned()
def draw(scene: Scene, control: xr.Dataset) -> Figure:
    """Draw the regular share against the strength, and against the number of impacts."""
    sheet = Sheet(style.COLUMN, 1350)
    sheet.text(1020, sheet.high - 32, style.setting(scene), ha="right", va="center", size=7.0)
    sheet.text(120, sheet.high - 32, "Regular share of maps that keep", size=8.0)
    regular = control.sel({"class": "regular"})
    shares = np.stack([regular[f"class_{name}"].values for name in ("share", "low", "high")])
    at = int(np.argmin(np.abs(control["strength"].values - control.attrs["shown"])))
    strengths, lengths = control["strength"].values[1:], control["length"].values.astype(float)
    up = linear(-0.01, min(1.03, 1.1 * float(shares.max()) + 0.02), 4)
    text = rf"Impacts, $\epsilon$ = {style.number(control.attrs['shown'])}"
    columns = (
        (strengths, shares[:, :, 1:, -1], _logarithmic(strengths, r"Strength $\epsilon$")),
        (lengths, shares[:, :, at], _logarithmic(lengths, text)),
    )
    unchanged = float(shares[0, 0, 0, -1])
    frames: list[Frame] = []
    for row, (kept, text) in enumerate(KEPT.items()):
        for (left, right), (values, estimates, axis) in zip(_SPANS, columns, strict=True):
            top = sheet.high - 105 - row * _APART
            frames.append((left, top - _HIGH, right, top))
            across = axis if row == len(KEPT) - 1 else axis.blank()
            height = up if left == _SPANS[0][0] else up.blank()
            panel = Window(sheet, frames[-1], across, height)
            panel.line([1e-9, 1e9], [unchanged] * 2, color=style.BACKDROP, lw=1.2, ls="--")
            for i, name in enumerate(control["map"].values.tolist()):
                form, _, own = name.partition(" ")
                if own == kept:
                    value, low, high = estimates[:, i]
                    panel.line(values, value, color=_HUES[form], lw=0.5)
                    panel.bars(values, low, high, color=_HUES[form], lw=0.7)
                    panel.dots(values, value, _HUES[form], 3.0, marker=FORMS[form])
            title(sheet, frames[-1], text)
    letters(sheet, *frames)
    entries = [(form, _HUES[form], mark, False, 3.4) for form, mark in FORMS.items()]
    key(sheet, [*entries, (UNCHANGED, style.BACKDROP, "", True, 1.2)], 65, 4, 120, 900, 7.0)
    return sheet.figure


def _logarithmic(values: np.ndarray, name: str) -> Axis:
    """Return a logarithmic axis with a tick at each value."""
    logs = log10(values)
    room = max(0.08 * float(logs[-1] - logs[0]), 0.1)
    texts = [style.number(value) for value in values]
    return Axis((logs[0] - room, logs[-1] + room), logs.tolist(), name, True, texts)
