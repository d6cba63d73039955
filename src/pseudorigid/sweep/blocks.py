"""Blocks of cells, and the dataset that they are joined into: the same whatever the blocks."""

from itertools import groupby

import numpy as np
import xarray as xr

from ..dynamics.variables import attributes_of
from .cell import PERIODS, VARIABLES, cells

AXES = {"k": ("Euler inertia", "m R^2"), "energy": ("energy over g^2", "m (gravity/omega)^2")}


def compute(block):
    """Regular and chaotic motion in some cells of a grid over k and E/g^2.

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
            attributes_of(text),
        )
        for name, (text, kind) in VARIABLES.items()
    }
    for i, (name, text) in enumerate(AXES.items()):
        data[name] = (
            "cell",
            np.array([one[i] for one in block["cells"]], float),
            attributes_of(*text),
        )
    data["period"] = ("period", np.arange(1, PERIODS + 1), attributes_of("islands of a chain"))
    return xr.Dataset(data)


def join(sweep, blocks):
    """Regular and chaotic motion over a grid of k and E/g^2, joined from its blocks.

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
    data |= {
        axis: (axis, np.array(sweep[axis]), attributes_of(*text)) for axis, text in AXES.items()
    }
    return xr.Dataset(data | {"period": joined.variables["period"]})
