"""Families of periodic orbits against the energy or the inertia: a dataset of curves and events."""

import json
import math
import os
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import numpy as np
import xarray as xr

from pipeline.records.files import write_whole
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.fixed_point import rotation
from pseudorigid.dynamics.variables import ENERGY, LENGTH, SPEED, TIME, variables

from .continuation.asymmetric import NO_LINE
from .continuation.curve import Point
from .continuation.families import Family
from .continuation.half_orbit import ENERGY as BY_ENERGY
from .continuation.half_orbit import FIX_R, FIX_RP, INERTIA
from .continuation.search import Search
from .continuation.symmetric import CELLS, Parameter

_LINES = {FIX_R: "Fix R", FIX_RP: "Fix RP", NO_LINE: "none"}
_CHECKPOINT = 20  # levels between two checkpoints

# Name -> meaning of variables on `family`, `point`, `event` and (family, side). Names in _OF_PLACES
# are those on `point`, and on `event` with event_ before them.
_OF_FAMILIES = {
    "period": "number of impacts",
    "line": "symmetry line of the points, none for orbits without symmetry",
    "row_size": "points of each family",
}
_OF_PLACES = {
    "energy": ("energy", ENERGY),
    "k": "Euler inertia, eq. (5)",
    "x": ("position of the orbit's first impact", LENGTH),
    "y": ("xdot - k udot just before it", SPEED),
}
_OF_POINTS = {
    "total_time": ("total time", TIME),
    "place": "position q on the symmetry line",
    "trace": "trace of the Jacobian of P^n on the energy surface",
    "rotation_number": "argument of the multiplier over 2 pi; NaN if the orbit is not elliptic",
    "type": "type of stability",
}
_OF_EVENTS = {
    "event_time": ("total time", TIME),
    "event_family": "family of the event",
    "event_kind": "fold, doubling, pitchfork, or resonance of that order",
    "event_turns": "p of a resonance p/q, else 1",
    "event_order": "period of the branches over that of the family",
    "event_point": "place on the family's curve, an index of its points",
}
_OF_ENDS = {
    "end_kind": "range, fold, resonance, doubling, pitchfork, touch, rim or closed",
    "end_energy": ("energy", ENERGY),
    "end_k": "Euler inertia, eq. (5)",
    "end_family": "the parent, or the family on the other side of a grazing; -1 if none",
    "end_turns": "p of the parent's rotation number p/q there",
    "end_order": "q of the parent's rotation number p/q there, 2 at a doubling",
    "end_impact": "flight of the half orbit that touches the floor; -1 if none",
}


def families(
    ball: Ball,
    energy: float,
    parameter: str,
    span: list[float],
    period: int,
    levels: int,
    *,
    progress: Callable[[float, str], None] | None = None,
    folder: str | os.PathLike | None = None,
) -> xr.Dataset:
    """Find all families of symmetric periodic orbits, and follow them against E or k.

    Brute force on the symmetry lines at `levels` values of the parameter finds orbits, and
    pseudo-arclength continuation follows the families of those that no family holds yet.
    Families that branch off at resonances p/q, doublings and pitchforks are added, at pitchforks
    those without symmetry. Each is followed through folds to both its ends.

    Parameters
    ----------
    ball : Ball
    energy : float
        Against k, E/g^2 is that of this energy.
    parameter : {"energy", "k"}
        What orbits are followed against.
    span : (float, float)
        Its least and largest value.
    period : int
        Largest period, 1 to 24.
    levels : int
        Number of values of the parameter at which brute force seeks orbits.
    progress : callable, optional
        Called with the share done and a text; the levels count for one half of it.
    folder : path, optional
        Keeps the search while it lasts, so that a killed one continues.

    Returns
    -------
    xarray.Dataset
        long_name describes each variable. On `family`: period, line, row_size, and, of both ends on
        (family, end), what ends it and where. On `point`: the curves, one after the other (CF). On
        `event`: what happens along them. Attributes: parameter, levels, cells, the cells of a
        symmetry line; unresolved, the number of ends without a name.

    References
    ----------
    E. L. Allgower and K. Georg, Introduction to Numerical Continuation Methods (SIAM, 2003).
    R. S. MacKay, Renormalisation in Area-Preserving Maps (World Scientific, 1993): bifurcations of
    symmetric orbits.

    Examples
    --------
    >>> from pseudorigid import Ball
    >>> data = families(Ball(k=0.2, g=0.04), 0.01, "energy", [0.005, 0.012], 6, 4)
    >>> data["period"].values.tolist()
    [1, 6, 6, 6]
    """
    unit = ball.g * ball.g
    if parameter == "energy":
        low, high = (math.sqrt(1.0 + 2.0 * ball.k * (value / unit)) for value in span)
        along = Parameter(BY_ENERGY, ball.k, low, high)
    else:
        along = Parameter(INERTIA, energy / unit, *span)
        low, high = span
    search = Search(along, period)
    grid = [low + (high - low) * ((i + 0.5) / levels) for i in range(levels)]
    report = progress or (lambda share, text: None)
    checkpoint = None if folder is None else Path(folder, "families.json")
    key = [parameter, ball.k, energy / unit, *span, period, levels]
    first = _resumed(search, checkpoint, key)
    for done in search.sweep(grid, first):
        report(0.5 * done / levels, f"{len(search.families)} families")
        if checkpoint is not None and done % _CHECKPOINT == 0:
            content = {"key": key, "done": done, "starts": search.starts}
            write_whole(checkpoint, json.dumps(content))
    for done in search.complete():
        count = len(search.families)
        report(0.5 + 0.5 * done / count, f"{done} of {count} families have their branches")
    if checkpoint is not None and checkpoint.is_file():
        checkpoint.unlink()
        with suppress(OSError):  # a killed process may have left a part of a file
            checkpoint.parent.rmdir()
    data = xr.Dataset(_variables(ball, along, search.families))
    unresolved = sum(end.kind == "unresolved" for f in search.families for end in f.ends)
    data.attrs |= {"parameter": parameter, "period": period, "levels": levels, "cells": CELLS}
    data.attrs |= {"low": float(span[0]), "high": float(span[1]), "unresolved": unresolved}
    return data


