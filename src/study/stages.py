"""Stages that compare the compiled methods. Their data are equal on every machine."""

import xarray as xr

from . import failures, states
from . import work as work_precision


def work() -> xr.Dataset:
    """Compare error and evaluations of the compiled methods."""
    return described("work", work_precision.counted())


def edges() -> xr.Dataset:
    """Compare the compiled methods near grazing and near a touch of the floor."""
    return described("edges", failures.edges(failures.EDGE_METHODS))


def drift() -> xr.Dataset:
    """Compare long orbits of the compiled methods."""
    return described("orbits", failures.orbits())


def described(comparison: str, dataset: xr.Dataset) -> xr.Dataset:
    """Return a dataset with its title, and the ball and energy that all comparisons have."""
    ball = {"k": states.BALL.k, "g": states.BALL.g, "energy": states.ENERGY}
    title = f"Methods compared: {comparison}"
    return dataset.assign_attrs(stage="study", title=title, **ball)
