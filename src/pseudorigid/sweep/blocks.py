"""Blocks of cells, and the dataset that they are joined into: the same whatever the blocks."""

from itertools import groupby

import numpy as np
import xarray as xr

from .cell import PERIODS, VARIABLES, cells

AXES = {"k": "Euler inertia", "energy": "energy over g^2"}


def compute(block):
    """The cells of a block.

    Parameters
    ----------
    block : dict
        As from `grid.block`.

    Returns
    -------
    xarray.Dataset
        On `cell` the variables of `cell.VARIABLES`, k and energy, E/g^2; chains on (cell, period).
    """
    found = []
    for k, row in groupby(block["cells"], key=lambda pair: pair[0]):
        found += cells(k, [e for _, e in row], block["starts"], block["impacts"])
    data = {
        name: (
            ("cell", "period") if name == "chains" else "cell",
            np.array([one[name] for one in found], kind),
            _about(text),
        )
        for name, (text, kind) in VARIABLES.items()
    }
    for i, (name, text) in enumerate(AXES.items()):
        data[name] = ("cell", np.array([one[i] for one in block["cells"]], float), _about(text))
    data["period"] = ("period", np.arange(1, PERIODS + 1), _about("islands of a chain"))
    return xr.Dataset(data)


def join(sweep, blocks):
    """A sweep from its blocks.

    Parameters
    ----------
    sweep : dict
        Of the config: k and energy are lists of numbers.
    blocks : iterable of xarray.Dataset
        As from `compute`, in the order of their cells.

    Returns
    -------
    xarray.Dataset
        On (k, energy), the same whatever the blocks.
    """
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
    data |= {axis: (axis, np.array(sweep[axis]), _about(text)) for axis, text in AXES.items()}
    return xr.Dataset(data | {"period": joined.variables["period"]})


def _about(text):
    return {"long_name": text, "units": "1"}
