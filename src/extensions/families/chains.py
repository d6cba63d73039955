"""Curves over the plane of k and E/g^2: births of chains, and where they lose stability."""

from itertools import pairwise

import numpy as np
import xarray as xr

from extensions.atlas.cell import AXES
from pseudorigid.dynamics import fixed_point
from pseudorigid.dynamics.variables import attributes_of, described

from .continuation.loci import Limits, chain_events, energy_at, follow, lost_impact

KINDS = "resonance", "fold", "doubling", "rim", "jumps"
_POINTS = 401  # values of k of the curves that are solved for at each k
_SOUGHT = 8  # values of k at which a chain's events are sought
_ASIDE = 1.01  # factor from the least k of the doublings to where folds are sought
_SAME = 1e-2  # relative difference of energies of the same curve, between its points
_BEYOND = 0.01  # how far the curves reach beyond the cells, as a share of the axes' spans

Rows = list[tuple[float, float]]  # k and E/g^2


def chains(k: list[float], energy: list[float], chains: list[int]) -> xr.Dataset:
    """Follow births and losses of stability of the chains 1/q over the plane of a sweep.

    A chain is that of the period-q orbit that branches off where the fixed point's rotation number
    is 1/q. Its events are found at nine k at which this lies in the plane, and followed in k. The k
    and energies, E/g^2, of a sweep span the plane; its `chains` has the orders q.

    The kind of a curve is "resonance" 1/q of the fixed point, "fold" where an elliptic orbit of the
    chain is born or ends, its first "doubling", the "rim", where it loses an impact while the ball
    is at rest on the floor, or "jumps" (order 0), above which the map jumps. On `point` are the
    curves one after the other (CF).
    """
    spans = [_wider(np.array(axis)) for axis in (k, energy)]
    limits = Limits((max(spans[0][0], 1e-3), spans[0][1]), spans[1])
    low, high = limits.k
    grid = [low + (high - low) * i / (_POINTS - 1) for i in range(_POINTS)]
    curves = [(0, "jumps", _within([(k, 1.0 + 0.5 * k) for k in grid], limits))]
    for order in chains:
        inside = _within([(k, fixed_point.resonance(k, 1, order)) for k in grid], limits)
        if inside:
            curves.append((order, "resonance", inside))
            curves += [(order, *curve) for curve in _events(order, inside, grid, limits)]
    curves = [curve for curve in curves if curve[-1]]
    points = np.array([pair for _, _, rows in curves for pair in rows]).reshape(-1, 2)
    table = {
        "order": ("curve", [order for order, _, _ in curves], "q of the chain 1/q; 0 for jumps"),
        "kind": ("curve", [kind for _, kind, _ in curves], ", ".join(KINDS)),
        "row_size": ("curve", [len(rows) for _, _, rows in curves], "points of each curve"),
    }
    data = described(table)
    data["row_size"][2]["sample_dimension"] = "point"
    for i, axis in enumerate(AXES):
        data[axis] = ("point", points[:, i], attributes_of(*AXES[axis]))
    return xr.Dataset(data)


def _wider(values: np.ndarray) -> tuple[float, float]:
    """Return the ends of an axis, a little farther apart."""
    margin = _BEYOND * (values[-1] - values[0])
    low = values[0] * (1.0 - _BEYOND) if 0.0 < values[0] < margin else values[0] - margin
    return float(low), float(values[-1] + margin)


def _within(rows: Rows, limits: Limits) -> Rows:
    """Return the rows whose energies lie in the plane."""
    low, high = limits.energy
    return [(k, energy) for k, energy in rows if low <= energy <= high]


def _events(order: int, resonance: Rows, grid: list[float], limits: Limits) -> list:
    """Return (kind, rows) of folds, first doubling and rim of a chain.

    They are sought at some k at which the resonance lies in the plane, and next to the least k of
    the doublings, where folds are near. They are followed from the first k at which they are found,
    unless a curve already passes there.
    """
    curves: list[tuple[str, Rows]] = []

    def add(k: float) -> None:
        for kind, start in chain_events(k, order).items():
            energy = float(energy_at(start.place))
            if any(kind == known and _passes(rows, k, energy) for known, rows in curves):
                continue
            if kind == "rim":
                rows = _within(_rim(order, k, start.place[1], grid), limits)
            else:
                points = follow(order, start, limits)
                rows = [(float(z.place[2]), float(energy_at(z.place))) for z in points]
            if rows:
                curves.append((kind, rows if rows[0][0] < rows[-1][0] else rows[::-1]))

    for i in reversed(range(_SOUGHT)):
        add(resonance[(2 * i + 1) * len(resonance) // (2 * _SOUGHT)][0])
    ends = [rows[0][0] for kind, rows in curves if kind == "doubling"]
    if ends:
        add(_ASIDE * min(ends))
    return curves


def _passes(rows: Rows, k: float, energy: float) -> bool:
    """Return whether a curve passes through a point of the plane."""
    for (k0, e0), (k1, e1) in pairwise(rows):
        if min(k0, k1) <= k <= max(k0, k1) and k0 != k1:
            there = e0 + (e1 - e0) * (k - k0) / (k1 - k0)
            if abs(there - energy) <= _SAME * abs(energy):
                return True
    return False


def _rim(order: int, middle: float, rho: float, grid: list[float]) -> Rows:
    """Return (k, E/g^2) at which a chain loses an impact, from the k where rho is known."""
    rows = {}
    ends = [k for k in grid if k > middle], [k for k in reversed(grid) if k <= middle]
    for side in ends:
        near = rho
        for k in side:
            near = lost_impact(k, order, near)
            if not near > 1.0:
                break
            rows[k] = float(energy_at((-1.0, near, k)))
    return sorted(rows.items())
