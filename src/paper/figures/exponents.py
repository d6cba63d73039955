"""Lyapunov exponents against the number of impacts: Figure 7 of the paper."""

from collections.abc import Iterator
from functools import partial
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from paper import values
from pseudorigid.dynamics.variables import final_exponents
from pseudorigid.figures.axes import panel
from pseudorigid.figures.axes.limits import complete, hides, inside, of_data, refuse_empty, ticks
from pseudorigid.figures.axes.plane import Plane, thousands
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import POINT, width

_UPPER_START = 0.25  # share of the impacts before those that the upper panel shows
_MOST_STARTS = 124  # of a key; with more the picture is over four times as high as wide
_MOST_NAMED = 12  # starts of orbits of one type in a key
_NARROW, _BROAD = 240, 380  # pixels: names of starts up to this width stand in 3, in 2 columns
_UPPER, _ROOM = (130, 390), 375  # pixels above the main frame: the upper one, and room for it
_DASHES = "-", "--", "-.", ":"  # of orbits in turn
_WIDTH = 0.8  # points
_NAMES = "Number of impacts", "Lyapunov exponents"
empty_picture = partial(Plane, axes=("impact", "exponent"), names=_NAMES, right=84)


def draw(scene: dict[str, Any], lyapunov: xr.Dataset) -> Figure:
    """Draw the exponents of each orbit in its hue, and above them the largest of chaotic orbits.

    A key names the starts, if there are several. If orbits are of several types, some chaotic, the
    names lambda_1, lambda_2, ... at the lines' ends are for the chaotic ones. The key says which is
    which, and which orbits are neither regular nor chaotic. Raises ValueError if the axes show
    nothing.
    """
    return drawn(scene, lyapunov)[0]


def hidden(scene: dict[str, Any], lyapunov: xr.Dataset) -> Iterator[str]:
    """Say what the axes hide of the lines' ends: the first exponents may lie far beyond."""
    ends = {"impact": _lengths(lyapunov), "exponent": final_exponents(lyapunov)}
    yield from hides(scene, "the lines' ends", **ends)
    shown = drawn(scene, lyapunov)[1]
    if "largest" in scene.get("axes", {}) and not shown.size:
        yield "axes.largest is not used: no chaotic orbit has data: leave axes.largest out"
    yield from hides(scene, "the upper panel's lines", largest=shown)


