"""What the captions of sweeps say of the data."""

from typing import Any

import numpy as np
import xarray as xr


def atlas_facts(block: dict[str, Any], sweep: xr.Dataset) -> dict[str, Any]:
    """Say whether an interval of the regular share lies above that of a lower energy."""
    low, high = (sweep[f"regular_{end}"].values for end in ("low", "high"))
    return {"rises": bool((np.minimum.accumulate(high, axis=1)[:, :-1] < low[:, 1:]).any())}


def verdicts_facts(block: dict[str, Any], verdicts: xr.Dataset) -> dict[str, Any]:
    """Return how often the rule is wrong or undecided, in percent of the orbits of all sets."""
    last = verdicts.isel(method=-1, length=-1)
    share = {
        "wrong": float((last["missed"] + last["alarms"]).weighted(verdicts["orbits"]).mean()),
        "undecided": float(last["undecided"].weighted(verdicts["orbits"]).mean()),
    }
    impacts = f"{verdicts.attrs['impacts_of_the_truth']:,}"
    return {name: f"{100.0 * value:.1f}" for name, value in share.items()} | {"impacts": impacts}
