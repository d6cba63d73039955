"""The parts of the study, as stages, whose data are equal on every machine."""

from typing import Any

import xarray as xr

from . import failures, figure_errors, states
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


def needs(
    *datasets: xr.Dataset, scenes: dict[str, Any], measures: dict[str, str], inputs: list[str]
) -> xr.Dataset:
    """Measure the error of each figure by each method.

    `scenes` are blocks of config by name, `measures` their kinds of picture; `inputs` name the
    datasets STAGE/SCENE.
    """
    keys = [tuple(name.split("/")) for name in inputs]
    figures = dict(zip(keys, datasets, strict=True))
    return described("needs", figure_errors.figure_errors(scenes, measures, figures))


def described(part: str, dataset: xr.Dataset) -> xr.Dataset:
    """Return a dataset with the attributes of a part of the study."""
    ball = {"k": states.BALL.k, "g": states.BALL.g, "energy": states.ENERGY}
    return dataset.assign_attrs(stage="study", title=f"Methods compared: {part}", **ball)
