"""Families of periodic orbits against the energy or the inertia: a dataset of curves and events."""

import json
import math
import os
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from pipeline.records.files import write_whole
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.fixed_point import rotation
from pseudorigid.dynamics.variables import ENERGY, LENGTH, SPEED, TIME, Variables, described

from .continuation.asymmetric import NO_LINE
from .continuation.curve import Point
from .continuation.family import Family
from .continuation.half_orbit import ENERGY as BY_ENERGY
from .continuation.half_orbit import FIX_R, FIX_RP, INERTIA
from .continuation.search import Search
from .continuation.symmetric import CELLS, Parameter

_LINES = {FIX_R: "Fix R", FIX_RP: "Fix RP", NO_LINE: "none"}
_CHECKPOINT = 20  # levels between two checkpoints

# Name -> type and meaning of variables, and their scale if they have one.
_Table = dict[str, tuple[Any, ...]]
_OF_FAMILIES: _Table = {
    "period": (int, "number of impacts"),
    "line": (object, "symmetry line of the points, none for orbits without symmetry"),
    "row_size": (int, "points of each family"),
}
_OF_PLACES: _Table = {  # on `point`, and with event_ before them on `event`
    "energy": (float, "energy", ENERGY),
    "k": (float, "Euler inertia, eq. (5)"),
    "x": (float, "position of the orbit's first impact", LENGTH),
    "y": (float, "xdot - k udot just before it", SPEED),
}
_OF_POINTS: _Table = _OF_PLACES | {
    "total_time": (float, "total time", TIME),
    "place": (float, "position q on the symmetry line"),
    "trace": (float, "trace of the Jacobian of P^n on the energy surface"),
    "rotation_number": (
        float,
        "argument of the multiplier over 2 pi; NaN if the orbit is not elliptic",
    ),
    "type": (object, "type of stability"),
}
_OF_EVENTS: _Table = {f"event_{name}": text for name, text in _OF_PLACES.items()} | {
    "event_time": (float, "total time", TIME),
    "event_family": (int, "family of the event"),
    "event_kind": (object, "fold, doubling, pitchfork, or resonance of that order"),
    "event_turns": (int, "p of a resonance p/q, else 1"),
    "event_order": (int, "period of the branches over that of the family"),
    "event_point": (float, "place on the family's curve, an index of its points"),
}
_OF_ENDS: _Table = {
    "end_kind": (object, "range, fold, resonance, doubling, pitchfork, touch, rim or closed"),
    "end_energy": (float, "energy", ENERGY),
    "end_k": (float, "Euler inertia, eq. (5)"),
    "end_family": (int, "the parent, or the family on the other side of a grazing; -1 if none"),
    "end_turns": (int, "p of the parent's rotation number p/q there"),
    "end_order": (int, "q of the parent's rotation number p/q there, 2 at a doubling"),
    "end_impact": (int, "flight of the half orbit that touches the floor; -1 if none"),
}


def families(
    ball: Ball, energy: float, parameter: str, span: list[float], period: int, levels: int, *,
    progress: Callable[[float, str], None] | None = None, folder: str | os.PathLike | None = None,
) -> xr.Dataset:  # fmt: skip
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


def _variables(ball: Ball, along: Parameter, families: list[Family]) -> Variables:
    """Return the variables of the dataset of some families, in the paper's units."""
    g = ball.g

    def energy_and_k(p: float) -> tuple[float, float]:
        return along.energy(p) * (g * g), along.k_and_rho(p)[0]

    def place(family: Family, point: Point) -> tuple[float, ...]:
        x, y = family.system.first_impact(point)
        # On Fix RP this is the impact before the flight.
        sign = -1.0 if family.line == FIX_RP else 1.0
        return *energy_and_k(point.p), x * g, sign * (y * g)

    of_families, of_points, of_events, of_ends = [], [], [], []
    for family in families:
        of_families.append((family.period, _LINES[family.line], len(family.points)))
        for point in family.points:
            trace = family.system.trace(point)
            stability = trace, rotation(trace), _type(trace)
            of_points.append((*place(family, point), point.data.time, point.q, *stability))
        for kind, turns, order, point, index in family.events:
            what = point.data.time, family.number, kind, turns, order, index
            of_events.append((*place(family, point), *what))
        for end in family.ends:
            other = end.family, end.turns, end.order, end.impact
            of_ends.append((end.kind, *energy_and_k(end.p), *other))
    data = (
        _described("family", of_families, _OF_FAMILIES)
        | _described("point", of_points, _OF_POINTS)
        | _described("event", of_events, _OF_EVENTS)
        | _described(("family", "side"), of_ends, _OF_ENDS, (-1, 2))
    )
    data["row_size"][2]["sample_dimension"] = "point"
    return data


def _described(
    dims: Any, rows: list[tuple[Any, ...]], table: _Table, shape: tuple[int, ...] = (-1,)
) -> Variables:
    """Return the variables of a table from rows of their values, of which there may be none."""
    values = np.array(rows, dtype=[(name, kind) for name, (kind, *_) in table.items()])
    values = values.reshape(shape)
    return described({name: (dims, values[name], *text) for name, (_, *text) in table.items()})


def _type(trace: float) -> str:
    """Return the type of stability of a trace."""
    if abs(trace) < 2.0:
        return "elliptic"
    return "hyperbolic" if trace > 0.0 else "inverse hyperbolic"
