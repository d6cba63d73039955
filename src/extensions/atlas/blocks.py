"""Datasets of blocks of cells, and the dataset of a sweep, which does not depend on the blocks."""

from itertools import groupby

import numpy as np
import xarray as xr

from pseudorigid.dynamics.variables import attributes_of

from .cell import PERIODS, VARIABLES
from .cell import cells as cells_of_k

AXES = {"k": ("Euler inertia", "m R^2"), "energy": ("energy over g^2", "m (gravity/omega)^2")}


def block_of_cells_of_a_sweep(cells: list, starts: int, impacts: int) -> xr.Dataset:
    """Compute regular and chaotic motion in cells [k, E/g^2], as from `grid.parts`."""
    rows = []
    for k, row in groupby(cells, key=lambda pair: pair[0]):
        rows += cells_of_k(k, [e for _, e in row], starts, impacts)
    data = {
        name: (
            ("cell", "period") if name == "chains" else "cell",
            np.array([row[name] for row in rows], kind),
            attributes_of(text),
        )
        for name, (text, kind) in VARIABLES.items()
    }
    for axis, values in zip(AXES, np.array(cells, float).T, strict=True):
        data[axis] = ("cell", values, attributes_of(*AXES[axis]))
    data["period"] = ("period", np.arange(1, PERIODS + 1), attributes_of("islands of a chain"))
    return xr.Dataset(data)


def cells_of_a_sweep(
    *blocks: xr.Dataset, k: list[float], energy: list[float], **orbits: int
) -> xr.Dataset:
    """Join blocks, in the order of their cells, to the dataset of a sweep on (k, energy).

    `orbits` are starts and impacts, which decided the blocks.
    """
    joined = xr.concat(blocks, "cell", data_vars="minimal", coords="minimal", compat="override")
    values = {"k": k, "energy": energy}
    shape = len(k), len(energy)
    data = {
        name: (
            ("k", "energy", *variable.dims[1:]),
            variable.values.reshape(*shape, *variable.shape[1:]),
            variable.attrs,
        )
        for name, variable in joined.variables.items()
        if name in VARIABLES
    }
    data |= {
        axis: (axis, np.array(values[axis]), attributes_of(*text)) for axis, text in AXES.items()
    }
    return xr.Dataset(data | {"period": joined.variables["period"]})
