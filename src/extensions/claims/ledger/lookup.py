"""What checks look up: formulas of the derivations, bounds of theorems, and cells of sweeps."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from .outcomes import CORRECTED, FALSE, PROVED, Outcome


def formula(algebra: xr.Dataset, *names: str) -> tuple[bool, bool]:
    """Return whether formulas of the derivations all hold as printed, and when corrected."""
    rows = algebra.sel(formula=list(names))
    printed, corrected = rows["printed"].values, rows["corrected"].values
    holds = (printed == 1) | ((printed == -1) & (corrected == 1))
    return bool(np.all(holds)), bool(np.all((printed == 1) | (corrected == 1)))


def derived(algebra: xr.Dataset, *names: str) -> Outcome:
    """Return the outcome for formulas that computer algebra settles, with all formulas' numbers."""
    holds, mended = formula(algebra, *names)
    return Outcome(PROVED if holds else CORRECTED if mended else FALSE, numbers_of(algebra))


def numbers_of(algebra: xr.Dataset) -> dict[str, float]:
    """Return formula -> the number that comes with it."""
    return dict(zip(algebra["formula"].values.tolist(), algebra["value"].values, strict=True))


def bounds_of(theorem: str) -> Mapping[str, Any]:
    """Return the bounds in the statement of a theorem."""
    from extensions.proofs import THEOREMS

    bounds: Mapping[str, Any] = THEOREMS[theorem].bounds
    return bounds


def energy_of(theorem: str) -> float:
    """Return the energy of a theorem, or the lower bound of the one that its statement encloses."""
    bounds = bounds_of(theorem)
    return float(bounds["surface"].energy if "surface" in bounds else bounds["energies"][0])


def enclosed(proved: Mapping[str, bool]) -> list[dict[str, Any]]:
    """Return what the invariant curves among the proved theorems enclose, one row for each.

    `share` is a lower bound, of the section, that the theorem states for the disc inside one curve;
    `period` is the number of such discs.
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


def regular_share(sweep: xr.Dataset, row: int, energy: float) -> dict[str, float]:
    """Return the regular share of a sweep's row, and its interval, at the nearest E/g^2."""
    cell = sweep.isel(k=row).sel(energy=energy, method="nearest")
    names = {"regular": "share", "regular_low": "low", "regular_high": "high"}
    return {names.get(n, n): float(cell[n]) for n in (*names, "k", "energy")}
