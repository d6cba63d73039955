"""What checks look up: formulas of the derivations, bounds of theorems, and cells of sweeps."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from .outcomes import CORRECTED, FALSE, PROVED, Outcome


def formula(algebra: xr.Dataset, *names: str) -> tuple[bool, bool]:
    """Return whether all formulas hold as printed, and whether all hold as printed or corrected.

    One that the paper does not print (printed is -1) counts as `corrected` does, in both.
    """
    rows = algebra.sel(formula=list(names))
    printed, corrected = rows["printed"].values, rows["corrected"].values
    holds = (printed == 1) | ((printed == -1) & (corrected == 1))
    return bool(np.all(holds)), bool(np.all((printed == 1) | (corrected == 1)))


def derived(algebra: xr.Dataset, *names: str) -> Outcome:
    """Return the outcome for formulas that computer algebra settles, with the numbers of all."""
    holds, mended = formula(algebra, *names)
    return Outcome(PROVED if holds else CORRECTED if mended else FALSE, numbers_of(algebra))


def numbers_of(algebra: xr.Dataset) -> dict[str, float]:
    """Return formula -> its number."""
    return dict(zip(algebra["formula"].values.tolist(), algebra["value"].values, strict=True))


def bounds_of(theorem: str) -> Mapping[str, Any]:
    """Return the bounds in the statement of a theorem."""
    from extensions.proofs import THEOREMS

    bounds: Mapping[str, Any] = THEOREMS[theorem].bounds
    return bounds


def energy_of(theorem: str) -> float:
    """Return a theorem's energy; if it encloses an energy, the lower end of the enclosure."""
    bounds = bounds_of(theorem)
    return float(bounds["surface"].energy if "surface" in bounds else bounds["energies"][0])


def enclosed(proved: Mapping[str, bool]) -> list[dict[str, Any]]:
    """Return a row for each proved theorem that bounds the area inside invariant curves.

    `share` is the proved lower bound of the share of the section inside one curve, and `period` the
    number of curves.
    """
    bounds = [bounds_of(name) for name, known in proved.items() if known]
    return [
        {"share": float(b["share"]), "energy": float(b["surface"].energy), "period": b["period"]}
        for b in bounds
        if "share" in b
    ]


def entropy_bound(proved: Mapping[str, bool]) -> dict[str, Any]:
    """Return whether the theorem `entropy` is proved, and its bound, in nats per impact."""
    return {"entropy": proved["entropy"], "entropy_bound": float(bounds_of("entropy")["entropy"])}


def regular_share(sweep: xr.Dataset, row: int, scaled_energy: float) -> dict[str, float]:
    """Return share, low, high, k and energy of the cell of a sweep's row nearest to an E/g^2."""
    cell = sweep.isel(k=row).sel(energy=scaled_energy, method="nearest")
    names = {"regular": "share", "regular_low": "low", "regular_high": "high"}
    names |= {"k": "k", "energy": "energy"}
    return {name: float(cell[variable]) for variable, name in names.items()}
