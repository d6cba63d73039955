"""What the picture reports: quantity -> value as text, measured in its datasets."""

from typing import Any

import xarray as xr

from paper.figures.reports import about_orbit


def model(block: dict[str, Any], periodic: xr.Dataset, motion: xr.Dataset) -> dict[str, str]:
    """Describe the orbit, and give position and strain of both states."""
    quantities = about_orbit(periodic, block)
    for name, i in (("between impacts", -1), ("impact", 0)):
        x, u = (float(motion[which][i]) for which in ("position", "strain"))
        quantities[name] = f"x = {x:.4f}, u = {u:.4f}"
    return quantities
