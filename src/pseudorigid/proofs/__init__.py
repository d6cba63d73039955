"""Theorems with certificates, and true orbits, both proved in ball arithmetic.

`search` proposes certificates and `checks` decides about them; they share only the map over balls
and jets in `enclosure`. `theorems` has the statements, and `true_orbits` follows orbits of exact
starts. `reference_solver` proves the time to the next impact of states in double precision.
"""

import importlib
from typing import Any

_MODULES = {
    "Surface": "enclosure.surface",
    "THEOREMS": "theorems.statements",
    "search_certificate": "theorems.statements",
    "prove_orbit": "theorems.requests",
    "prove_horseshoe": "theorems.requests",
    "true_orbit": "true_orbits.orbit",
    "true_scene_orbits": "true_orbits.scene",
}

__all__ = list(_MODULES)


def __getattr__(name: str) -> Any:
    if name in _MODULES:
        return getattr(importlib.import_module(f".{_MODULES[name]}", __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])
