"""Whether a dataset that is handed in is one of the map it names: made again, or a sample of it.

A verdict on numbers that no orbit has would say nothing about the paper. What takes seconds is made
again, by its stage from the config that it has, and compared number by number; of the rest a sample
is: of orbits, of the spread of exponents, of the cells of a sweep.
"""

import json
from functools import cache
from importlib import import_module
from itertools import product

import numpy as np

from pseudorigid.analyses.sea import section_points
from pseudorigid.analyses.spread import in_sea
from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.ensemble import ImpactMap
from pseudorigid.dynamics.lyapunov import lyapunov_spectrum
from pseudorigid.dynamics.variables import states_of
from pseudorigid.proofs.derivations import derivations
from pseudorigid.sweep.cell import cell

from ...config.schema.stages import STAGES
from ...records.artifacts import ABOUT

RELATIVE_TOLERANCE = 1e-9  # of numbers that one map gives twice
SAMPLE_SIZE = 8  # entries of a sample
# What a file has besides what its stage returns.
SAVED_ATTRIBUTES = {"k", "g", "energy", "stage", "config", "title", *ABOUT}
CHECKED_IMPACTS = 4096  # impacts of an orbit that is followed again


def dataset_error(stage, dataset):
    """What is wrong with a dataset of a stage, in words, or None.

    Parameters
    ----------
    stage : str
        Its name, as in "orbits"; "line" and "plane" are sweeps.
    dataset : Dataset

    Returns
    -------
    str or None
    """
    try:
        return CHECKS[stage](dataset) if stage in CHECKS else _again(stage, dataset)
    except (ArithmeticError, LookupError, MemoryError, TypeError, ValueError) as error:
        return f"it cannot be read as one ({error})"


def _ball(dataset):
    k, g, energy = (float(dataset.attrs[name]) for name in ("k", "g", "energy"))
    return Ball(k, g), energy


def _off(found, given, near=RELATIVE_TOLERANCE):
    """Whether numbers differ by more than `near`, of the larger of them or of 1."""
    found, given = np.broadcast_arrays(*(np.asarray(a, dtype=float) for a in (found, given)))
    same = np.abs(found - given) <= near * np.maximum(1.0, np.abs(given))
    return not np.all(same | (np.isnan(found) & np.isnan(given)))


def _again(stage, dataset):
    """What differs from the dataset that its stage makes of its config, in words, or None."""
    found = _made(stage, *_ball(dataset), dataset.attrs["config"])
    more = dataset.attrs.keys() - found.attrs.keys() - SAVED_ATTRIBUTES
    if more := more | set(dataset.variables) - set(found.variables):
        return f"it has {', '.join(sorted(map(str, more)))}, which its stage does not make"
    for name, value in found.attrs.items():
        if not np.all(_same(value, dataset.attrs[name])):
            return f"its {name} is {dataset.attrs[name]}, made again {value}"
    for name, ours in found.variables.items():
        given = dataset.variables[name]
        if given.shape != ours.shape:
            return f"its {name} has another shape, made again"
        other = ~_same(ours.values, given.values)
        if other.any():
            at = tuple(np.argwhere(other)[0].tolist())
            return f"its {name}{list(at)} is {given.values[at]}, made again {ours.values[at]}"
    return None


@cache
def _made(stage, ball, energy, config):
    """The dataset of a stage and a config, given as text."""
    if stage == "derivations":
        return derivations(ball, energy)
    block, row = json.loads(config), STAGES[stage]
    if not isinstance(block, dict):
        raise ValueError("its config is no mapping")
    method = block.get("method", {}) if row.follows else {}
    root_finder = ImpactMap((method["scan"], method["tolerance"]) if "scan" in method else None)
    inputs = [_made(name, ball, energy, config) for name in row.inputs]
    fields = {name: block[name] for name in row.fields if name in block}
    make = getattr(import_module(row.module), row.function)
    found = make(Ball(ball.k, ball.g, map=root_finder), energy, *inputs, **fields)
    if "scan" in method:
        found.attrs |= {"impacts": root_finder.impacts, "impacts_missed": root_finder.missed}
    return found


def _same(ours, given):
    """Where values are the same, numbers to rounding."""
    ours, given = np.asarray(ours), np.asarray(given)
    if ours.dtype.kind in "OU":
        return ours == given
    return np.isclose(given, ours, rtol=RELATIVE_TOLERANCE, atol=0.0, equal_nan=True)


def _orbits(dataset):
    ball, energy = _ball(dataset)
    states = states_of(dataset)
    if _off(ball.energy(*states), energy, 1e-11):
        return "its states are not of its energy"
    after = ball.impact(*(a.copy() for a in states))
    inner = np.ones(states[0].size, bool)
    inner[np.cumsum(dataset["row_size"].values) - 1] = False
    pairs = ((after[i][:-1][inner[:-1]], states[i][1:][inner[:-1]]) for i in range(3))
    if any(_off(found, given) for found, given in pairs):
        return "its states do not follow one another under the map"
    return None


def _spread(dataset):
    ball, energy = _ball(dataset)
    points = section_points(ball, energy, dataset.sizes["orbit"])
    if _off(points, [dataset["start_x"].values, dataset["start_y"].values]):
        return "its orbits do not start uniformly over the section"
    impacts = int(dataset.attrs["block_impacts"])
    states = ball.state_xy(*(a[:SAMPLE_SIZE] for a in points), energy)
    found = lyapunov_spectrum(ball, states, impacts, 1)["exponent"].values[0]
    if _off(found, dataset["exponent"].values[0, :SAMPLE_SIZE]):
        return "its first block has other exponents"
    sea = in_sea(dataset)
    first, rest = found[sea[:SAMPLE_SIZE], 0], dataset["exponent"].values[:, sea, 0]
    if first.size and np.abs(rest.mean() - first.mean()) > 6.0 * rest.std() / np.sqrt(first.size):
        return "its exponents are not those of its first block"
    lengths = dataset["length"].values
    row = int(np.searchsorted(lengths, CHECKED_IMPACTS, side="right")) - 1
    states = ball.start(dataset["regular_start"].values, energy)
    found = lyapunov_spectrum(ball, states, int(lengths[row]), 1)["exponent"].values[0]
    if _off(found, dataset["regular_exponent"].values[row]):
        return "its regular orbits have other exponents"
    return None


def _sweep(dataset):
    given = json.loads(dataset.attrs["config"])
    for low, high in (("low", "high"), ("strict", "lenient")):
        names = (f"regular_{low}", "regular", f"regular_{high}")
        a, b, c = (dataset[name].values for name in names)
        if not np.all(
            (a >= -RELATIVE_TOLERANCE)
            & (b >= a - RELATIVE_TOLERANCE)
            & (c >= b - RELATIVE_TOLERANCE)
            & (c <= 1.0 + RELATIVE_TOLERANCE)
        ):
            return f"a share is not between its {low} and its {high} one, or not between 0 and 1"
    k, energy = dataset["k"].values, dataset["energy"].values
    rows, columns = ({0, axis.size // 2, axis.size - 1} for axis in (k, energy))
    for i, j in product(rows, columns):
        found = cell(float(k[i]), float(energy[j]), given["starts"], given["impacts"])
        for name, variable in dataset.data_vars.items():
            if not np.all(_same(found[name], variable.values[i, j])):
                return f"its {name} at k = {k[i]:g}, E/g^2 = {energy[j]:g} is another"
    return None


# Stage -> its check; what has none here is made again.
CHECKS = {"orbits": _orbits, "spread": _spread, "line": _sweep, "plane": _sweep}
