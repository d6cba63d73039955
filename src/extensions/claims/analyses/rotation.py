"""Rotation number and exponent of orbits against their start along y = 0, at several energies."""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from extensions.atlas.symmetry_line import LOCKED, regular, symmetric_fixed_point, winding
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.variables import ENERGY, RADIUS, Variables, described, variables

_MAX_ISLANDS, _MIN_STARTS = 100, 3  # of a chain that `plateaus` reports
_ORBITS = {
    "place": ("start along y = 0, in section radii from the centre", RADIUS),
    "rotation": "rotation number around the fixed point",
    "exponent": "Lyapunov exponent an impact",
}


def rotation(
    ball: Ball, energy: float, energies: Sequence[float], starts: int, impacts: int,
    detail: tuple[float, float], detail_impacts: int,
) -> xr.Dataset:  # fmt: skip
    """Compute rotation numbers around the fixed point, and exponents, of starts along y = 0.

    At each energy the starts go evenly from the fixed point to the section's rim. `island` is how
    many of them, from the fixed point on, precede two chaotic neighbours. At the first
    energy as many starts again go over the part `detail` of y = 0; the names of their variables
    begin with detail_. Rotation numbers and exponents are those of `winding`.

    >>> from pseudorigid import Ball
    >>> data = rotation(Ball(k=0.2, g=0.04), 0.01, [0.001], 10, 200, (-0.8357, -0.8342), 200)
    >>> data.sizes["start"]
    10
    """
    levels = [float(energy), *map(float, energies)]
    middle = (np.arange(starts) + 0.5) / starts
    fixed_points = [symmetric_fixed_point(ball, level) for level in levels]
    orbits = []
    for level, (fixed_place, _) in zip(levels, fixed_points, strict=True):
        place = fixed_place + (1.0 - fixed_place) * middle
        orbits.append((place, *winding(ball, level, place, impacts)))
    data = variables(("energy", "start"), zip(*orbits, strict=True), _ORBITS)
    fixed_places, fixed_rotations = zip(*fixed_points, strict=True)
    meaning = "the fixed point, in section radii from the centre"
    data |= described(
        {
            "energy": ("energy", levels, "energy", ENERGY),
            "fixed_place": ("energy", fixed_places, meaning, RADIUS),
            "fixed_rotation": ("energy", fixed_rotations, "rotation number of the fixed point"),
        }
    )
    place = detail[0] + (detail[1] - detail[0]) * middle
    values = place, *winding(ball, energy, place, detail_impacts)
    data |= variables("detail", values, {f"detail_{name}": text for name, text in _ORBITS.items()})
    data |= _classified(data, impacts, detail_impacts)
    return xr.Dataset(data, attrs={"impacts": impacts, "detail_impacts": detail_impacts})


def _classified(data: Variables, impacts: int, detail_impacts: int) -> Variables:
    """Return which orbits are regular, the main islands' sizes and the plateaus of the detail."""
    calm = regular(data["exponent"][1], impacts)
    of_detail = regular(data["detail_exponent"][1], detail_impacts)
    place, turns = (data[f"detail_{name}"][1][of_detail] for name in ("place", "rotation"))
    p, q, first, last = np.array(plateaus(place, turns)).reshape(-1, 4).T
    words, meaning = ("regular", "chaotic"), "regular or chaotic"
    ends = "start along y = 0 of a chain of islands in the detail"
    return described(
        {
            "type": (("energy", "start"), np.where(calm, *words), meaning),
            "detail_type": ("detail", np.where(of_detail, *words), meaning),
            "island": ("energy", [*map(island, calm)], "starts before two chaotic neighbours"),
            "plateau_turns": ("plateau", p.astype(int), "turns of a chain of islands"),
            "plateau_islands": ("plateau", q.astype(int), "islands of that chain"),
            "plateau_first": ("plateau", first, f"first {ends}", RADIUS),
            "plateau_last": ("plateau", last, f"last {ends}", RADIUS),
        }
    )


def island(regular: np.ndarray) -> int:
    """Return how many orbits, of which some are `regular`, precede two chaotic neighbours."""
    both = ~(regular[:-1] | regular[1:])
    return int(np.argmax(both)) if both.any() else regular.size


def plateaus(place: np.ndarray, turns: np.ndarray) -> list[tuple[int, int, float, float]]:
    """Find chains of islands: neighbouring regular starts with one rotation number p/q.

    `place` and `turns` are the starts, in order, and their rotation numbers. A chain is returned as
    p, q in lowest terms and its first and last start.
    """
    chains = []
    for q in range(2, _MAX_ISLANDS + 1):
        p = np.rint(turns * q).astype(np.int64)
        locked = np.abs(turns - p / q) < LOCKED
        for number in sorted(set(p[locked].tolist())):
            (at,) = np.nonzero(locked & (p == number))
            neighbours = at.size >= _MIN_STARTS and at[-1] - at[0] == at.size - 1
            if neighbours and np.gcd(number, q) == 1:
                chains.append((number, q, float(place[at[0]]), float(place[at[-1]])))
    return chains
