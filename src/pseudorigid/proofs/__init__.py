"""Proofs in ball arithmetic: theorems with certificates, and orbits that are true.

`enclosure` has the map over balls and jets; `search` proposes certificates, `checks` decides about
them, and the two share nothing but the map; `theorems` has the statements; `true_orbits` follows
orbits of exact starts; `judge` is asked about impacts of doubles.
"""

import importlib

_HOMES = {
    "Surface": "enclosure.surface",
    "THEOREMS": "theorems.statements",
    "search_certificate": "theorems.statements",
    "prove_orbit": "theorems.requests",
    "prove_horseshoe": "theorems.requests",
    "true_orbit": "true_orbits.orbit",
    "true_scene_orbits": "true_orbits.scene",
}

__all__ = list(_HOMES)


def __getattr__(name):
    if name in _HOMES:
        return getattr(importlib.import_module(f".{_HOMES[name]}", __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__():
    return sorted([*globals(), *__all__])
