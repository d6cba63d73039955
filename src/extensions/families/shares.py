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
from itertools import product
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from extensions.atlas.cell import wilson
from extensions.atlas.starts import sunflower_points
from pseudorigid.dynamics import fixed_point
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.variables import ENERGY, variables
from pseudorigid.dynamics.verdict import classify_orbits
from pseudorigid.kernel.compiled import jit
from pseudorigid.kernel.tangents import angle

from .breakup import breakup
from .causes import LARGEST, causes
from .continuation.asymmetric import AsymmetricOrbits
from .continuation.curve import solve_at
from .continuation.half_orbit import ENERGY as BY_ENERGY
from .continuation.symmetric import Parameter

ROUNDS = 200  # points under P^n by which an orbit is seen to go around a point
_WIDEST = 2.8  # radians: the largest angle without a point, as seen from a point inside
_REACH = 0.05  # largest way from a point between two of a family to its orbit, in section radii
_SEEN = 0.002  # share of the section; smaller ones may be a few orbits that stick to islands

# Dims -> variable -> its meaning, or (meaning, scale).
_VARIABLES: dict[tuple[str, ...], dict[str, Any]] = {
    ("value", "family"): {"share": "share in the chain of a family"},
    ("resonance",): {"resonance_turns": "p of p/q", "resonance_order": "q of p/q"},
    ("value", "resonance"): {"beyond": "share in the main island beyond p/q"},
    ("value",): {
        "energy": ("energy", ENERGY),
        "k": "Euler inertia, eq. (5)",
        "regular": "share of the section's area with regular orbits",
        "regular_low": "lower end of its 95 % interval, starts and threshold together",
        "regular_high": "upper end of its 95 % interval, starts and threshold together",
        "outside": "share of regular orbits that go around no orbit of the families",
    },
    ("breakup",): {
        "breakup_event": "last curve beyond p/q that breaks, or first one that forms",
        "breakup_at": "energy, or k, of it by Greene's criterion, NaN if none is found",
    },
    ("extremum",): {
        "extremum_at": "energy, or k, of an extremum of the regular share",
        "extremum_kind": "minimum or maximum",
        "cause_family": "family whose event is the cause, -1 for a curve or if there is none",
        "cause_event": "that event, or the curve beyond p/q that breaks or forms, or unexplained",
        "cause_at": "energy, or k, of that event",
    },
    ("extremum", "side"): {
        "side_at": "nearest value on that side at which the regular share differs",
        "side_family": "family whose chain changes most from the extremum to there",
        "side_part": "its change over the change of the regular share",
        "side_event": "event or end of that family nearest to the extremum",
        "side_event_at": "energy, or k, of that event",
    },
    ("slope",): {
        "slope_from": "energy, or k, at which the line between neighbouring extrema begins",
        "slope_to": "energy, or k, at which it ends",
        "slope_change": "change of the regular share along it",
    },
    ("slope", "largest"): {
        "slope_family": "families whose chains change most along it",
        "slope_part": "their changes over the change of the regular share",
    },
}


class Line(NamedTuple):
    """A line of E or k along which families were followed."""

    ball: Ball
    energy: float  # of the whole line if it is one of k
    parameter: str
    families: xr.Dataset

    def ball_and_energy(self, value: float) -> tuple[Ball, float]:
        """Return the ball and the energy at a value of the parameter."""
        if self.parameter == "energy":
            return self.ball, value
        return Ball(value, self.ball.g), float(self.energy)

    def resonances(self) -> list[tuple[int, int]]:
        """Return (p, q) of the resonances p/q that the fixed point passes, by the ratio."""
        families = self.families
        fixed = families["period"].values[families["event_family"].values] == 1
        chosen = fixed & (families["event_kind"].values == "resonance")
        turns, orders = (families[f"event_{name}"].values[chosen] for name in ("turns", "order"))
        pairs = {*zip(turns.tolist(), orders.tolist(), strict=True)}
        return sorted(pairs, key=lambda pair: pair[0] / pair[1])


@jit
def _goes_around(x: np.ndarray, y: np.ndarray, at_x: float, at_y: float) -> bool:
    """Return whether the points (n,) are seen from (at_x, at_y) in all directions."""
    angles = np.empty(x.size)
    for i in range(x.size):
        angles[i] = angle(x[i] - at_x, y[i] - at_y)
    angles.sort()
    widest = angles[0] + 2.0 * math.pi - angles[-1]
    for i in range(1, x.size):
        widest = max(widest, angles[i] - angles[i - 1])
    return widest < _WIDEST