@style.pinned()
def drawn(scene: dict[str, Any], lyapunov: xr.Dataset) -> tuple[Figure, np.ndarray]:
    """Return the figure, and the values of the upper panel, none without one."""
    impact, exponent = lyapunov["impact"].values, lyapunov["exponent"].values
    types = lyapunov["type"].values
    chaotic = types == "chaotic"
    mixed = chaotic.any() and not chaotic.all()
    told = len({*types}) > 1 or types[0] not in ("chaotic", "regular")
    named = chaotic if mixed else np.full(chaotic.shape, True)
    axes: dict[str, Any] = {"impact": lambda: of_data([0, int(impact[-1])], room=0.0)}
    first, last = complete(scene, **axes)["axes"]["impact"]["limits"]
    window = first + _UPPER_START * (last - first), last
    largest = exponent[inside([window], [impact])][:, chaotic].max(axis=2)
    has_data = np.isfinite(largest).any()
    axes["exponent"] = lambda: of_data(exponent)
    axes["largest"] = lambda: of_data(largest if has_data else exponent, most=4)
    scene = complete(scene, **axes)
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
    room = 75 * -(-48 * -(-len(names) // columns) // 75)
    picture = empty_picture(scene, room=room + _ROOM * bool(has_data))
    entries = [(name, hue, "", dash) for name, (hue, dash) in zip(names, lines, strict=False)]
    panel.key(picture.sheet, entries, picture.sheet.high - 85, columns, left=190, width=850)
    lengths = np.minimum(_lengths(lyapunov), last)
    reach = float(lengths[named].max())
    ends = _ends(impact, exponent[:, named & (lengths == reach)], reach)
    upper = _upper_panel(picture, scene, window, largest) if has_data else None
    for orbit, (hue, dashes) in enumerate(lines):
        line_style = {"color": hue, "lw": _WIDTH, "ls": dashes}
        # An orbit is NaN at the records of orbits with other numbers of impacts, and after grazing.
        known = ~np.isnan(exponent[:, orbit, 0])
        for index in range(indices):
            picture.line(impact[known], exponent[known, orbit, index], **line_style)
        if upper and chaotic[orbit]:
            upper.line(impact[known], exponent[known, orbit].max(axis=1), **line_style)
    picture.beside(reach, ends, [rf"$\lambda_{index + 1}$" for index in range(indices)])
    if orbits > 1 and (lengths == reach).all() and not mixed:
        _coincide(picture, reach, ends, exponent)
    return picture.figure, largest if upper else largest[:0]


def _lengths(lyapunov: xr.Dataset) -> np.ndarray:
    """Return the number of impacts of each orbit."""
    known = ~np.isnan(lyapunov["exponent"].values[:, :, 0])
    return np.where(known, lyapunov["impact"].values[:, None], 1).max(axis=0)


def _key_text(start: Any, kind: str) -> str:
    """Return the key's text for a start: its coordinates, and the type of its orbit."""
    points = start.items() if isinstance(start, dict) else [("start", start)]
    text = ", ".join(f"{style.NAMES.get(name, name)} {style.number(at)}" for name, at in points)
    return f"{text}: {kind}" if kind else text


def _ends(impact: np.ndarray, exponent: np.ndarray, reach: float) -> np.ndarray:
    """Return the exponents of orbits at an impact, the middle one of each, the largest first."""
    ends = []
    for lines in exponent.transpose(1, 2, 0):
        known = ~np.isnan(lines[0])
        ends.append([np.interp(reach, impact[known], line[known]) for line in lines])
    ordered = np.sort(np.sort(ends, axis=1), axis=0)
    return np.asarray(ordered[(len(ends) - 1) // 2, ::-1])


def _coincide(picture: Plane, reach: float, ends: np.ndarray, exponent: np.ndarray) -> None:
    """Write below lines up to `reach` that lie on one another that they do, if it fits."""
    known = exponent[~np.isnan(exponent).any(axis=(1, 2))]
    if not (len(known) and inside([picture.up.limits] * len(ends), ends).all()):
        return
    spread = np.median(np.ptp(known, axis=1), axis=0)
    (at, heights), (_, tops) = (picture.place(reach, values) for values in (ends, ends + spread))
    room = -np.diff([*heights, picture.frame[1]])
    for height, top, below in np.transpose([heights, tops, room]).tolist():
        needed = 2.0 * style.PLAIN * POINT
        text, right = f"{exponent.shape[1]} lines lie on one another", float(at[0]) - 3 * POINT
        free = below > needed and right - width(text, 7.0) > picture.frame[0]
        if top - height < _WIDTH * POINT and free:
            picture.sheet.text(right, height - 3 * POINT, text, 7.0, "right", "top")


def _upper_panel(
    picture: Plane, scene: dict[str, Any], window: tuple[float, float], largest: np.ndarray
) -> panel.Window:
    """Draw an empty frame for the largest exponents, with two numbers as lines in the paper's case.

    They are the paper's exponent, and the largest one of an orbit after all impacts.
    """
    refuse_empty(scene["axes"], {"largest": largest})
    marks, power = ticks(*window, 5), thousands(picture.across.ticks)
    across = panel.Axis(window, marks, labels=[style.number(mark, power) for mark in marks])
    up = panel.Axis(**scene["axes"]["largest"], name="Largest exponents")
    left, _, right, top = picture.frame
    upper = panel.Window(picture.sheet, (left, top + _UPPER[0], right, top + _UPPER[1]), across, up)
    if (scene["energy"], scene["ball"]) == (values.FIGURES["fig7"]["energy"], values.BALL):
        middle, end = window[0] + 0.4 * (window[1] - window[0]), float(np.nanmax(largest[-1]))
        if _level(upper, values.EXPONENT, "-"):
            text = f"the paper: {style.number(values.EXPONENT)}"
            upper.note(middle, values.EXPONENT, text, (-4, 1), "center", "bottom")
        if _level(upper, end, ":"):
            text = f"largest at the end: {style.number(round(end, 4))}"
            left, above = right - width(text, 7.0) - 7 * POINT, upper.frame[3] + 8 * POINT
            panel.key(picture.sheet, [(text, style.FRAME, "", ":")], above, 1, left, size=7.0)
    panel.letters(picture.sheet, upper.frame, picture.frame)
    return upper


def _level(upper: panel.Window, value: float, dashes: str) -> bool:
    """Draw a level line if it lies within the limits, and return whether it does."""
    low, high = upper.up.limits
    shown = low < value < high
    if shown:
        upper.line(upper.across.limits, [value, value], color=style.FRAME, lw=0.7, ls=dashes)
    return shown