def _resumed(search: Search, checkpoint: Path | None, key: list) -> int:
    """Continue from a checkpoint of the same search; return the number of levels done."""
    if checkpoint is None or not checkpoint.is_file():
        return 0
    kept = json.loads(checkpoint.read_text(encoding="utf-8"))
    if kept["key"] != key:
        return 0
    search.resume(kept["starts"])
    return kept["done"]


def _variables(ball: Ball, along: Parameter, families: list[Family]) -> dict:
    """Return the variables of the dataset of some families, in the paper's units."""
    points = [(family, point) for family in families for point in family.points]
    events = [event for family in families for event in family.events]
    marks = [(family, event.point) for family in families for event in family.events]
    ends = [end for family in families for end in family.ends]
    traces = np.array([family.system.trace(point) for family, point in points])

    def whole(values: list[int]) -> np.ndarray:
        """Return whole numbers as an array, which has their type even if it is empty."""
        return np.array(values, dtype=np.int64)

    of_families = (
        [family.period for family in families],
        [_LINES[family.line] for family in families],
        [len(family.points) for family in families],
    )
    of_points = (
        [point.data.time for _, point in points],
        [point.q for _, point in points],
        traces,
        [rotation(trace) for trace in traces.tolist()],
        _types(traces),
    )
    of_events = (
        [event.point.data.time for event in events],
        whole([family.number for family, _ in marks]),
        np.array([event.kind for event in events], dtype=str),
        whole([event.turns for event in events]),
        whole([event.order for event in events]),
        [event.at for event in events],
    )
    of_ends = (
        [end.kind for end in ends],
        [along.energy(end.p) * (ball.g * ball.g) for end in ends],
        [along.k_and_rho(end.p)[0] for end in ends],
        [end.family for end in ends],
        [end.turns for end in ends],
        [end.order for end in ends],
        [end.impact for end in ends],
    )
    both_ends = [np.array(values).reshape(-1, 2) for values in of_ends]
    of_places = {f"event_{name}": meaning for name, meaning in _OF_PLACES.items()}
    data = (
        variables("family", of_families, _OF_FAMILIES)
        | variables("point", _places(ball, along, points), _OF_PLACES)
        | variables("point", of_points, _OF_POINTS)
        | variables("event", _places(ball, along, marks), of_places)
        | variables("event", of_events, _OF_EVENTS)
        | variables(("family", "side"), both_ends, _OF_ENDS)
    )
    data["row_size"][2]["sample_dimension"] = "point"
    return data


def _places(ball: Ball, along: Parameter, points: list[tuple[Family, Point]]) -> tuple:
    """Return energy and k of orbits, and x and y of their first impacts."""
    g = ball.g
    impacts = [family.system.first_impact(point) for family, point in points]
    # On Fix RP this is the impact before the flight.
    signs = np.array([-1.0 if family.line == FIX_RP else 1.0 for family, _ in points])
    x, y = np.array(impacts).reshape(-1, 2).T * g
    energies = [along.energy(point.p) * (g * g) for _, point in points]
    return energies, [along.k_and_rho(point.p)[0] for _, point in points], x, signs * y


def _types(traces: np.ndarray) -> list[str]:
    """Return the types of stability of traces."""
    words = np.where(traces > 0.0, "hyperbolic", "inverse hyperbolic").astype(object)
    words[np.abs(traces) < 2.0] = "elliptic"
    return words.tolist()
