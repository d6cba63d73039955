"""Dynamics of a pseudo-rigid ball bouncing on a rigid foundation (Kanso & Papadopoulos).

The names below are loaded when they are first used, so that a program pays for what it uses.
"""

import importlib

_HOMES = {
    "Ball": "dynamics.ball",
    "orbit": "dynamics.orbits",
    "symmetric_orbits": "dynamics.periodic",
    "trace_manifold": "dynamics.manifolds",
    "lyapunov_spectrum": "dynamics.lyapunov",
}

__all__ = list(_HOMES)


def __getattr__(name):
    if name in _HOMES:
        return getattr(importlib.import_module(f".{_HOMES[name]}", __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__():
    return sorted([*globals(), *__all__])
