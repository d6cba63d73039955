"""Checks of claims of the paper's sections 4.2 and 5: twist, conjecture, KAM theory."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from pseudorigid.analyses.regularity import regular
from pseudorigid.analyses.rotation import island

from .schema import CORRECTED, HOLDS, PROVED, UNDECIDED, Outcome, Series, enclosed, formula

ROTATION_ACCURACY = 1e-8  # turns per impact
# A regular share remains, or is gone, above and below these parts of the impact map's own.
REMAINS, GONE = 0.5, 0.2
# A reversor reverses a map if it misses by less than this, in section radii; none of those tried
# does if all miss by more than this part of the strength.
REVERSED, NOT_REVERSED = 1e-9, 0.1
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
    numbers |= {"zero": proved["twist-zero"], "once": proved["twist-one-zero"]}
    return Outcome(HOLDS if turning else UNDECIDED, numbers)


def _rises_and_falls(rotation: xr.Dataset, row: int) -> tuple[int, int]:
    """Count rises and falls of the rotation number from start to start across the main island."""
    size = island(rotation, row)
    good = regular(rotation["exponent"].values[row, :size], rotation.attrs["impacts"])
    steps = np.diff(rotation["rotation"].values[row, :size][good])
    return int(np.sum(steps > ROTATION_ACCURACY)), int(np.sum(steps < -ROTATION_ACCURACY))


def conjecture(algebra: xr.Dataset, control: xr.Dataset, proved: Mapping[str, bool]) -> Outcome:
    """Compare the regular shares of maps that keep area or the reversor with those that keep none.

    The two properties are separate at strengths at which the regular share remains with either
    alone and goes with neither, and at which the map with the reversor alone has attracting orbits.
    """
    last = control.isel(length=-1)
    regular = {
        end: last[f"class_{end}"].sel({"class": "regular"}) for end in ("share", "low", "high")
    }
    attracted = last["class_low"].sel({"class": "spiral", "map": "reversor"}).values
    itself = float(regular["share"].values[0, 0])
    remains = regular["low"].sel(map=["area", "reversor"]).values.min(axis=0) > REMAINS * itself
    neither = regular["high"].sel(map=["neither", "damped"]).values.max(axis=0)
    defect = last["defect"].sel(map=["area", "reversor"]).values
    strength = last["strength"].values
    reversed_ = (defect[1] < REVERSED) & (defect[0] > NOT_REVERSED * strength)
    chosen = (strength > 0.0) & remains & (neither < GONE * itself) & (attracted > 0.0) & reversed_
    if not (chosen.any() and formula(algebra, "area", "reversible")[1]):
        return Outcome(UNDECIDED, case="mixed")
    numbers: dict[str, Any] = {"strengths": Series(strength[chosen]), "itself": itself}
    numbers |= {
        name: Series(regular["share"].sel(map=name).values[chosen]) for name in ("area", "reversor")
    }
    reach = 0.5 * (regular["high"] - regular["low"]).sel(map=["area", "reversor"]).values
    numbers |= {"neither": neither[chosen].max(), "error": reach[:, chosen].max()}
    return Outcome(CORRECTED, numbers | {"known": all(proved.values())})


def kam(proved: Mapping[str, bool]) -> Outcome:
    """List the theorems of invariant curves that are proved, near points and of visible size."""
    sized = {name: known for name, known in proved.items() if name.startswith("curve-")}
    names = Series(name for name, known in proved.items() if known and name not in sized)
    word = PROVED if all(proved.values()) else UNDECIDED
    numbers = {"names": names, "curves": enclosed(sized), "closed": any(sized.values())}
    return Outcome(word, numbers, case="" if names else "unproved")


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
