"""What the pictures report: quantity -> value as text, measured in its datasets."""

from typing import Any

import xarray as xr

from paper.figures.reports import about_orbit, counts


def model(block: dict[str, Any], periodic: xr.Dataset, motion: xr.Dataset) -> dict[str, str]:
    """Describe the orbit, and give position and strain of both states."""
    quantities = about_orbit(periodic, block)
    for name, i in (("between impacts", -1), ("impact", 0)):
        x, u = (float(motion[which][i]) for which in ("position", "strain"))
        quantities[name] = f"x = {x:.4f}, u = {u:.4f}"
    return quantities


def animation(block: dict[str, Any], orbits: xr.Dataset, frames: xr.Dataset) -> dict[str, str]:
    """Count frames and impacts, and give the highest position of the ball."""
    return {
        "frames": f"{frames.sizes['frame']}",
        "impacts": f"{orbits.sizes['point']:,}",
        "highest position": f"x = {float(frames['position'].min()):.4f}",
    }


def animation_facts(block: dict[str, Any], orbits: xr.Dataset, **_: xr.Dataset) -> dict[str, Any]:
    """Count the orbits of each type."""
    return counts(orbits["type"].values.tolist())