def elliptic_orbits(line: Line, value: float) -> list[tuple[int, np.ndarray]]:
    """Return (family, points (2, period) in (x, y)) of the elliptic orbits at a value."""
    families = line.families
    levels, types = families[line.parameter].values, families["type"].values
    number = np.repeat(np.arange(families.sizes["family"]), families["row_size"].values)
    below, elliptic = levels < value, types == "elliptic"
    crossed = (below[1:] != below[:-1]) & (elliptic[1:] | elliptic[:-1])
    found = []
    for i in np.flatnonzero(crossed & (number[1:] == number[:-1])).tolist():
        part = (value - levels[i]) / (levels[i + 1] - levels[i])
        x, y = (
            float(values[i] * (1.0 - part) + values[i + 1] * part)
            for values in (families["x"].values, families["y"].values)
        )
        family = int(number[i])
        orbit = _elliptic_orbit(
            *line.ball_and_energy(value), x, y, int(families["period"].values[family])
        )
        if orbit is not None:
            found.append((family, orbit))
            if families["line"].values[family] == "none":  # the mirror image is another orbit
                found.append((family, orbit * np.array([[1.0], [-1.0]])))
    return found


def _elliptic_orbit(
    ball: Ball, energy: float, x: float, y: float, period: int
) -> np.ndarray | None:
    """Return the points (2, period) of the elliptic orbit next to (x, y), or None."""
    centre, radius = ball.section(energy)
    high = radius * math.sqrt(ball.k * (1.0 + ball.k))
    rho = math.sqrt(1.0 + 2.0 * ball.k * (energy / (ball.g * ball.g)))
    system = AsymmetricOrbits(period, Parameter(BY_ENERGY, ball.k, 0.5 * rho, 2.0 * rho))
    orbit = solve_at(system, ((x - centre) / radius, y / high, rho), _REACH)
    if orbit is None or abs(system.trace(orbit)) >= 2.0:
        return None
    return (orbit.data.points[:-1] * [radius, high] + [centre, 0.0]).T


