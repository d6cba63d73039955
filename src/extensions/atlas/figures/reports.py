"""What the captions of sweeps say of the data."""

from typing import Any

import numpy as np
import xarray as xr


def atlas_facts(block: dict[str, Any], sweep: xr.Dataset) -> dict[str, Any]:
    """Say whether an interval of the regular share lies above that of a lower energy."""
    low, high = (sweep[f"regular_{end}"].values for end in ("low", "high"))
    return {"rises": bool((np.minimum.accumulate(high, axis=1)[:, :-1] < low[:, 1:]).any())}
