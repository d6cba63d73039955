"""Stable and unstable manifolds on the energy surface: Figure 5 of the paper."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from pseudorigid.dynamics.variables import of_type, rows, states_of
from pseudorigid.figures.axes.box import Box
from pseudorigid.figures.axes.limits import complete_box, cuts
from pseudorigid.figures.axes.panel import Entry
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.sheet import POINT, unbroken_runs

_BACKDROP, _SADDLE, _END, _TIP = 0.5, 3.6, 2.6, 2.0  # points
_REACH = 2.5  # points along a line, to either side of a fold's tip
_SHARP = 0.5  # of the reach: the largest distance there between the two sides of a sharp fold
# Of the key: a mark's name, and what it means.
_CUT_OFF, _FOLD = "cut off: the line goes on", "fold: the line turns back"
_JUMP = "jump: the map interrupts the line"
# Stable branches first and broader: both show where they all but coincide.
_BRANCHES = (("stable", 1, style.STABLE, 1.0), ("unstable", 0, style.UNSTABLE, 0.5))


def draw(
    scene: dict[str, Any], orbits: xr.Dataset, manifolds: xr.Dataset, periodic: xr.Dataset
) -> Figure:
    """Draw the branches of a hyperbolic orbit, of type scene["type"], over a backdrop of orbits.

    Stable branches are green, unstable ones blue. An open dot marks the end of a line that is not
    followed further, an open square a line that a jump of the map interrupts, and a small full dot
    a sharp fold. Raises ValueError if no branch can be seen or there is no such orbit.
    """
    return drawn(scene, orbits, manifolds, periodic)[0]


@style.pinned()
def drawn(
    scene: dict[str, Any], orbits: xr.Dataset, manifolds: xr.Dataset, periodic: xr.Dataset
) -> tuple[Figure, list[str]]:
    """Return the figure, and the names of its marks in the key."""
    scene = complete_box(scene, orbits, manifolds)
    branches, jumps = states_of(manifolds), _jumps(manifolds)
    saddles = states_of(of_type(periodic, scene["type"]))
    entries: list[Entry] = [(name, hue, "", False, width) for name, _, hue, width in _BRANCHES]
    trial = Box(scene, shown=branches)
    spans, pixels = rows(manifolds), np.array(trial.view(branches))
    tips = [span.start + tip for span in spans for tip in _tips(pixels[:, span], pixels)]
    for points, *entry in (
        (saddles, "saddles", style.BLACK, "o"),
        (states_of(orbits), "orbits", style.BACKDROP, "o"),
        (branches[:, [span.stop - 1 for span in spans]], _CUT_OFF, style.FRAME, "o", True, None),
        (branches[:, jumps], _JUMP, style.FRAME, "s", True, None),
        (branches[:, tips], _FOLD, style.FRAME, "o", False, _TIP),
    ):
        if trial.seen(points).any():
            entries.append(tuple(entry))
    box = Box(scene, entries)
    box.points(states_of(orbits), style.BACKDROP, _BACKDROP)
    _branches(box, manifolds, branches, jumps, tips)
    box.points(saddles, "white", _SADDLE + 1.2)
    box.points(saddles, style.BLACK, _SADDLE)
    return box.figure, [name.partition(":")[0] for name, *_ in entries]


def hidden(scene: dict[str, Any], _: Any, manifolds: xr.Dataset, __: Any) -> Iterator[str]:
    """Say which axes cut the energy surface."""
    return cuts(scene, "points of the branches", manifolds)


def _branches(
    box: Box, manifolds: xr.Dataset, states: np.ndarray, jumps: np.ndarray, tips: Sequence[int]
) -> None:
    """Draw the branches, and on top of them the marks of their tips, jumps and ends."""
    spans = rows(manifolds)
    marks: list[tuple[np.ndarray, str, float, dict[str, Any]]] = []
    hollow = {"mfc": "white", "mew": 0.6}
    for _, stable, hue, width in _BRANCHES:
        for span in (spans[i] for i in np.flatnonzero(manifolds["stable"].values == stable)):
            line = states[:, span]
            box.line(line, hue, width)
            sharp = [tip for tip in tips if span.start <= tip < span.stop]
            marks.append((states[:, sharp], hue, _TIP, {}))
            marks.append((line[:, jumps[span]], hue, _END, hollow | {"marker": "s"}))
            marks.append((line[:, [-1]], hue, _END, hollow))
    for at, hue, size, line_style in marks:
        box.points(at, hue, size, **line_style)


def _jumps(manifolds: xr.Dataset) -> np.ndarray:
    """Return whether each vertex is next to a jump of the map, which interrupts its line."""
    gap = np.isnan(manifolds["x"].values)
    return ~gap & (np.append(gap[1:], False) | np.insert(gap[:-1], 0, False))


def _tips(line: np.ndarray, all_lines: np.ndarray) -> list[int]:
    """Return the vertices of a line's sharp folds, in pixels (2, n), that no line continues."""
    reach, tips = _REACH * POINT, []
    all_lines = all_lines[:, ~np.isnan(all_lines[0])]
    for run in unbroken_runs(np.isnan(line[0])):
        piece = line[:, run]
        steps = np.sqrt((np.diff(piece) ** 2).sum(axis=0))
        along = np.concatenate([[0.0], np.cumsum(steps)])
        before, after = (
            np.array([np.interp(along + shift, along, part) for part in piece])
            for shift in (-reach, reach)
        )
        beyond = 2.0 * piece - 0.5 * (before + after)  # the middle of the sides, mirrored
        inner = (along >= reach) & (along <= along[-1] - reach)
        apart = np.where(inner, np.sqrt(((after - before) ** 2).sum(axis=0)), np.inf)
        sharp = np.concatenate([[False], apart < _SHARP * reach, [False]])
        for start, stop in np.flatnonzero(np.diff(sharp)).reshape(-1, 2):
            tip = start + int(np.argmin(apart[start:stop]))
            distance_squared = ((all_lines - beyond[:, [tip]]) ** 2).sum(axis=0)
            if not (distance_squared < _SHARP * reach * reach).any():
                tips.append(run.start + tip)
    return tips
