"""What each kind of picture reports: quantity -> value as text, measured in its datasets.

A function has the name of a kind. It is called with the scene's block and, as keywords, with the
datasets of all stages of the kind, also those that it does not need. KIND_facts returns what the
kind's caption says of the data.
"""

from typing import Any

import numpy as np
import xarray as xr

from paper.figures.reports import listing


def spread(block: dict[str, Any], spread: xr.Dataset, lyapunov: xr.Dataset) -> dict[str, str]:
    """Give the largest exponent's mean over all chaotic orbits, and the spread of runs."""
    from ..analyses.stretches import long_run

    mean, error = long_run(spread)
    decades = spread.isel(run=slice(None, None, 3))
    template = "{:.5f} \N{PLUS-MINUS SIGN} {:.5f} of {:,} impacts"
    runs = listing(decades, template, "deviation", "deviation_error", "run")
    return {
        "long-run exponent": f"{mean:.5f} \N{PLUS-MINUS SIGN} {error:.5f} (95 %)",
        "standard deviations of runs": runs,
    }


def clusters(block: dict[str, Any], clusters: xr.Dataset) -> dict[str, str]:
    """Give the mean time from one cluster to the next, for each flight time that parts them."""
    return {"time between clusters": listing(clusters, "{:.2f} cut at {:g}", "period", "cut")}


def rotation(block: dict[str, Any], rotation: xr.Dataset) -> dict[str, str]:
    """Give the rotation number at the fixed point, at each energy."""
    numbers = listing(rotation, "{:.6f} at E = {:g}", "fixed_rotation", "energy")
    return {"at the fixed point": numbers}


def rotation_facts(block: dict[str, Any], rotation: xr.Dataset) -> dict[str, Any]:
    """Name the energies at which the rotation number rises and falls, by 5 % of its range each."""
    from .rotation import departures

    turning = []
    for energy, _, change in departures(rotation):
        curve = np.append(0.0, change)
        rise, fall = (np.max(c - np.minimum.accumulate(c)) for c in (curve, -curve))
        turning += [f"{energy:g}"] * bool(min(rise, fall) > 0.05 * np.ptp(curve))
    return {"turning": turning}


def jumps(block: dict[str, Any], jumps: xr.Dataset, orbits: xr.Dataset) -> dict[str, str]:
    """Give the length of the curve in (x, y) where the map jumps, at each energy."""
    return {"jump curve": "length " + listing(jumps, "{:.4f} at E = {:g}", "length", "energy")}


def flux(block: dict[str, Any], flux: xr.Dataset) -> dict[str, str]:
    """Give the areas of the lobes in (x, y), or why there are none."""
    with_area = flux.dropna("side", subset=["area"])
    missing = {
        f"no {side} lobes": flux.attrs[f"missing_{side}"]
        for side in flux["side"].values
        if f"missing_{side}" in flux.attrs
    }
    for side in with_area["side"].values[with_area["region"].isnull().values]:
        missing[f"no {side} region"] = "a jump of the map cuts the region's edge"
    return {"lobes": listing(with_area, "{} {:.10g}", "side", "area")} | missing


def last_curve(block: dict[str, Any], last_curve: xr.Dataset) -> dict[str, str]:
    """Give residue and period of the last convergent of each noble rotation number."""
    last = last_curve.isel(convergent=-1)
    return {"last residues": listing(last, "{:.2g} at period {:.0f}", "residue", "period")}


def last_curve_facts(block: dict[str, Any], last_curve: xr.Dataset) -> dict[str, Any]:
    """Name the numbers whose last residue is above the critical one, and the others."""
    from .last_curve import CRITICAL

    above = np.abs(last_curve["residue"].values[:, -1]) > CRITICAL
    names = np.array([f"{number:.6f}" for number in last_curve["rotation"].values])
    return {"above": names[above].tolist(), "below": names[~above].tolist()}


def exclusion(
    block: dict[str, Any], exclusion: xr.Dataset, curves: xr.Dataset, orbits: xr.Dataset
) -> dict[str, str]:
    """Give the share of the section that is excluded, and the share inside the proved curve."""
    last, inside = exclusion.isel(count=-1), curves["share"].values[curves["period"].values == 1]
    share, error = (float(last[name]) for name in ("share", "share_error"))
    return {
        "excluded share": f"{share:.4f} \N{PLUS-MINUS SIGN} {error:.4f}",
        "inside a proved curve": f"{inside.max():.4f}",
    }


def control(block: dict[str, Any], control: xr.Dataset) -> dict[str, str]:
    """Give the regular share of each changed map at the strength drawn, and of the impact map."""
    share = control["class_share"].sel({"class": "regular"}).isel(length=-1)
    rows = share.sel(strength=block["shown"], method="nearest").values.tolist()
    texts = [
        f"{name} {value:.3f}"
        for name, value in zip(control["map"].values.tolist(), rows, strict=True)
    ]
    unchanged = float(share.isel(map=0, strength=0))  # at strength 0 each map is the impact map
    return {"regular share": f"{', '.join(texts)}; impact map {unchanged:.3f}"}


def control_facts(block: dict[str, Any], control: xr.Dataset) -> dict[str, Any]:
    """Give the share of spirals at the largest strength by what a map keeps."""
    share = control["class_share"].sel({"class": "spiral"}).isel(length=-1, strength=-1).values
    kept = [name.partition(" ")[2] for name in control["map"].values.tolist()]
    of = {name: share[[own == name for own in kept]] for name in ("area", "reversor", "neither")}
    ends = {name: dict.fromkeys(f"{v:.2f}" for v in np.sort(of[name])[[0, -1]]) for name in of}
    return {"spirals": {name: " to ".join(texts) for name, texts in ends.items()}}
