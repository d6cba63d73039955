"""What each kind of picture reports: quantity -> value as text, measured in its datasets.

A function has the name of a kind and takes the scene's block and the datasets by their stages.
KIND_facts returns what the kind's caption says of the data.
"""

import math
from typing import Any

import xarray as xr

from paper.figures.reports import about_orbit, counts


def horseshoe(
    block: dict[str, Any], periodic: xr.Dataset, manifolds: xr.Dataset, horseshoe: xr.Dataset
) -> dict[str, str]:
    """Describe the orbit, and count the sets."""
    return about_orbit(periodic, block) | {"sets": f"{horseshoe.sizes['set']}"}


def twist(block: dict[str, Any], twist: xr.Dataset) -> dict[str, str]:
    """Give the energy at which the twist vanishes."""
    zero = float(twist["zero"])
    return {"zero of the twist": "none between them" if math.isnan(zero) else f"{zero:.12f}"}


def twist_facts(block: dict[str, Any], twist: xr.Dataset) -> dict[str, Any]:
    """Say whether there is a zero."""
    return {"zero": not math.isnan(float(twist["zero"]))}


def escape(block: dict[str, Any], escape: xr.Dataset) -> dict[str, str]:
    """Give the largest distance at each energy."""
    rows = zip(block["beside"], escape["distance"].values[:, -1], strict=True)
    return {"largest distance": ", ".join(f"{far:.4f} at +{more:g}" for more, far in rows)}


def curves(block: dict[str, Any], curves: xr.Dataset, orbits: xr.Dataset) -> dict[str, str]:
    """Give the share of the section inside the largest curve and those around long orbits."""
    share, period = curves["share"].values, curves["period"].values
    total = float(share[period == 1].max() + (share * period)[period > 1].sum())
    return {"proved share": f"{total:.4f} of the section"}


def graph(block: dict[str, Any], graph: xr.Dataset, orbits: xr.Dataset) -> dict[str, str]:
    """Count the sets and the connections, and give the entropy's proved lower bound."""
    inner = int((graph["connection"].values < 0).sum())
    return {
        "sets": f"{inner} and {graph.sizes['set'] - inner} on the way",
        "connections": f"{graph.sizes['connection']}",
        "entropy": f"above {float(graph['entropy']):.4f} per impact",
    }


def graph_facts(block: dict[str, Any], orbits: xr.Dataset, **_: xr.Dataset) -> dict[str, Any]:
    """Count the orbits of each type."""
    return counts(orbits["type"].values.tolist())


curves_facts = graph_facts
