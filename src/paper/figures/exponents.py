"""Lyapunov exponents against the number of impacts: Figure 7 of the paper."""

from collections.abc import Iterator
from functools import partial
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from pseudorigid.dynamics.variables import final_exponents
from pseudorigid.figures.axes import panel
from pseudorigid.figures.axes.limits import complete, hides, inside, of_data, refuse_empty, ticks
from pseudorigid.figures.axes.plane import Plane, thousands
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import POINT, width

_INSET_START = 0.25  # share of the impacts before those that the inset shows
_MOST_STARTS = 140  # of a key; with more the picture is over four times as high as wide
_MOST_NAMED = 12  # starts of orbits of one type in a key
_NARROW, _BROAD = 240, 380  # pixels: names of starts up to this width stand in 3, in 2 columns
_INSET_ROOM = 170  # pixels: least distance between the first two exponents that holds an inset
_DASHES = "-", "--", "-.", ":"  # of orbits in turn
_WIDTH = 0.8  # points
_NAMES = "Number of impacts", "Lyapunov exponents"
empty_picture = partial(Plane, axes=("impact", "exponent"), names=_NAMES, right=84)


def draw(scene: dict[str, Any], lyapunov: xr.Dataset) -> Figure:
    """Draw the exponents of each orbit in its hue, and the largest ones again in an inset.

    A key names the starts, if there are several. If orbits are of several types, some chaotic, the
    inset and the names lambda_1, lambda_2, ... at the lines' ends are for the chaotic ones. The key
    says which is which, and which orbits are neither regular nor chaotic. Raises ValueError if the
    axes show nothing.
    """
    return drawn(scene, lyapunov)[0]


def hidden(scene: dict[str, Any], lyapunov: xr.Dataset) -> Iterator[str]:
    """Say what the axes hide of the lines' ends: the first exponents may lie far beyond."""
    ends = {"impact": _lengths(lyapunov), "exponent": final_exponents(lyapunov)}
    yield from hides(scene, "the lines' ends", **ends)
    yield from hides(scene, "the inset's lines", largest=drawn(scene, lyapunov)[1])


