"""Datasets of blocks of cells, and the dataset of a sweep, which does not depend on the blocks."""

from itertools import groupby
from typing import Any

import numpy as np
import xarray as xr

from pseudorigid.dynamics.variables import described

from .cell import PERIODS, VARIABLES, cells_of_k

AXES = {"k": ("Euler inertia", "m R^2"), "energy": ("energy over g^2", "m (gravity/omega)^2")}


def block_of_cells_of_a_sweep(
    cells: list[tuple[float, float]], starts: int, impacts: int
) -> xr.Dataset:
    """Compute regular and chaotic motion in cells [k, E/g^2], as from `grid.parts`."""
    rows: list[dict[str, Any]] = []
    for k, row in groupby(cells, key=lambda pair: pair[0]):
        rows += cells_of_k(k, [e for _, e in row], starts, impacts)
    table: dict[str, tuple[Any, ...]] = {}
    for name, (text, kind) in VARIABLES.items():
        dims = ("cell", "period") if name == "chains" else "cell"
        table[name] = dims, np.array([row[name] for row in rows], kind), text
    for axis, values in zip(AXES, np.array(cells, float).T, strict=True):
        table[axis] = "cell", values, *AXES[axis]
    table["period"] = "period", np.arange(1, PERIODS + 1), "islands of a chain"
    return xr.Dataset(described(table))


def cells_of_a_sweep(
    *blocks: xr.Dataset, k: list[float], energy: list[float], **orbits: int
) -> xr.Dataset:
    """Join blocks, in the order of their cells, to the dataset of a sweep on (k, energy).

    `orbits` are starts and impacts, which decided the blocks.
    """
    joined = xr.concat(blocks, "cell", data_vars="minimal", coords="minimal", compat="override")
    table: dict[str, tuple[Any, ...]] = {}
    for name, (text, _) in VARIABLES.items():
        variable = joined.variables[name]
        values = variable.values.reshape(len(k), len(energy), *variable.shape[1:])
        table[name] = ("k", "energy", *variable.dims[1:]), values, text
    table |= {"k": ("k", k, *AXES["k"]), "energy": ("energy", energy, *AXES["energy"])}
    return xr.Dataset(described(table) | {"period": joined.variables["period"]})
