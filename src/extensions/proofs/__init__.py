"""Proofs in ball arithmetic: theorems with certificates, and correctly rounded orbits.

`search` proposes certificates, and `checkers` decides about them without the searches. Both enclose
the impact map by `enclosure`. `theorems` has the statements, `true_orbits` the orbits of
exact starts, and `proved_impacts` proves the impacts behind the figures.
"""

import importlib
from typing import Any

_MODULES = {
    "Surface": "extensions.proofs.enclosure.surface",
    "THEOREMS": "extensions.proofs.theorems.statements",
    "search_certificate": "extensions.proofs.theorems.searches",
    "prove_orbit": "extensions.proofs.theorems.requests",
    "prove_curve": "extensions.proofs.theorems.requests",
    "prove_horseshoe": "extensions.proofs.theorems.requests",
    "true_orbit": "extensions.proofs.true_orbits.orbit",
}

__all__ = list(_MODULES)


def __getattr__(name: str) -> Any:
    if name in _MODULES:
        return getattr(importlib.import_module(_MODULES[name]), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])