@style.pinned()
def drawn(scene: dict[str, Any], lyapunov: xr.Dataset) -> tuple[Figure, np.ndarray]:
    """Return the figure, and the values of the inset, none without one."""
    impact, exponent = lyapunov["impact"].values, lyapunov["exponent"].values
    final, types = final_exponents(lyapunov), lyapunov["type"].values
    chaotic = types == "chaotic"
    mixed = chaotic.any() and not chaotic.all()
    told = len({*types}) > 1 or types[0] not in ("chaotic", "regular")
    in_inset = chaotic if mixed else np.full(chaotic.shape, True)
    largest = exponent[:, in_inset].max(axis=2)
    scene = complete(
        scene,
        impact=lambda: of_data([0, int(impact[-1])], room=0.0),
        exponent=lambda: of_data(exponent),
        largest=lambda: of_data(largest[int(_INSET_START * len(largest)) :], most=4),
    )
    over = np.broadcast_to(impact[:, None, None], exponent.shape)
    refuse_empty(scene["axes"], {"impact": over, "exponent": exponent}, joined=True)
    _, orbits, indices = exponent.shape
    turns = (_DASHES[orbit % len(_DASHES)] for orbit in range(orbits))
    lines = list(zip(style.ordered(orbits), turns, strict=True))
    if told and orbits > _MOST_STARTS:
        raise ValueError(f"starts: {orbits} of them: expected at most {_MOST_STARTS}, with a key")
    names: list[str] = []
    if told or 1 < orbits <= _MOST_NAMED:
        kinds = types if told else [""] * orbits
        names = [_key_text(*each) for each in zip(scene["starts"], kinds, strict=True)]
    longest = max((width(name, 8.0) for name in names), default=0.0)
    columns = 3 if longest < _NARROW else 2 if longest < _BROAD else 1
    # A key takes 48 pixels a row, rounded up to quarter inches (75 pixels).
    picture = empty_picture(scene, room=75 * -(-48 * -(-len(names) // columns) // 75))
    entries = [(name, hue, "", dash) for name, (hue, dash) in zip(names, lines, strict=False)]
    panel.key(picture.sheet, entries, picture.sheet.high - 85, columns, left=190, width=850)
    ends = np.median(final[in_inset], axis=0)
    inset = _inset(picture, scene["axes"]["largest"], ends[0], ends[1], impact[-1])
    largest = largest[impact >= inset.across.limits[0]] if inset else largest[:0]
    if inset:
        refuse_empty(scene["axes"], {"largest": largest})
    for orbit, (hue, dashes) in enumerate(lines):
        line_style = {"color": hue, "lw": _WIDTH, "ls": dashes}
        # An orbit is NaN at the records of orbits with other numbers of impacts, and after grazing.
        known = ~np.isnan(exponent[:, orbit, 0])
        for index in range(indices):
            picture.line(impact[known], exponent[known, orbit, index], **line_style)
        if inset and in_inset[orbit]:
            inset.line(impact[known], exponent[known, orbit].max(axis=1), **line_style)
    picture.beside([(ends[index], rf"$\lambda_{index + 1}$") for index in range(indices)])
    if orbits > 1 and not mixed:
        _coincide(picture, ends, exponent, int(inset is not None))
    return picture.figure, largest


def _lengths(lyapunov: xr.Dataset) -> np.ndarray:
    """Return the number of impacts of each orbit."""
    known = ~np.isnan(lyapunov["exponent"].values[:, :, 0])
    return np.where(known, lyapunov["impact"].values[:, None], 1).max(axis=0)


def _key_text(start: Any, kind: str) -> str:
    """Return the key's text for a start: its coordinates, and the type of its orbit."""
    points = start.items() if isinstance(start, dict) else [("start", start)]
    text = ", ".join(f"{style.NAMES.get(name, name)} {style.number(at)}" for name, at in points)
    return f"{text}: {kind}" if kind else text


def _coincide(picture: Plane, ends: np.ndarray, exponent: np.ndarray, first: int) -> None:
    """Write below lines from the `first` on that lie on one another that they do, if it fits."""
    known = exponent[~np.isnan(exponent).any(axis=(1, 2))]
    if not (len(known) and inside([picture.up.limits] * len(ends), ends).all()):
        return
    spread = np.median(np.ptp(known, axis=1), axis=0)
    (_, heights), (_, tops) = (picture.place(0.0, values) for values in (ends, ends + spread))
    room = -np.diff([*heights, picture.frame[1]])
    for height, top, below in np.transpose([heights, tops, room])[first:].tolist():
        if top - height < _WIDTH * POINT and below > 2.0 * style.PLAIN * POINT:
            text = f"{exponent.shape[1]} lines lie on one another"
            across = picture.frame[2] - 3 * POINT
            picture.sheet.text(across, height - 3 * POINT, text, 7.0, "right", "top")


class _Inset(panel.Window):
    size = 7.0


def _inset(
    picture: Plane, largest: dict[str, Any], first: float, second: float, last: float
) -> _Inset | None:
    """Return a panel between the lines of the first two exponents, or None.

    `first` and `second` are the values at which these lines end, `largest` is the panel's vertical
    axis, and `last` the last number of impacts. There is no panel if a value is beyond the axis, if
    the lines are too close, or if the orbits end before the first impact that it would show.
    """
    left, _, right, _ = picture.frame
    _, (high, low) = picture.place(0.0, [first, second])
    shown = inside([picture.up.limits], [np.array([first, second])]).all()
    if not (shown and high - low > _INSET_ROOM):
        return None
    start, end = picture.across.limits
    start += _INSET_START * (end - start)
    if last < start:
        return None
    marks = ticks(start, end, 5)
    power = thousands(picture.across.ticks)
    across = panel.Axis((start, end), marks, labels=[style.number(mark, power) for mark in marks])
    bottom = low + (_Inset.tick + _Inset.gap + 1.6 * _Inset.size) * POINT
    wide = right - left
    frame = left + 0.2 * wide, bottom, right - 0.05 * wide, high - 0.18 * (high - low)
    return _Inset(picture.sheet, frame, across, panel.Axis(**largest))
