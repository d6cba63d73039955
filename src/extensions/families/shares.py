"""The regular share along a line of E or k, its chains of islands, and causes of its extrema.

A regular orbit belongs to the chain of an elliptic orbit of period n if its points under P^n go
around exactly one of the n points. Of several such orbits the one with the longest period counts,
since chains lie inside others. Orbits that go around the fixed point alone belong to the main
island or to a chain around it whose period is longer than those of the families. A resonance p/q
divides the main island into the orbits beyond it, whose winding number lies on the other side of
p/q than the fixed point's rotation number, and the rest. Where their share vanishes or appears, the
last invariant curve among them is searched, without counting orbits.
"""

import math
from collections.abc import Callable
from fractions import Fraction
from itertools import pairwise
from typing import Any

import numpy as np
import xarray as xr

from extensions.atlas.cell import sunflower_points, wilson
from pseudorigid.dynamics import fixed_point
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.variables import ENERGY, described, variables
from pseudorigid.dynamics.verdict import classify_orbits
from pseudorigid.kernel.compiled import jit
from pseudorigid.kernel.tangents import angle

from .breakup import breakup
from .continuation.curve import cramer

ROUNDS = 200  # points under P^n by which an orbit is seen to go around a point
_WIDEST = 2.8  # radians: the largest angle without a point, as seen from a point inside
_NEWTON_STEPS = 12
_CLOSED = 1e-9  # |P^n z - z|, in section radii, of a point that Newton's method has found
_HALF = 0.5  # share of a change for which a chain must account
_LARGEST = 3  # chains named for each slope
_SEEN = 0.002  # share of the section; smaller ones may be a few orbits that stick to islands

# Name -> meaning of variables on `value`, `breakup`, `extremum`, (extremum, side), `slope` and
# (slope, largest).
_OF_VALUES = {
    "energy": ("energy", ENERGY),
    "k": "Euler inertia, eq. (5)",
    "regular": "share of the section's area with regular orbits",
    "regular_low": "lower end of its 95 % interval, starts and threshold together",
    "regular_high": "upper end of its 95 % interval, starts and threshold together",
    "outside": "share of regular orbits that go around no orbit of the families",
}
_OF_BREAKUPS = {
    "breakup_event": "last curve beyond p/q that breaks, or first one that forms",
    "breakup_at": "energy, or k, of it by Greene's criterion, NaN if none is found",
}
_OF_EXTREMA = {
    "extremum_at": "energy, or k, of an extremum of the regular share",
    "extremum_kind": "minimum or maximum",
    "cause_family": "family whose event is the cause, -1 for a curve or if there is none",
    "cause_event": "that event, or the curve beyond p/q that breaks or forms, or unexplained",
    "cause_at": "energy, or k, of that event",
}
_OF_SIDES = {
    "side_at": "nearest value on that side at which the regular share differs",
    "side_family": "family whose chain changes most from the extremum to there",
    "side_part": "its change over the change of the regular share",
    "side_event": "event or end of that family nearest to the extremum",
    "side_event_at": "energy, or k, of that event",
}
_OF_SLOPES = {
    "slope_from": "energy, or k, at which the line between neighbouring extrema begins",
    "slope_to": "energy, or k, at which it ends",
    "slope_change": "change of the regular share along it",
}
_OF_LARGEST = {
    "slope_family": "families whose chains change most along it",
    "slope_part": "their changes over the change of the regular share",
}


@jit
def _goes_around(x, y, at_x, at_y):
    """Return whether the points (n,) are seen from (at_x, at_y) in all directions."""
    angles = np.empty(x.size)
    for i in range(x.size):
        angles[i] = angle(x[i] - at_x, y[i] - at_y)
    angles.sort()
    widest = angles[0] + 2.0 * math.pi - angles[-1]
    for i in range(1, x.size):
        widest = max(widest, angles[i] - angles[i - 1])
    return widest < _WIDEST


def elliptic_orbits(
    ball: Ball, families: xr.Dataset, parameter: str, energy: float
) -> list[tuple[int, Any]]:
    """Return (family, points (2, period) in (x, y)) of a ball's elliptic orbits at an energy."""
    ends = np.cumsum(families["row_size"].values)
    levels, types = families[parameter].values, families["type"].values
    wanted = energy if parameter == "energy" else ball.k
    found = []
    for number, (last, size) in enumerate(zip(ends, families["row_size"].values, strict=True)):
        period = int(families["period"].values[number])
        for i in range(last - size, last - 1):
            a, b = levels[i], levels[i + 1]
            if (a < wanted) == (b < wanted) or "elliptic" not in (types[i], types[i + 1]):
                continue
            part = (wanted - a) / (b - a)
            x, y = (
                float(families[name].values[i] * (1.0 - part) + families[name].values[i + 1] * part)
                for name in "xy"
            )
            orbit = _closed(ball, energy, x, y, period)
            if orbit is not None:
                found.append((number, orbit))
                if families["line"].values[number] == "none":  # the mirror image is another orbit
                    found.append((number, orbit * np.array([[1.0], [-1.0]])))
    return found


