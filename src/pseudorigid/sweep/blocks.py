"""Blocks of cells, and the dataset that they are joined into: the same whatever the blocks."""

import numpy as np
import xarray as xr

from .cell import PERIODS, VARIABLES, cell

AXES = {"k": "Euler inertia", "energy": "energy over g^2"}


def compute(block):
    """The cells of a block, as from `grid.block`: a Dataset on the dim `cell`."""
    found = [cell(k, e, block["starts"], block["impacts"]) for k, e in block["cells"]]
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
    """The Dataset of a sweep, dims (k, energy), from its blocks in the order of their cells."""
    cells = xr.concat(
        list(blocks), "cell", data_vars="minimal", coords="minimal", compat="override"
    )
    shape = len(sweep["k"]), len(sweep["energy"])
    data = {
        name: (
            ("k", "energy", *variable.dims[1:]),
            variable.values.reshape(*shape, *variable.shape[1:]),
            variable.attrs,
        )
        for name, variable in cells.variables.items()
        if name in VARIABLES
    }
    data |= {axis: (axis, np.array(sweep[axis]), _about(text)) for axis, text in AXES.items()}
    return xr.Dataset(data | {"period": cells.variables["period"]})


def _about(text):
    return {"long_name": text, "units": "1"}
