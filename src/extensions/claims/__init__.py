"""Verdicts on every checkable statement of the paper, with the analyses behind them."""

import importlib
from typing import Any

__all__ = ["turnstile_flux"]


def __getattr__(name: str) -> Any:
    if name in __all__:
        return getattr(importlib.import_module(".analyses.turnstile", __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
