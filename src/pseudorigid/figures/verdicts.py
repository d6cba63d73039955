"""The speed-accuracy chart of the atlas: wrong verdicts on orbits against what they cost."""

import numpy as np

from .axes.panel import Axis, Panel, key, log10
from .canvas import style
from .canvas.sheet import POINT, Sheet

LOOKS = {
    "growth, below 3": (style.BLACK, "s"),
    "growth": (style.BLUE, "o"),
    "SALI": (style.GREEN, "D"),
    "winding number": (style.ORANGE, "^"),
    "as soon as safe": (style.VERMILION, "o"),
}
_LEAST = 1e-4  # a share that is drawn where there is none
LEFT, RIGHT = 150, 1010


@style.pinned()
def verdicts(data):
    """Share of wrong verdicts against impacts an orbit, for both sets of cells.

    `data` is the dataset of study.verdicts. The bars are one standard error of the share.
    """
    sheet = Sheet(style.COLUMN, 1350)
    top = sheet.high - 90
    ticks = tuple(log10([250, 500, 1000, 2000, 4000, 8000]).tolist())
    names = "250", "500", "1,000", "2,000", "4,000", "8,000"
    across = Axis((2.3, 4.0), ticks, "Impacts an orbit, on average", True, names)
    blank = Axis(across.limits, ticks, "", True, ("",) * len(ticks))
    up = Axis((-3.0, -1.0), (-3, -2, -1), "", True, ("0.1 %", "1 %", "10 %"))
    count = data.attrs["orbits"] * data.sizes["cell"]
    for i, axis in enumerate((blank, across)):
        frame = (LEFT, top - 450 - i * 540, RIGHT, top - i * 540)
        panel = Panel(sheet, frame, axis, up)
        title = f"Wrong verdicts, {data['cells'].values[i]}"
        sheet.text(LEFT, frame[3] + 4 * POINT, title, ha="left", va="bottom", size=7.0)
        for m, name in enumerate(data["name"].values):
            color, marker = LOOKS[str(name)]
            cost, wrong = data["cost"].values[i, m], data["wrong"].values[i, m]
            error = np.sqrt(wrong * (1.0 - wrong) / count)
            panel.line(cost, np.maximum(wrong, _LEAST), color=color, lw=0.9)
            for x, y, spread in zip(cost, wrong, error, strict=True):
                ends = [max(y - spread, _LEAST), max(y + spread, _LEAST)]
                panel.line([x, x], ends, color=color, lw=0.6)
            panel.dots(cost, np.maximum(wrong, _LEAST), color, marker=marker, size=3.0)
    entries = [(str(name), *LOOKS[str(name)], False) for name in data["name"].values]
    key(sheet, entries, 100, 130, 930, 2)
    return sheet.figure
