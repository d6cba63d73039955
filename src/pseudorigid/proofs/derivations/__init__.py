"""Derivations of the paper's formulas by computer algebra.

Each formula in FORMULAS is derived by the function of that name in `model`, `motion` or `forms`.
"""

import numpy as np
import xarray as xr

from ...dynamics.variables import attributes_of

# Module -> its functions that derive a formula each, in the order of the dataset.
FORMULAS = {
    "model": (
        "equations_of_motion", "euler_tensor", "shell", "uncoupled", "modes", "softness", "impulse",
        "impulse_without_stiffness", "jump_conditions", "impulsive_forces", "scaled_impulse",
        "scaling",
    ),
    "motion": (
        "flights", "flow", "impact_map", "conserved_energy", "bound", "bound_in_flight", "smooth",
        "contact_speed",
    ),
    "forms": ("jacobian", "exponents", "determinants", "one_form", "area", "reversible"),
}  # fmt: skip


def derivations(ball, energy: float) -> xr.Dataset:
    """Derive every formula of the paper that can be derived, and say whether it holds.

    Parameters
    ----------
    ball : Ball
        Not used: the formulas hold for every ball, or for none.
    energy : float
        Not used.

    Returns
    -------
    xarray.Dataset
        On formula, the name of the function that derives it: printed and corrected, 1 where it
        holds so, 0 where it does not, -1 where there is none; value, a number that comes with it,
        or NaN.
    """
    from . import forms, model, motion

    modules = {"model": model, "motion": motion, "forms": forms}
    table = {
        name: getattr(modules[module], name)()
        for module, names in FORMULAS.items()
        for name in names
    }
    meanings = {
        "printed": "whether the formula holds as printed; -1 where the paper prints none",
        "corrected": "whether it holds corrected; -1 where it needs no correction",
        "value": "a number that comes with the formula",
    }
    data = {}
    for name, meaning in meanings.items():
        numbers = [_number(getattr(row, name)) for row in table.values()]
        data[name] = ("formula", numbers, attributes_of(meaning))
    names = np.array(list(table), dtype=object)
    label = ("formula", names, {"long_name": "function of this package that derives it"})
    return xr.Dataset(data, coords={"formula": label})


def _number(result: float | bool | None) -> float | int:
    """Convert True, False and None to 1, 0 and -1; leave a number as it is."""
    if isinstance(result, float):
        return result
    return -1 if result is None else int(result)
