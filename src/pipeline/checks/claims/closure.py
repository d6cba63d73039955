"""Checks of claims of the paper's sections 4.2 and 5: twist, conjecture, KAM theory."""

from collections.abc import Mapping

import numpy as np
import xarray as xr

from pseudorigid.analyses.regularity import regular
from pseudorigid.analyses.rotation import island

from .schema import HOLDS, PROVED, UNDECIDED, Outcome, Series, formula

ROTATION_ACCURACY = 1e-8  # turns per impact
TURNS_BACK = 0.1  # share of steps against the trend from which on the rotation number turns back


def no_twist_map(rotation: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Count the turns of the rotation number across the main island at each energy."""
    energies = rotation["energy"].values
    counts = [_rises_and_falls(rotation, row) for row in range(energies.size)]
    turning = Series(
        energy
        for energy, steps in zip(energies, counts, strict=True)
        if min(steps) > TURNS_BACK * sum(steps)
    )
    numbers = {"turns": bool(turning), "energies": turning, "monotone": min(counts[0]) == 0}
    numbers |= {"energy": energies[0], "evidence": proved["twist-fixed-point"]}
    return Outcome(HOLDS if turning else UNDECIDED, numbers | {"zero": proved["twist-zero"]})


def _rises_and_falls(rotation: xr.Dataset, row: int) -> tuple[int, int]:
    """Count rises and falls of the rotation number from start to start across the main island."""
    size = island(rotation, row)
    good = regular(rotation["exponent"].values[row, :size], rotation.attrs["impacts"])
    steps = np.diff(rotation["rotation"].values[row, :size][good])
    return int(np.sum(steps > ROTATION_ACCURACY)), int(np.sum(steps < -ROTATION_ACCURACY))


def conjecture(algebra: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Ask which of the map's proved properties are enough for regular behaviour."""
    if not (formula(algebra, "area")[0] and all(proved.values())):
        return Outcome(UNDECIDED, case="unproved")
    return Outcome(UNDECIDED, {"reversor": formula(algebra, "reversible")[1]})


def kam(proved: Mapping[str, bool]) -> Outcome:
    """List the theorems of invariant curves that are proved."""
    names = Series(name for name, known in proved.items() if known)
    word = PROVED if len(names) == len(proved) else UNDECIDED
    return Outcome(word, {"names": names}, case="" if names else "unproved")


def like_kam(proved: Mapping[str, bool]) -> Outcome:
    """Ask for the theorems of invariant curves."""
    return Outcome(HOLDS) if all(proved.values()) else Outcome(UNDECIDED, case="unproved")


def like_twist_maps(rotation: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Count the rises and falls of the rotation number at the lowest energy."""
    rises, falls = _rises_and_falls(rotation, 0)
    monotone = min(rises, falls) == 0 < max(rises, falls)
    numbers = {"known": all(proved.values()), "energy": rotation["energy"].values[0]}
    numbers |= {"falls": falls > rises, "steps": rises + falls}
    return Outcome(HOLDS if monotone else UNDECIDED, numbers)
