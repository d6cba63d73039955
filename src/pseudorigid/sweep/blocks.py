"""Datasets of blocks of cells, and the dataset of a sweep, which does not depend on the blocks."""

from collections.abc import Iterable
from itertools import groupby

import numpy as np
import xarray as xr

from ..dynamics.variables import attributes_of
from .cell import PERIODS, VARIABLES, cells

AXES = {"k": ("Euler inertia", "m R^2"), "energy": ("energy over g^2", "m (gravity/omega)^2")}


def compute(block: dict) -> xr.Dataset:
    """Compute regular and chaotic motion in the cells of a block, as from `grid.block`."""
    rows = []
    for k, row in groupby(block["cells"], key=lambda pair: pair[0]):
        rows += cells(k, [e for _, e in row], block["starts"], block["impacts"])
    data = {
        name: (
            ("cell", "period") if name == "chains" else "cell",
            np.array([row[name] for row in rows], kind),
            attributes_of(text),
        )
        for name, (text, kind) in VARIABLES.items()
    }
    for axis, values in zip(AXES, np.array(block["cells"], float).T, strict=True):
        data[axis] = ("cell", values, attributes_of(*AXES[axis]))
    data["period"] = ("period", np.arange(1, PERIODS + 1), attributes_of("islands of a chain"))
    return xr.Dataset(data)


def join(sweep: dict, blocks: Iterable[xr.Dataset]) -> xr.Dataset:
    """Join blocks, in the order of their cells, to the dataset of a sweep on (k, energy)."""
    joined = xr.concat(
        list(blocks), "cell", data_vars="minimal", coords="minimal", compat="override"
    )
    shape = len(sweep["k"]), len(sweep["energy"])
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
        axis: (axis, np.array(sweep[axis]), attributes_of(*text)) for axis, text in AXES.items()
    }
    return xr.Dataset(data | {"period": joined.variables["period"]})
