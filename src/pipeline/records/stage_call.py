"""Call the function of a stage with the root finder that a scene's `method` selects."""

from collections.abc import Callable, Sequence
from typing import Any

import xarray as xr

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.ensemble import ImpactMap


def compute_stage(
    function: Callable[..., xr.Dataset],
    ball: Ball,
    energy: float,
    inputs: Sequence[xr.Dataset],
    fields: dict[str, Any],
    method: dict[str, Any],
) -> xr.Dataset:
    """Return the dataset of a stage; with a scan, its attributes count (missed) impacts."""
    if "scan" not in method:
        return function(ball, energy, *inputs, **fields)
    root_finder = ImpactMap((method["scan"], method["tolerance"]))
    dataset = function(Ball(ball.k, ball.g, map=root_finder), energy, *inputs, **fields)
    dataset.attrs |= {"impacts": root_finder.impacts, "impacts_missed": root_finder.missed}
    return dataset
