"""The dataset of a sweep: its cells, and the energies of the fixed point's resonances."""

import numpy as np
import xarray as xr

from pseudorigid.dynamics import fixed_point
from pseudorigid.dynamics.variables import Variables, described

from .cell import AXES, NORMAL_95, cells_of_a_sweep
from .grid import inertias

ORDERS = range(2, 11)
_STEPS = 1000  # of a curve over a plane


def dataset_of_a_sweep(
    *blocks: xr.Dataset, k: list[float], energy: list[float], **orbits: int
) -> xr.Dataset:
    """Join blocks, in the order of their cells, to the dataset of a sweep on (k, energy).

    `orbits` are starts and impacts, which decided the blocks. The resonances 1/q of the fixed point
    are added at the one k of a line, and else from edge to edge of the cells.
    """
    cells = cells_of_a_sweep(*blocks, k=k, energy=energy, **orbits)
    half_width = NORMAL_95 * cells["exponent_error"].values
    meaning = "half the width of the exponent's 95 % interval"
    table = {"exponent_95": (("k", "energy"), half_width, meaning)}
    return cells.assign(described(table) | resonances(k))


def resonances(k: list[float]) -> Variables:
    """Return variables of the energies at which the fixed point's rotation number is 1/order."""
    low, high = inertias(k)
    inertia = low + (high - low) * np.arange(_STEPS + 1) / _STEPS
    inertia = inertia[inertia > 0.0] if len(k) > 1 else np.array(k)
    energies = [[fixed_point.resonance(at, 1, q) for at in inertia.tolist()] for q in ORDERS]
    unit = AXES["energy"][1]
    return described(
        {
            "order": ("order", ORDERS, "order q of a resonance 1/q of the fixed point"),
            "resonance_k": ("resonance", inertia, *AXES["k"]),
            "resonance_energy": (
                ("order", "resonance"), energies, "energy over g^2 of a resonance", unit,
            ),
        }
    )  # fmt: skip
