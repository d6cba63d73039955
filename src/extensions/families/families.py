"""Families of periodic orbits against the energy or the inertia: a dataset of curves and events."""

import json
import math
import os
from collections.abc import Callable, Iterable
from pathlib import Path

import numpy as np
import xarray as xr

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.fixed_point import rotation
from pseudorigid.dynamics.variables import ENERGY, LENGTH, SPEED, TIME, described

from .continuation.curve import Point
from .continuation.families import Family
from .continuation.half_orbit import ENERGY as BY_ENERGY
from .continuation.half_orbit import FIX_RP, INERTIA
from .continuation.search import Search
from .continuation.symmetric import CELLS, Parameter

_LINES = {0: "Fix R", 1: "Fix RP", -1: "none"}
_EVENT = "fold, doubling, pitchfork, or resonance of that order"
_END = "range, fold, resonance, doubling, pitchfork, touch, rim or closed"
_CHECKPOINT = 20  # levels between two checkpoints


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
    checkpoint = None if folder is None else Path(folder, "families.json")
    key = [parameter, ball.k, energy / unit, *span, period, levels]
    first = _resume(search, checkpoint, key)
    for done in search.sweep(grid, first):
        if progress is not None:
            progress(0.5 * done / levels, f"{len(search.families)} families")
        if checkpoint is not None and done % _CHECKPOINT == 0:
            _keep(search, checkpoint, key, done)

    def report(done: int) -> None:
        if progress is not None:
            count = len(search.families)
            progress(0.5 + 0.5 * done / count, f"{done} of {count} families have their branches")

    search.complete(report)
    if checkpoint is not None:
        checkpoint.unlink(missing_ok=True)
        if checkpoint.parent.is_dir():
            checkpoint.parent.rmdir()
    data = xr.Dataset(_variables(ball, along, search.families))
    unresolved = sum(end.kind == "unresolved" for f in search.families for end in f.ends)
    data.attrs |= {"parameter": parameter, "period": period, "levels": levels, "cells": CELLS}
    data.attrs |= {"low": float(span[0]), "high": float(span[1]), "unresolved": unresolved}
    return data


def _resume(search: Search, checkpoint: Path | None, key: list) -> int:
    """Continue from a checkpoint of the same search; return the number of levels done."""
    if checkpoint is None or not checkpoint.is_file():
        return 0
    kept = json.loads(checkpoint.read_text(encoding="utf-8"))
    if kept["key"] != key:
        return 0
    search.resume(kept["starts"])
    return kept["done"]


def _keep(search: Search, checkpoint: Path, key: list, done: int) -> None:
    """Write a checkpoint; the file appears whole."""
    checkpoint.parent.mkdir(parents=True, exist_ok=True)
    part = checkpoint.with_suffix(".new")
    content = {"key": key, "done": done, "starts": search.starts}
    part.write_text(json.dumps(content), encoding="utf-8")
    part.replace(checkpoint)


def _variables(ball: Ball, along: Parameter, families: list[Family]) -> dict:
    """Return the variables of the dataset of some families, in the paper's units."""
    g = ball.g
    points = [(family, point) for family in families for point in family.points]
    events = [(family, event) for family in families for event in family.events]
    marks = [(family, event.point) for family, event in events]
    ends = [end for family in families for end in family.ends]
    traces = np.array([family.system.trace(point) for family, point in points])

    def of_points(dim: str, pairs: list[tuple[Family, Point]], before: str = "") -> dict:
        """Return the variables that points of curves and events share."""
        x, y = np.array([_first_impact(*pair) for pair in pairs]).reshape(-1, 2).T * g
        levels = [point.p for _, point in pairs]
        times = [point.data.time for _, point in pairs]
        return {
            f"{before}energy": (dim, [along.energy(p) * (g * g) for p in levels], "energy", ENERGY),
            f"{before}k": (dim, [along.k_and_rho(p)[0] for p in levels], "Euler inertia, eq. (5)"),
            f"{before}x": (dim, x, "position of the orbit's first impact", LENGTH),
            f"{before}y": (dim, y, "xdot - k udot just before it", SPEED),
            f"{before}time" if before else "total_time": (dim, times, "total time", TIME),
        }

    def whole(values: Iterable[int]) -> np.ndarray:
        """Return whole numbers as an array, which has their type even if it is empty."""
        return np.fromiter(values, dtype=np.int64)

    def of_ends(values: list) -> tuple:
        """Return dims and values of a variable of the ends."""
        return ("family", "side"), np.array(values).reshape(-1, 2)

    table = {
        "period": ("family", [f.period for f in families], "number of impacts"),
        "line": (
            "family",
            [_LINES[f.line] for f in families],
            "symmetry line of the points, none for orbits without symmetry",
        ),
        "row_size": ("family", [len(f.points) for f in families], "points of each family"),
        **of_points("point", points),
        "place": ("point", [z.q for _, z in points], "position q on the symmetry line"),
        "trace": ("point", traces, "trace of the Jacobian of P^n on the energy surface"),
        "rotation_number": (
            "point",
            [rotation(trace) for trace in traces.tolist()],
            "argument of the multiplier over 2 pi; NaN if the orbit is not elliptic",
        ),
        "type": ("point", _types(traces), "type of stability"),
        **of_points("event", marks, "event_"),
        "event_family": ("event", whole(f.number for f, _ in events), "family of the event"),
        "event_kind": ("event", np.array([e.kind for _, e in events], dtype=str), _EVENT),
        "event_turns": ("event", whole(e.turns for _, e in events), "p of a resonance p/q, else 1"),
        "event_order": (
            "event",
            whole(event.order for _, event in events),
            "period of the branches over that of the family",
        ),
        "event_point": (
            "event",
            [event.at for _, event in events],
            "place on the family's curve, an index of its points",
        ),
        "end_kind": (*of_ends([end.kind for end in ends]), _END),
        "end_energy": (*of_ends([along.energy(end.p) * (g * g) for end in ends]), "energy", ENERGY),
        "end_k": (*of_ends([along.k_and_rho(end.p)[0] for end in ends]), "Euler inertia, eq. (5)"),
        "end_family": (
            *of_ends([end.family for end in ends]),
            "the parent, or the family on the other side of a grazing; -1 if none",
        ),
        "end_turns": (
            *of_ends([end.turns for end in ends]),
            "p of the parent's rotation number p/q there",
        ),
        "end_order": (
            *of_ends([end.order for end in ends]),
            "q of the parent's rotation number p/q there, 2 at a doubling",
        ),
        "end_impact": (
            *of_ends([end.impact for end in ends]),
            "flight of the half orbit that touches the floor; -1 if none",
        ),
    }
    data = described(table)
    data["row_size"][2]["sample_dimension"] = "point"
    return data


def _first_impact(family: Family, point: Point) -> tuple[float, float]:
    """Return x and y of the orbit's first impact; on Fix RP, of the one before the flight."""
    x, y = family.system.first_impact(point)
    return x, -y if family.line == FIX_RP else y


def _types(traces: np.ndarray) -> list[str]:
    """Return the types of stability of traces."""
    words = np.where(traces > 0.0, "hyperbolic", "inverse hyperbolic").astype(object)
    words[np.abs(traces) < 2.0] = "elliptic"
    return words.tolist()
