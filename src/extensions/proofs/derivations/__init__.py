"""Derivations of the paper's formulas by computer algebra.

Each formula in FORMULAS is derived by the function of that name in `model`, `impacts` or `forms`.
"""

import xarray as xr

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.variables import of_rows

# Module -> its functions that derive a formula each, in the order of the dataset.
FORMULAS = {
    "model": (
        "equations_of_motion", "momentum_balances", "euler_tensor", "shell", "uncoupled", "modes",
        "softness", "impulse", "impulse_without_stiffness", "jump_conditions", "impulsive_forces",
        "scaled_impulse", "scaling",
    ),
    "impacts": (
        "flights", "flow", "impact_map", "conserved_energy", "energy_bound", "bound_in_flight",
        "smooth", "contact_speed",
    ),
    "forms": ("jacobian", "exponents", "determinants", "one_form", "area", "reversible"),
}  # fmt: skip

_TABLE = {
    "printed": ("formula", "whether the formula holds as printed; -1 where the paper prints none"),
    "corrected": ("formula", "whether it holds corrected; -1 where it needs no correction"),
    "value": ("formula", "a number that comes with the formula"),
    "formula": ("formula", "function of this package that derives it"),
}


def derivations(ball: Ball, energy: float) -> xr.Dataset:
    """Derive every formula of the paper that can be derived, and say whether it holds.

    The ball and the energy are not used: the formulas hold for every ball, or for none. The dataset
    is on formula, the name of the function that derives it: printed and corrected, 1 where it holds
    so, 0 where it does not, -1 where there is none; value, a number that comes with it, or NaN.
    """
    from . import forms, impacts, model

    modules = {"model": model, "impacts": impacts, "forms": forms}
    rows = []
    for module, names in FORMULAS.items():
        for name in names:
            printed, corrected, value = getattr(modules[module], name)()
            holds = (-1 if flag is None else int(flag) for flag in (printed, corrected))
            rows.append((*holds, value, name))
    return xr.Dataset(of_rows(_TABLE, rows))
