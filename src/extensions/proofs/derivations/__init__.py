"""Derivations of the paper's formulas by computer algebra.

Each formula in FORMULAS is derived by the function of that name in `model`, `motion` or `forms`.
"""

import xarray as xr

from pseudorigid.dynamics.variables import described

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

    The ball and the energy are not used: the formulas hold for every ball, or for none. The dataset
    is on formula, the name of the function that derives it: printed and corrected, 1 where it holds
    so, 0 where it does not, -1 where there is none; value, a number that comes with it, or NaN.
    """
    from . import forms, model, motion

    modules = {"model": model, "motion": motion, "forms": forms}
    names = [(module, name) for module, functions in FORMULAS.items() for name in functions]
    results = [getattr(modules[module], name)() for module, name in names]
    printed, corrected = (
        [-1 if holds is None else int(holds) for holds in column]
        for column in zip(*(result[:2] for result in results), strict=True)
    )
    printed_meaning = "whether the formula holds as printed; -1 where the paper prints none"
    corrected_meaning = "whether it holds corrected; -1 where it needs no correction"
    values = [result.value for result in results]
    data = {
        "printed": ("formula", printed, printed_meaning),
        "corrected": ("formula", corrected, corrected_meaning),
        "value": ("formula", values, "a number that comes with the formula"),
        "formula": (
            "formula",
            [name for _, name in names],
            "function of this package that derives it",
        ),
    }
    return xr.Dataset(described(data))