def shares(
    ball: Ball, energy: float, families: xr.Dataset, parameter: str, span: list[float],
    step: float, starts: int, impacts: int, *,
    progress: Callable[[float, str], None] | None = None,
) -> xr.Dataset:  # fmt: skip
    """Compute the regular share along E or k, the chains in it, and causes of its extrema.

    A regular share equals the sweep's cell with the same k, E/g^2, starts, impacts bit for bit.

    Parameters
    ----------
    ball : Ball
    energy : float
        Along k, E/g^2 is that of this energy.
    families : xarray.Dataset
        From `families`, against the same parameter.
    parameter : {"energy", "k"}
    span : (float, float)
        Least and largest value of the parameter.
    step : float
        Distance between two values, which are its multiples.
    starts, impacts : int
        As for `extensions.atlas.cell.cell`.
    progress : callable, optional
        Called with the share done and a text; the values count for one half of it.

    Returns
    -------
    xarray.Dataset
        long_name describes each variable. On `value`: the regular share and its parts; share on
        (value, family) is the part in the chain of each family, and beyond on (value, resonance)
        that of the main island beyond a resonance of the fixed point. On `breakup`: the last curve
        beyond a resonance that breaks, or the first that forms, if the part beyond it vanishes or
        appears along the line (`breakup`). On `extremum`, (extremum, side) and `slope`, the line
        between neighbouring extrema or to its ends: the chains that change most (`causes`).

    Examples
    --------
    >>> from pseudorigid import Ball
    >>> from extensions.families.dataset import families
    >>> ball, span = Ball(k=0.2, g=0.04), [0.01, 0.012]
    >>> held = families(ball, 0.01, "energy", span, 6, 2)
    >>> shares(ball, 0.01, held, "energy", span, 0.001, 10, 1000)["energy"].values.tolist()
    [0.01, 0.011, 0.012]
    """
    report = progress or (lambda share, text: None)
    line = Line(ball, energy, parameter, families)
    resonances = line.resonances()
    unit, low, high = (Fraction(str(value)) for value in (step, *span))
    values = [unit * i for i in range(-int(-low // unit), int(high // unit) + 1)]
    rows = []
    for done, value in enumerate(values):
        report(0.5 * done / len(values), f"{done} of {len(values)} values")
        rows.append(_shares_at(line, value, resonances, starts, impacts))
    data = _columns(rows)
    beyond = data["beyond"].reshape(len(rows), len(resonances))
    curves = []
    for done, ((p, q), zone) in enumerate(zip(resonances, beyond.T, strict=True)):
        report(0.5 + 0.5 * done / len(resonances), f"curves beyond {p}/{q}")
        curves += _breakups(line, data[parameter], data["rotation"] > p / q, p, q, zone)
    regular = [data[name] for name in ("regular", "regular_low", "regular_high")]
    extrema, slopes = causes(
        families, parameter, data[parameter], regular, data["share"], curves, step
    )
    data |= _columns(extrema) | _columns(slopes)
    data["resonance_turns"], data["resonance_order"] = np.array(resonances).reshape(-1, 2).T
    data["breakup_event"], data["breakup_at"] = (np.array([c[i] for c in curves]) for i in (0, 1))
    sizes = {"value": len(rows), "family": families.sizes["family"], "extremum": len(extrema)}
    sizes |= {"side": 2, "slope": len(slopes), "largest": min(LARGEST, families.sizes["family"])}
    sizes |= {"resonance": len(resonances), "breakup": len(curves)}
    found: dict = {}
    for dims, meanings in _VARIABLES.items():
        shape = [sizes[dim] for dim in dims]
        columns = [np.reshape(data.get(name, []), shape) for name in meanings]
        found |= variables(dims, columns, meanings)
    return xr.Dataset(found, attrs={"starts": starts, "impacts": impacts})


def _columns(rows: list[dict[str, Any]]) -> dict[str, np.ndarray]:
    """Return the columns of a table whose rows are {variable: value}."""
    return {name: np.array([row[name] for row in rows]) for name in rows[0]} if rows else {}


def _shares_at(
    line: Line, value: Fraction, resonances: list[tuple[int, int]], starts: int, impacts: int
) -> dict[str, Any]:
    """Return the variables at a value of the parameter, and the fixed point's rotation number."""
    ball, energy = line.ball_and_energy(float(value))
    level = value if line.parameter == "energy" else Fraction(str(line.energy))
    e = float(level / Fraction(str(ball.g)) ** 2)
    states = sunflower_points(ball.k, e, starts)
    place, _, rotation = fixed_point.numbers(ball.k, e)
    centre, expected = np.full(starts, place), np.full(starts, rotation)
    verdicts = classify_orbits(ball.k, states, centre, expected, impacts)
    regular = [a[verdicts.regular] for a in states]
    owners = _owners(ball, elliptic_orbits(line, float(value)), regular)
    counts = np.bincount(owners[owners >= 0], minlength=line.families.sizes["family"])
    island = (owners >= 0) & (line.families["period"].values[owners] == 1)
    winding = verdicts.winding[verdicts.regular][island]
    beyond = [np.sum((winding - p / q) * (rotation - p / q) < 0.0) for p, q in resonances]
    return {
        "energy": energy,
        "k": ball.k,
        "regular": verdicts.regular.sum() / starts,
        "regular_low": wilson(int(verdicts.strict.sum()), starts)[0],
        "regular_high": wilson(int(verdicts.lenient.sum()), starts)[1],
        "outside": np.sum(owners < 0) / starts,
        "share": counts / starts,
        "beyond": np.array(beyond) / starts,
        "rotation": rotation,
    }


def _owners(
    ball: Ball, orbits: list[tuple[int, np.ndarray]], states: list[np.ndarray]
) -> np.ndarray:
    """Return the family of each regular orbit, -1 if it goes around no elliptic orbit."""
    count = states[0].size
    owners, longest = np.full(count, -1), np.zeros(count, np.int64)
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


def _breakups(
    line: Line, values: np.ndarray, above: np.ndarray, p: int, q: int, beyond: np.ndarray
) -> list[tuple[str, float, np.ndarray]]:
    """Return event, parameter and share beyond p/q (value,) of curves that break or form there.

    `above` has whether the fixed point's rotation number is above p/q at each value.
    """
    found = []
    for m, step in product(range(values.size), (1, -1)):
        # The chain is born at the fixed point, and no curve breaks, where the side changes.
        i = m + step
        if 0 <= i < values.size and beyond[m] > _SEEN >= beyond[i] and above[m] == above[i]:
            first, last = (
                j if 0 <= j < values.size and above[j] == above[m] else near
                for j, near in ((m - step, m), (i + step, i))
            )
            place = breakup(line.ball_and_energy, p, q, float(values[first]), float(values[last]))
            which, event = ("last", "breaks") if step > 0 else ("first", "forms")
            found.append((f"{which} curve beyond {p}/{q} {event}", place, beyond))
    return found
