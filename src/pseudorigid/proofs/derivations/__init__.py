"""The paper's formulas derived again by computer algebra: which hold, and which when corrected."""

import numpy as np
import xarray as xr


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

    table = {
        name: function()
        for module, names in (
            (model, MODEL),
            (motion, MOTION),
            (forms, FORMS),
        )
        for name, function in ((name, getattr(module, name)) for name in names)
    }
    said = {
        "printed": "whether the formula holds as printed; -1 where the paper prints none",
        "corrected": "whether it holds corrected; -1 where it needs no correction",
    }
    data = {
        name: ("formula", [_number(getattr(row, name)) for row in table.values()], _about(what))
        for name, what in said.items()
    }
    values = [row.value for row in table.values()]
    data["value"] = ("formula", values, _about("a number that comes with the formula"))
    names = np.array(list(table), dtype=object)
    label = ("formula", names, {"long_name": "function of this package that derives it"})
    return xr.Dataset(data, coords={"formula": label})


MODEL = (
    "equations_of_motion",
    "euler_tensor",
    "shell",
    "uncoupled",
    "softness",
    "impulse",
    "impulse_without_stiffness",
    "jump_conditions",
    "impulsive_forces",
    "scaled_impulse",
    "scaling",
)
MOTION = (
    "flights",
    "impact_map",
    "conserved_energy",
    "bound",
    "bound_in_flight",
    "smooth",
    "contact_speed",
)
FORMS = (
    "jacobian",
    "exponents",
    "determinants",
    "one_form",
    "area",
    "reversible",
)


def _number(truth):
    return -1 if truth is None else int(truth)


def _about(what):
    return {"long_name": what, "units": "1"}
