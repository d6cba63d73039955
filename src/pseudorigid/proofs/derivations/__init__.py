"""The paper's formulas derived again by computer algebra: which hold, and which when corrected.

Each of FORMULAS is derived by the function of that name in `model`, `motion` or `forms`.
"""

import numpy as np
import xarray as xr

from ...dynamics.variables import attributes_of

# Module -> its functions that derive a formula each, in the order of the dataset.
FORMULAS = {
    "model": (
        "equations_of_motion",
        "euler_tensor",
        "shell",
        "uncoupled",
        "modes",
        "softness",
        "impulse",
        "impulse_without_stiffness",
        "jump_conditions",
        "impulsive_forces",
        "scaled_impulse",
        "scaling",
    ),
    "motion": (
        "flights",
        "flow",
        "impact_map",
        "conserved_energy",
        "bound",
        "bound_in_flight",
        "smooth",
        "contact_speed",
    ),
    "forms": (
        "jacobian",
        "exponents",
        "determinants",
        "one_form",
        "area",
        "reversible",
    ),
}


def derivations(ball, energy):
    """Every formula of the paper that can be derived, and whether it holds.

    Parameters
    ----------
    ball : Ball
        Not used: the formulas hold for every ball, or for none.
    energy : float
        Not used either.

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
    said = {
        "printed": "whether the formula holds as printed; -1 where the paper prints none",
        "corrected": "whether it holds corrected; -1 where it needs no correction",
        "value": "a number that comes with the formula",
    }
    data = {}
    for name, what in said.items():
        numbers = [_number(getattr(row, name)) for row in table.values()]
        data[name] = ("formula", numbers, attributes_of(what))
    names = np.array(list(table), dtype=object)
    label = ("formula", names, {"long_name": "function of this package that derives it"})
    return xr.Dataset(data, coords={"formula": label})


def _number(found):
    """A number, or 1, 0 and -1 for true, false and None."""
    return found if isinstance(found, float) else -1 if found is None else int(found)
