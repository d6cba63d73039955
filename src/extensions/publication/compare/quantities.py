"""Reported quantities over a range of variants: tables, and curves of those that are numbers."""

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from pipeline.config.results import Range
from pipeline.records.differences import columns
from pseudorigid.figures.axes.limits import around
from pseudorigid.figures.axes.panel import Axis, Panel
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import Sheet

Reported = Mapping[str, Mapping[str, str]]  # variant -> quantity -> its value as text
# of the CSV file
COLUMNS = ("figure", "quantity", "variant", "value", "number", "standard deviation", "text")
_NUMBER = re.compile(r"(-?\d[\d,]*(?:\.\d+)?(?:e[-+]\d+)?)(?:, standard deviation (\S+))?")
# pixels: height of a panel, the space above each and below them all, and ends from left to right
_HIGH, _ROOM, _BELOW, _LEFT, _RIGHT = 210, 75, 110, 180, 1005


def number(text: str) -> tuple[float, float] | None:
    """Return the number that a text is and its standard deviation, NaN without one, else None."""
    if not (match := _NUMBER.fullmatch(text)):
        return None
    value, deviation = match.groups("nan")
    return float(value.replace(",", "")), float(deviation)


def table(of: Range, reported: Reported) -> Iterator[str]:
    """Yield a line for each variant that has the figure, and a line for what all report alike."""
    each = [
        {name: text.replace(", standard deviation ", " ± ") for name, text in quantities.items()}
        for quantities in reported.values()
    ]
    names = dict.fromkeys(name for quantities in each for name in quantities)
    alike = [n for n in names if len({quantities.get(n) for quantities in each}) == 1]
    shown = [name for name in names if name not in alike]
    texts = [[quantities.get(name, "") for name in shown] for quantities in each]
    values = [str(of.members[member]) for member in reported]
    yield from columns([(of.path, *shown), *((v, *t) for v, t in zip(values, texts, strict=True))])
    yield from (f"{name}: {each[0][name]}, for each" for name in alike)


def rows(of: Range, scene: str, reported: Reported) -> Iterator[tuple[object, ...]]:
    """Yield a row of the CSV file for each variant and quantity of a figure."""
    for member, each in reported.items():
        for name, text in each.items():
            known = number(text) or (None, None)
            yield scene, name, member, of.members[member], *known, text


@style.pinned()
def curves(of: Range, reported: Reported) -> Figure | None:
    """Draw each number that differs between the variants against the value, with its deviation."""
    numbers = {
        name: [number(each.get(name, "")) for each in reported.values()]
        for name in dict.fromkeys(n for each in reported.values() for n in each)
    }
    drawn = {n: found for n, found in numbers.items() if len({*filter(None, found)}) > 1}
    if not drawn:
        return None
    values: list[Any] = [of.members[member] for member in reported]
    across = _across(values, of.path)
    high = _BELOW + len(drawn) * (_HIGH + _ROOM)
    sheet = Sheet(style.COLUMN, high + -high % 75)  # whole quarters of an inch
    top = sheet.high - _ROOM
    for i, (name, found) in enumerate(drawn.items()):
        value, deviation = np.array([each or (np.nan, np.nan) for each in found]).T
        text = f"{name} and standard deviation" if np.isfinite(deviation).any() else name
        ends = value - np.nan_to_num(deviation), value + np.nan_to_num(deviation)
        below = across if i == len(drawn) - 1 else across.blank()
        up = around(ends, 0.1, 3, text)
        panel = Panel(sheet, (_LEFT, top - _HIGH, _RIGHT, top), below, up)
        x = np.array(values if across.labels is None else range(len(values)))
        panel.estimates(x, value, *ends, style.BLUE)
        top -= _HIGH + _ROOM
    return sheet.figure


def _across(values: Sequence[Any], path: str) -> Axis:
    """Return the axis of the values, which may be texts."""
    if all(isinstance(value, int | float) for value in values):
        return around(values, 0.05, 5, path)
    return Axis((-0.5, len(values) - 0.5), range(len(values)), path, labels=[*map(str, values)])
