"""Check a supplied dataset by recomputing all of it, or a sample.

A verdict on numbers that no orbit has would say nothing about the paper. Datasets that take seconds
are recomputed by their stage from their own config and compared number by number. Samples are
recomputed of orbits, of the spread of exponents, and of the cells of a sweep.
"""

import json
from functools import cache
from importlib import import_module
from itertools import product
from typing import Any

import numpy as np
import xarray as xr

from pseudorigid.analyses.sea import section_points
from pseudorigid.analyses.spread import in_sea
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.lyapunov import lyapunov_spectrum
from pseudorigid.dynamics.variables import states_of
from pseudorigid.proofs.derivations import derivations
from pseudorigid.sweep.cell import cell

from ...config.schema.stages import STAGES
from ...records.artifacts import ABOUT
from ...records.stage_call import compute_stage

TOLERANCE = 1e-9  # of a number that is computed twice
ENERGY_TOLERANCE = 1e-11  # of a state
SAMPLE_SIZE = 8  # orbits
CHECKED_IMPACTS = 4096  # that are recomputed of a regular orbit
MEAN_TOLERANCE = 6.0  # standard errors
# Attributes that a file has besides those that its stage returns.
SAVED_ATTRIBUTES = {"k", "g", "energy", "stage", "config", "title", *ABOUT}


def dataset_error(stage: str, dataset: xr.Dataset) -> str | None:
    """Return what is wrong with a dataset of a stage, in words, or None.

    The sweeps are the stages "line" and "plane".
    """
    try:
        return CHECKS[stage](dataset) if stage in CHECKS else _recompute(stage, dataset)
    except (ArithmeticError, LookupError, MemoryError, TypeError, ValueError) as error:
        return f"it cannot be read as one ({error})"


def _ball(dataset: xr.Dataset) -> tuple[Ball, float]:
    """Return the ball and the energy of a dataset."""
    k, g, energy = (float(dataset.attrs[name]) for name in ("k", "g", "energy"))
    return Ball(k, g), energy


def _same(ours: Any, given: Any, absolute: float = 0.0) -> np.ndarray:
    """Return where values are the same, numbers up to a relative or an absolute tolerance."""
    ours, given = np.asarray(ours), np.asarray(given)
    if ours.dtype.kind in "OU":
        return np.asarray(ours == given)
    return np.asarray(np.isclose(given, ours, rtol=TOLERANCE, atol=absolute, equal_nan=True))


def _differ(ours: Any, given: Any) -> bool:
    """Return whether any numbers of the order of 1 differ."""
    return not np.all(_same(ours, given, TOLERANCE))


def _recompute(stage: str, dataset: xr.Dataset) -> str | None:
    """Return what differs from the dataset that a stage makes of the same config, or None."""
    ours = recomputed(stage, *_ball(dataset), dataset.attrs["config"])
    surplus = dataset.attrs.keys() - ours.attrs.keys() - SAVED_ATTRIBUTES
    if surplus := surplus | set(dataset.variables) - set(ours.variables):
        return f"it has {', '.join(sorted(map(str, surplus)))}, which its stage does not make"
    for name, value in ours.attrs.items():
        if not np.all(_same(value, dataset.attrs[name])):
            return f"its {name} is {dataset.attrs[name]}, made again {value}"
    for name, variable in ours.variables.items():
        given = dataset.variables[name]
        if given.shape != variable.shape:
            return f"its {name} has another shape, made again"
        different = ~_same(variable.values, given.values)
        if different.any():
            i = tuple(np.argwhere(different)[0].tolist())
            return f"its {name}{list(i)} is {given.values[i]}, made again {variable.values[i]}"
    return None


@cache
def recomputed(stage: str, ball: Ball, energy: float, config: str) -> xr.Dataset:
    """Compute the dataset of a stage from a config, given as JSON."""
    if stage == "derivations":
        dataset: xr.Dataset = derivations(ball, energy)
        return dataset
    block, row = json.loads(config), STAGES[stage]
    if not isinstance(block, dict):
        raise ValueError("its config is no mapping")
    inputs = [recomputed(name, ball, energy, config) for name in row.inputs]
    fields = {name: block[name] for name in row.fields if name in block}
    function = getattr(import_module(row.module), row.function)
    method = block.get("method", {}) if row.follows else {}
    return compute_stage(function, ball, energy, inputs, fields, method)


def _orbits(dataset: xr.Dataset) -> str | None:
    ball, energy = _ball(dataset)
    x, v, w = states = states_of(dataset)
    if not np.all(np.abs(ball.energy(x, v, w) - energy) <= ENERGY_TOLERANCE):
        return "its states are not of its energy"
    after = np.stack(ball.impact(x.copy(), v.copy(), w.copy())[:3])
    followed = np.ones(x.size, bool)
    followed[np.cumsum(dataset["row_size"].values) - 1] = False
    if _differ(after[:, :-1][:, followed[:-1]], states[:, 1:][:, followed[:-1]]):
        return "its states do not follow one another under the map"
    return None


def _spread(dataset: xr.Dataset) -> str | None:
    ball, energy = _ball(dataset)
    x, y = section_points(ball, energy, dataset.sizes["orbit"])
    if _differ([x, y], [dataset["start_x"].values, dataset["start_y"].values]):
        return "its orbits do not start uniformly over the section"
    states = ball.state_xy(x[:SAMPLE_SIZE], y[:SAMPLE_SIZE], energy)
    impacts = int(dataset.attrs["block_impacts"])
    ours = lyapunov_spectrum(ball, states, impacts, 1)["exponent"].values[0]
    if _differ(ours, dataset["exponent"].values[0, :SAMPLE_SIZE]):
        return "its first block has other exponents"
    sea = in_sea(dataset)
    first, rest = ours[sea[:SAMPLE_SIZE], 0], dataset["exponent"].values[:, sea, 0]
    distance = np.abs(rest.mean() - first.mean()) if first.size else 0.0
    if distance * np.sqrt(first.size) > MEAN_TOLERANCE * rest.std():
        return "its exponents are not those of its first block"
    lengths = dataset["length"].values
    row = int(np.searchsorted(lengths, CHECKED_IMPACTS, side="right")) - 1
    states = ball.start(dataset["regular_start"].values, energy)
    ours = lyapunov_spectrum(ball, states, int(lengths[row]), 1)["exponent"].values[0]
    if _differ(ours, dataset["regular_exponent"].values[row]):
        return "its regular orbits have other exponents"
    return None


def _sweep(dataset: xr.Dataset) -> str | None:
    given = json.loads(dataset.attrs["config"])
    for low, high in (("low", "high"), ("strict", "lenient")):
        names = (f"regular_{low}", "regular", f"regular_{high}")
        shape = dataset["regular"].shape
        shares = [np.zeros(shape), *(dataset[name].values for name in names), np.ones(shape)]
        if not np.all(np.diff(shares, axis=0) >= -TOLERANCE):
            return f"a share is not between its {low} and its {high} one, or not between 0 and 1"
    k, energy = dataset["k"].values, dataset["energy"].values
    rows, columns = ({0, axis.size // 2, axis.size - 1} for axis in (k, energy))
    for i, j in product(rows, columns):
        ours = cell(float(k[i]), float(energy[j]), given["starts"], given["impacts"])
        for name, variable in dataset.data_vars.items():
            if not np.all(_same(ours[name], variable.values[i, j])):
                return f"its {name} at k = {k[i]:g}, E/g^2 = {energy[j]:g} is another"
    return None


# Stage -> the check of a sample; other stages are recomputed.
CHECKS = {"orbits": _orbits, "spread": _spread, "line": _sweep, "plane": _sweep}
