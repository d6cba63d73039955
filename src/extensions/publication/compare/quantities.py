"""Reported quantities over a range of variants: tables, and curves of those that are numbers."""

import re
from collections.abc import Iterator, Mapping
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
COLUMNS = "figure", "quantity", "variant", "value", "number", "standard deviation", "text"
_NUMBER = re.compile(r"(-?\d[\d,]*(?:\.\d+)?(?:e[-+]\d+)?)(?:, standard deviation (\S+))?")
# pixels: height of a panel, the space above each and below them all, and ends from left to right
_HIGH, _ROOM, _BELOW, _LEFT, _RIGHT = 210, 75, 110, 180, 1005


def number(text: str) -> tuple[float, float | None] | None:
    """Return the number that a text is, with its standard deviation if it has one, else None."""
    if not (match := _NUMBER.fullmatch(text)):
        return None
    value, deviation = match.groups()
    return float(value.replace(",", "")), float(deviation) if deviation else None


def table(of: Range, reported: Reported) -> Iterator[str]:
    """Yield a line for each variant that has the figure, and a line for what all report alike."""
    each = [
        {name: text.replace(", standard deviation ", " ± ") for name, text in quantities.items()}
        for quantities in reported.values()
    ]
    names = dict.fromkeys(name for quantities in each for name in quantities if name != of.path)
    alike = [n for n in names if len({quantities.get(n) for quantities in each}) == 1]
    shown = [name for name in names if name not in alike]
    texts = [[quantities.get(name, "") for name in shown] for quantities in each]
    values = [str(of.members[member]) for member in reported]
    yield from columns([(of.path, *shown), *((v, *t) for v, t in zip(values, texts, strict=True))])
    together = ", for each" if len(each) > 1 else ""
    yield from (f"{name}: {each[0][name]}{together}" for name in alike)


def rows(of: Range, scene: str, reported: Reported) -> Iterator[tuple[object, ...]]:
    """Yield a row of the CSV file for each variant and quantity of a figure."""
    for member, each in reported.items():
        for name, text in each.items():
            known = number(text) or (None, None)
            yield scene, name, member, of.members[member], *known, text


@style.pinned()
def curves(of: Range, reported: Reported) -> Figure | None:
    """Draw each number that differs between the variants against the value, with its deviation."""
    names = dict.fromkeys(name for each in reported.values() for name in each)
    numbers = {n: [number(each.get(n, "")) for each in reported.values()] for n in names}
    drawn = [n for n, found in numbers.items() if len({each[0] for each in found if each}) > 1]
    if not drawn:
        return None
    values: list[Any] = [of.members[member] for member in reported]
    if any(isinstance(value, str) for value in values):
        labels, values = [str(value) for value in values], [*range(len(values))]
        across = Axis((-0.5, len(values) - 0.5), values, of.path, labels=labels)
    else:
        across = around(values, 0.05, 5, of.path)
    order = np.argsort(values)
    high = _BELOW + len(drawn) * (_HIGH + _ROOM)
    sheet = Sheet(style.COLUMN, high + -high % 75)  # whole quarters of an inch
    top = sheet.high - _ROOM
    for name in drawn:
        pairs = np.array([each or (None, None) for each in numbers[name]], dtype=float)
        value, deviation = pairs[order].T
        text = f"{name} and standard deviation" if np.isfinite(deviation).any() else name
        ends = value - np.nan_to_num(deviation), value + np.nan_to_num(deviation)
        below, up = across if name == drawn[-1] else across.blank(), around(ends, 0.1, 3, text)
        panel = Panel(sheet, (_LEFT, top - _HIGH, _RIGHT, top), below, up)
        panel.estimates(np.array(values)[order], value, *ends, style.BLUE)
        top -= _HIGH + _ROOM
    return sheet.figure
