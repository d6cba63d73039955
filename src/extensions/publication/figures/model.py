"""The ball at rest, between impacts and at one, in proportion: Figure 1 of the paper."""

from typing import Any

import xarray as xr
from matplotlib.figure import Figure

from pseudorigid.figures.axes.section import circle
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import POINT, Sheet

_HIGH, _FLOOR, _ROOM = 600, 165, 350  # pixels; the last is the height that the balls may take
_CENTRES = 187, 519, 851  # pixels: the middles of the three parts
_LARGEST = 122.0  # pixels: radius of the ball
_NAMES = "reference configuration", "between impacts", "impact"
_SIZE, _SMALL = 9.0, 7.5  # points
_GUIDE = {"color": style.BACKDROP, "lw": 0.5}


@style.pinned()
def draw(scene: dict[str, Any], motion: xr.Dataset) -> Figure:
    """Draw the undeformed ball, and the last and the first state of a motion, which is an impact.

    A dashed circle is the undeformed ball around the same centre.
    """
    sheet = Sheet(style.COLUMN, _HIGH)
    drawn = [[float(motion[name][i]) for name in ("position", "strain")] for i in (-1, 0)]
    states = [[0.0, 0.0], *drawn]
    radius = min(_LARGEST, _ROOM / max(2.0 - x + max(u, 0.0) for x, u in states))
    rest, right = _FLOOR + radius, style.COLUMN - 20
    sheet.draw([20, right], [_FLOOR, _FLOOR], color=style.FRAME, lw=1.0)
    for left in range(20, right - 20, 24):
        sheet.draw([left, left + 16], [_FLOOR - 16, _FLOOR], **_GUIDE)
    sheet.text(356, _FLOOR - 36, "floor", 7.0, ha="center")
    sheet.draw([_CENTRES[0], right], [rest, rest], ls=(0, (1, 2)), **_GUIDE)
    cosine, sine = circle()
    for middle, letter, name, (x, u) in zip(_CENTRES, "abc", _NAMES, states, strict=True):
        centre, top = rest - radius * x, rest + radius * (1.0 + u - x)
        across = middle + radius * cosine
        sheet.text(middle, 88, rf"$\mathbf{{({letter})}}$ {name}", _SMALL, ha="center")
        values = (f"${n}$ = {style.number(round(value, 2))}" for n, value in (("x", x), ("u", u)))
        sheet.text(middle, 44, ", ".join(values), 7.0, ha="center")
        if letter != "a":
            undeformed = centre + radius * sine
            sheet.draw(across, undeformed, color=style.FRAME, lw=0.6, ls=(0, (4, 3)))
            at = middle + 1.2 * radius
            sheet.draw([middle, at + 10], [centre, centre], **_GUIDE)
            _arrow(sheet, at, rest, centre, "$x$", style.BLUE)
            at = middle - 1.05 * radius
            for end in (centre + radius, top):
                sheet.draw([at - 10, middle], [end, end], **_GUIDE)
            _arrow(sheet, at, centre + radius, top, "$Ru$", style.VERMILION, "right")
        sheet.draw(across, centre + radius * (1.0 + u) * sine, color=style.BLACK, lw=1.2)
        sheet.dots([middle], [centre], style.BLACK, 3.0, zorder=4)
    middle, part = _CENTRES[0], 0.7071 * radius
    sheet.draw([middle, middle - part], [rest, rest - part], color=style.FRAME, lw=0.6)
    sheet.text(middle - 0.42 * radius, rest - 0.22 * radius, "$R$", _SIZE, ha="center")
    sheet.text(middle + POINT, rest + 2 * POINT, "$O$", _SIZE, va="bottom")
    _arrow(sheet, 60, _HIGH - 60, _HIGH - 130, "$g$", style.BLACK)
    sheet.text(right, _HIGH - 30, style.setting(scene), 7.0, ha="right")
    return sheet.figure


def _arrow(
    sheet: Sheet, x: float, start: float, end: float, name: str, color: str, side: str = "left"
) -> None:
    """Draw an upright arrow with its name beside it; `side` is the alignment of the name."""
    size = min(14.0, 0.6 * abs(end - start))
    sheet.draw([x, x], [start, end], color=color, lw=1.0, zorder=3)
    back = end - size if end > start else end + size
    tip = [x - 0.4 * size, x, x + 0.4 * size], [back, end, back]
    sheet.draw(*tip, color=color, lw=1.0, zorder=3)
    beside = x + 3 * POINT if side == "left" else x - 3 * POINT
    sheet.text(beside, 0.5 * (start + end), name, _SIZE, ha=side)
