"""What each kind of picture reports: quantity -> value as text, measured in its datasets.

A function has the name of a kind and takes the scene's block and the datasets by their stages.
"""

from collections import Counter
from typing import Any

import xarray as xr


def families(block: dict[str, Any], families: xr.Dataset, shares: xr.Dataset) -> dict[str, str]:
    """Give the number of families and events, and the fixed point's resonances."""
    lines = families["line"].values.tolist()
    kinds = Counter(families["event_kind"].values.tolist())
    events = [f"{n} {'p/q' if k == 'resonance' else k}" for k, n in sorted(kinds.items())]
    chosen = (families["event_family"].values == 0) & (families["event_order"].values > 2)
    names = f"event_{block['parameter']}", "event_turns", "event_order"
    resonances = zip(*(families[name].values[chosen].tolist() for name in names), strict=True)
    places = [f"{p}/{q} at {value:.12g}" for value, p, q in sorted(resonances)]
    return {
        "families": f"{len(lines)}, {lines.count('none')} of them without symmetry",
        "events": ", ".join(events) or "none",
        "fixed point": ", ".join(places) or "none",
    }
