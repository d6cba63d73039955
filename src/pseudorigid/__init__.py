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
    if name == "__version__":
        return _version()
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__():
    return sorted([*globals(), *__all__, "__version__"])


def _version():
    """Return the version in pyproject.toml, or that of the installed package."""
    import tomllib
    from importlib import metadata
    from pathlib import Path

    root = Path(__file__).parents[2]
    if (root / "src" / __name__).is_dir():
        return tomllib.loads((root / "pyproject.toml").read_text())["project"]["version"]
    return metadata.version(__name__)