def _closed(ball: Ball, energy: float, x: float, y: float, period: int) -> Any:
    """Return the points (2, period) of the elliptic orbit next to (x, y), or None."""
    _, radius = ball.section(energy)
    for _ in range(_NEWTON_STEPS):
        try:
            state = ball.state_xy(x, y, energy)
        except ValueError:  # off the section
            return None
        states = [state]
        for _ in range(period):
            states.append(ball.impact(*states[-1])[:3])
        points = np.array([(s[0], s[1] - ball.k * s[2]) for s in states]).T
        (a, b), (c, d) = ball.chart_jacobian(*state, impacts=period)
        gap_x, gap_y = points[:, -1] - points[:, 0]
        if abs(gap_x) + abs(gap_y) < _CLOSED * radius:
            return points[:, :-1] if abs(a + d) < 2.0 else None
        step = cramer([(a - 1.0, b), (c, d - 1.0)], (gap_x, gap_y))
        if step is None:
            return None
        x, y = x + step[0], y + step[1]
    return None


def shares(
    ball: Ball,
    energy: float,
    families: xr.Dataset,
    parameter: str,
    span: list[float],
    step: float,
    starts: int,
    impacts: int,
    *,
    progress: Callable[[float, str], None] | None = None,
) -> xr.Dataset:
    """Compute the regular share along E or k, the chains in it, and causes of its extrema.

    A regular share has the bits of the sweep's cell with the same k, E/g^2, starts and impacts.

    Parameters
    ----------
    ball : Ball
    energy : float
        Along k, E/g^2 is that of this energy.
    families : xarray.Dataset
        From `analyses.families.families`, against the same parameter.
    parameter : {"energy", "k"}
    span : (float, float)
        Least and largest value of the parameter.
    step : float
        Distance between two values, which are its multiples.
    starts, impacts : int
        As for `sweep.cell.cell`.
    progress : callable, optional
        Called with the share done and a text; the values count for one half of it.

    Returns
    -------
    xarray.Dataset
        On `value`: energy, k, regular, regular_low and regular_high, and outside, the share that
        goes around no elliptic orbit of the families; share on (value, family); beyond on (value,
        resonance), the part of the main island beyond a resonance of the fixed point. On
        `breakup`: where the last invariant curve beyond a resonance breaks, or the first one forms,
        by `sweep.breakup`, if the part beyond it vanishes or appears along the line. On
        `extremum`: the minima and maxima of the share, and on (extremum, side) which chain changes
        most from there to the nearest value that differs, and its nearest event. On `slope`, the
        line between neighbouring extrema or to its ends: the chains that change most; see `causes`.

    Examples
    --------
    >>> from pseudorigid import Ball
    >>> from extensions.families.families import families
    >>> ball, span = Ball(k=0.2, g=0.04), [0.01, 0.012]
    >>> held = families(ball, 0.01, "energy", span, 6, 2)
    >>> shares(ball, 0.01, held, "energy", span, 0.001, 10, 1000)["energy"].values.tolist()
    [0.01, 0.011, 0.012]
    """
    square = Fraction(str(ball.g)) ** 2
    unit, low, high = (Fraction(str(value)) for value in (step, *span))
    rows, counts, beyond, rotations = [], [], [], []
    resonances = _resonances(families)
    numbers = range(-int(-low // unit), int(high // unit) + 1)
    for done, i in enumerate(numbers):
        if progress is not None:
            progress(0.5 * done / len(numbers), f"{done} of {len(numbers)} values")
        value = unit * i
        level = value if parameter == "energy" else Fraction(str(energy))
        this = ball if parameter == "energy" else Ball(float(value), ball.g)
        e = float(level / square)
        states = sunflower_points(this.k, e, starts)
        place, _, turn = fixed_point.numbers(this.k, e)
        rotations.append(turn)
        centre, expected = np.full(starts, place), np.full(starts, turn)
        verdicts = classify_orbits(this.k, states, centre, expected, impacts)
        regular = [a[verdicts.regular] for a in states]
        owners = _owners(this, float(level), families, parameter, regular)
        counts.append(np.bincount(owners[owners >= 0], minlength=families.sizes["family"]))
        island = (owners >= 0) & (families["period"].values[owners] == 1)
        winding = verdicts.winding[verdicts.regular][island]
        ratios = [turns / order for turns, order in resonances]
        beyond.append([np.sum((winding - ratio) * (turn - ratio) < 0.0) for ratio in ratios])
        bounds = (
            wilson(int(verdicts.strict.sum()), starts)[0],
            wilson(int(verdicts.lenient.sum()), starts)[1],
        )
        shares_here = verdicts.regular.sum() / starts, *bounds, np.sum(owners < 0) / starts
        rows.append((float(level), this.k, *shares_here))
    columns = np.array(rows).T
    share = np.array(counts) / starts
    values = columns[0] if parameter == "energy" else columns[1]
    parts = np.array(beyond).reshape(len(rows), len(resonances)) / starts
    table = {
        "share": (("value", "family"), share, "share in the chain of a family"),
        "resonance_turns": ("resonance", [turns for turns, _ in resonances], "p of p/q"),
        "resonance_order": ("resonance", [order for _, order in resonances], "q of p/q"),
        "beyond": (("value", "resonance"), parts, "share in the main island beyond p/q"),
    }

    def at(value: float) -> tuple[Ball, float]:
        return (ball, value) if parameter == "energy" else (Ball(value, ball.g), float(energy))

    curves = _breakups(at, values, np.array(rotations), resonances, parts, progress)
    data = described(table) | variables("value", columns, _OF_VALUES)
    data |= variables("breakup", _columns(curves, 3)[:2], _OF_BREAKUPS)
    data |= causes(families, parameter, values, columns[2:5], share, curves, step)
    return xr.Dataset(data, attrs={"starts": starts, "impacts": impacts})


def _columns(rows: list, count: int) -> list:
    """Return the columns of a table, which may have no rows."""
    return [[row[i] for row in rows] for i in range(count)]


def _owners(
    ball: Ball, level: float, families: xr.Dataset, parameter: str, states: list
) -> np.ndarray:
    """Return the family of each regular orbit, -1 if it goes around no elliptic orbit."""
    count = states[0].size
    owners, longest = np.full(count, -1), np.zeros(count, np.int64)
    orbits = elliptic_orbits(ball, families, parameter, level)
    most = max((points.shape[1] for _, points in orbits), default=1)
    # the sweep's unit of length is g R
    out = ball.history([a * ball.g for a in states], ROUNDS * most)
    x, y = out[:, :, 0], out[:, :, 1] - ball.k * out[:, :, 2]
    for number, points in orbits:
        period = points.shape[1]
        for i in np.flatnonzero(longest < period).tolist():
            path = slice(0, ROUNDS * period, period)
            across, up = x[i, path].copy(), y[i, path].copy()
            inside = 0
            for at_x, at_y in points.T.tolist():
                inside += _goes_around(across, up, at_x, at_y)
                if inside > 1:
                    break
            if inside == 1:
                owners[i], longest[i] = number, period
    return owners


def extrema(share: np.ndarray, low: np.ndarray, high: np.ndarray) -> list[tuple[int, int, int]]:
    """Return (index, left, right) of the minima and maxima of a curve with intervals.

    At `left` and `right`, the nearest such values on both sides, the interval is disjoint from that
    at the extremum, and the curve has not passed the extremum's value before. Of equal values the
    first one counts.
    """
    found = []
    for sign in (1.0, -1.0):
        value = sign * share
        below, above = (low, high) if sign > 0.0 else (-high, -low)
        for i in range(share.size):
            sides = []
            for order in (range(i - 1, -1, -1), range(i + 1, share.size)):
                for j in order:
                    if value[j] < value[i] or (value[j] == value[i] and j < i):
                        break
                    if below[j] > above[i]:
                        sides.append(j)
                        break
            if len(sides) == 2:
                found.append((i, *sides))
    return sorted(found)


def _resonances(families: xr.Dataset) -> list[tuple[int, int]]:
    """Return (p, q) of the resonances p/q that the fixed point passes, by the ratio."""
    fixed = families["period"].values[families["event_family"].values] == 1
    chosen = np.flatnonzero(fixed & (families["event_kind"].values == "resonance")).tolist()
    names = "event_turns", "event_order"
    pairs = {tuple(int(families[name].values[i]) for name in names) for i in chosen}
    return sorted(pairs, key=lambda pair: pair[0] / pair[1])


def _breakups(
    at: Callable,
    values: np.ndarray,
    rotations: np.ndarray,
    resonances: list,
    parts: np.ndarray,
    progress: Callable[[float, str], None] | None,
) -> list[tuple[str, float, np.ndarray]]:
    """Return event, parameter and part beyond it of curves that break or form along the line."""
    found = []
    for done, ((p, q), zone) in enumerate(zip(resonances, parts.T, strict=True)):
        if progress is not None:
            progress(0.5 + 0.5 * done / len(resonances), f"curves beyond {p}/{q}")
        side = rotations > p / q
        for m, step in ((m, step) for m in range(values.size) for step in (1, -1)):
            # The chain is born at the fixed point, and no curve breaks, where the side changes.
            i = m + step
            if not 0 <= i < values.size or not zone[m] > _SEEN >= zone[i] or side[m] != side[i]:
                continue
            first, last = (
                j if 0 <= j < values.size and side[j] == side[m] else near
                for j, near in ((m - step, m), (i + step, i))
            )
            place = breakup(at, p, q, float(values[first]), float(values[last]))
            word = f"last curve beyond {p}/{q} breaks"
            if step < 0:
                word = f"first curve beyond {p}/{q} forms"
            found.append((word, place, zone))
    return found


def causes(families, parameter, values, regular, share, curves, step) -> dict:
    """Return variables on `extremum`, (extremum, side) and `slope` from the shares (value, family).

    `regular` holds the regular share and the ends of its interval; `curves` are those of
    `_breakups`. A change is that from an extremum to the nearest value that differs by more than
    the intervals, or to the neighbouring extremum. An event is the cause of an extremum only if its
    chain, the one that changes most, accounts for at least half of such a change and the event lies
    within one step of the extremum. That the last curve beyond p/q breaks, or the first one forms,
    is such an event, whose chain is the part of the main island beyond p/q.
    """
    rows, sides_of, slopes = [], [], []
    found = extrema(*regular)
    turning = [0, *(i for i, *_ in found), len(values) - 1]

    def parts(i: int, j: int, column: np.ndarray) -> Any:
        change = regular[0][j] - regular[0][i]
        return (column[j] - column[i]) / (change if change != 0.0 else math.inf)

    for n, (i, *sides) in enumerate(found, 1):
        cause: tuple = (0.0, -1, "unexplained", math.nan)
        beside = []
        for j in (*sides, turning[n - 1], turning[n + 1]):
            changed = parts(i, j, share)
            number = int(np.argmax(changed))
            part = float(changed[number])
            events = _events_of(families, parameter, number)
            event, at = min(
                events, key=lambda item: abs(item[1] - values[i]), default=("", math.nan)
            )
            beside.append((values[j], number, part, event, at))
            near = [(part, number, event, at)]
            near += [(float(parts(i, j, zone)), -1, name, at) for name, at, zone in curves]
            for row in near:
                if row[0] >= _HALF and abs(row[3] - values[i]) <= step * (1.0 + 1e-9):
                    cause = max(cause, row, key=lambda row: row[0])
        kind = "minimum" if regular[0][sides[0]] > regular[0][i] else "maximum"
        rows.append((values[i], kind, *cause[1:]))
        sides_of.append(beside[:2])
    for i, j in pairwise(turning) if found else ():
        changed = parts(i, j, share)
        most = np.argsort(-np.abs(changed), kind="stable")[:_LARGEST].tolist()
        slopes.append((values[i], values[j], regular[0][j] - regular[0][i], most, changed[most]))
    sides = [
        [[row[i] for row in pair] for pair in sides_of] or np.empty((0, 2))
        for i in range(len(_OF_SIDES))
    ]
    largest = min(_LARGEST, share.shape[1])
    families_of, parts_of = (
        np.array([row[i] for row in slopes]).reshape(len(slopes), largest) for i in (3, 4)
    )
    return (
        variables("extremum", _columns(rows, len(_OF_EXTREMA)), _OF_EXTREMA)
        | variables(("extremum", "side"), sides, _OF_SIDES)
        | variables("slope", _columns(slopes, len(_OF_SLOPES)), _OF_SLOPES)
        | variables(("slope", "largest"), (families_of, parts_of), _OF_LARGEST)
    )


def _events_of(families: xr.Dataset, parameter: str, number: int) -> list[tuple[str, float]]:
    """Return the events and ends of a family with their energies."""
    chosen = np.flatnonzero(families["event_family"].values == number)
    found = []
    for i in chosen.tolist():
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
