"""Quantities of datasets as text, for what pictures report."""

from typing import Any

import xarray as xr


def about_orbit(periodic: xr.Dataset, block: dict[str, Any]) -> dict[str, str]:
    """Return the orbit's type and period, its energy, and its rotation number or multiplier."""
    from pseudorigid.dynamics.variables import of_type

    orbit = of_type(periodic, block["type"])
    last = "rotation_number" if block["type"] == "elliptic" else "multiplier"
    return {
        "orbit": f"{orbit['type'].item()}, period {orbit.sizes['point']}",
        **energy_of(block, orbit),
        last.replace("_", " "): f"{float(orbit[last]):.6f}",
    }


def energy_of(block: dict[str, Any], states: xr.Dataset) -> dict[str, str]:
    """Return the energy of a dataset's states, eq. (29), to twelve digits."""
    import numpy as np

    from pseudorigid.dynamics.ball import Ball
    from pseudorigid.dynamics.variables import states_of

    energy = np.asarray(Ball(**block["ball"]).energy(*states_of(states)))
    ends = dict.fromkeys(f"{value:.12g}" for value in (energy.min(), energy.max()))
    return {"energy": " to ".join(ends)}


def listing(data: xr.Dataset, template: str, *names: str) -> str:
    """Format the values of some variables of a dataset side by side, with commas between rows."""
    rows = zip(*(data[name].values for name in names), strict=True)
    return ", ".join(template.format(*row) for row in rows)
