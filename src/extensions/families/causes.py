"""Extrema of the regular share along a line of E or k, and what causes them.

A *chain* is the chain of islands of a family of periodic orbits, and a *curve* an invariant curve
in the main island, beyond a resonance (`shares`). A *slope* is the part of the line between two
neighbouring extrema, or from the first or last one to an end.
"""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

LARGEST = 3  # chains named for each slope
_HALF = 0.5  # share of a change for which a chain must account


class Change(NamedTuple):
    """A change from an extremum to a value: the chain or curve behind it, and its event."""

    at: float  # the value
    family: int  # -1 for a curve
    part: float  # of the change of the regular share
    event: str
    event_at: float


_UNEXPLAINED = Change(math.nan, -1, 0.0, "unexplained", math.nan)


def extrema(share: np.ndarray, low: np.ndarray, high: np.ndarray) -> list[tuple[int, int, int]]:
    """Return (index, left, right) of the minima and maxima of a curve with intervals.

    From an extremum the values are followed to both sides. `left` and `right` are the first indices
    at which the interval is disjoint from that at the extremum. If the values pass the extremum's
    or end before, there is no extremum. Of equal values the first one counts.
    """
    found = []
    for sign in (1.0, -1.0):
        value = sign * share
        below, above = (low, high) if sign > 0.0 else (-high, -low)
        for i in range(share.size):
            sides: list[int] = []
            for order in (range(i - 1, -1, -1), range(i + 1, share.size)):
                for j in order:
                    if value[j] < value[i] or (value[j] == value[i] and j < i):
                        break
                    if below[j] > above[i]:
                        sides.append(j)
                        break
            if len(sides) == 2:
                found.append((i, sides[0], sides[1]))
    return sorted(found)


def causes(
    families: xr.Dataset,
    parameter: str,
    values: np.ndarray,
    regular: Sequence[np.ndarray],
    chains: np.ndarray,
    curves: Sequence[tuple[str, float, np.ndarray]],
    step: float,
) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
    """Return the variables of each extremum and of each slope, from the shares (value, family).

    `regular` holds the regular share and the ends of its interval; `curves` are event, parameter
    and the share beyond it (value,) of curves beyond a resonance that break or form. A change is
    that from an extremum to the nearest value that differs by more than the intervals, or to the
    neighbouring extremum. An event is the cause of an extremum only if its chain, the one that
    changes most, accounts for at least half of such a change and the event lies within one step of
    the extremum. A curve that breaks or forms is such an event, whose chain is the part of the main
    island beyond the resonance. Of events that account for equal parts the first one is the cause,
    and chains come before curves: an event of a chain has more digits.
    """
    share, low, high = regular
    found = extrema(share, low, high)
    turning = [0, *(i for i, _, _ in found), len(values) - 1]

    def parts(i: int, j: int, column: np.ndarray) -> np.ndarray:
        """Return the changes from one value to another over that of the regular share."""
        return (column[j] - column[i]) / (share[j] - share[i] or math.inf)

    def largest_change(i: int, j: int) -> Change:
        """Return the chain with the largest part of a change, and its event nearest to values[i].

        The part is negative if the chain changes in the other direction than the regular share.
        """
        changed = parts(i, j, chains)
        number = int(np.argmax(changed))
        events = _events_of(families, parameter, number)
        nearest = min(events, key=lambda event: abs(event[1] - values[i]), default=("", math.nan))
        return Change(values[j], number, float(changed[number]), *nearest)

    rows, slopes = [], []
    for n, (i, left, right) in enumerate(found, 1):
        ends = left, right, turning[n - 1], turning[n + 1]
        changes = [largest_change(i, j) for j in ends]
        of_curves = [
            Change(values[j], -1, float(parts(i, j, beyond)), event, place)
            for j in ends
            for event, place, beyond in curves
        ]
        large = (
            change
            for change in changes + of_curves
            if change.part >= _HALF and abs(change.event_at - values[i]) <= step * (1.0 + 1e-9)
        )
        cause = max(large, key=lambda change: change.part, default=_UNEXPLAINED)
        row = {
            "extremum_at": values[i],
            "extremum_kind": "minimum" if share[left] > share[i] else "maximum",
            "cause_family": cause.family,
            "cause_event": cause.event,
            "cause_at": cause.event_at,
        }
        sides = zip(Change._fields, zip(*changes[:2], strict=True), strict=True)
        rows.append(row | {f"side_{name}": list(pair) for name, pair in sides})
    for i, j in pairwise(turning) if found else ():
        changed = parts(i, j, chains)
        most = np.argsort(-np.abs(changed), kind="stable")[:LARGEST]
        line = {"slope_from": values[i], "slope_to": values[j]}
        line["slope_change"] = share[j] - share[i]
        slopes.append(line | {"slope_family": most, "slope_part": changed[most]})
    return rows, slopes


def _events_of(families: xr.Dataset, parameter: str, number: int) -> list[tuple[str, float]]:
    """Return the events and ends of a family, each with the parameter's value there.

    An end at a limit of the range in which the family was followed is left out.
    """
    found = []
    for i in np.flatnonzero(families["event_family"].values == number).tolist():
        kind = str(families["event_kind"].values[i])
        if kind == "resonance":
            turns, order = (int(families[f"event_{n}"].values[i]) for n in ("turns", "order"))
            kind = f"resonance {turns}/{order}"
        found.append((kind, float(families[f"event_{parameter}"].values[i])))
    for side in (0, 1):
        kind = str(families["end_kind"].values[number, side])
        if kind != "range":
            found.append((f"end: {kind}", float(families[f"end_{parameter}"].values[number, side])))
    return found
