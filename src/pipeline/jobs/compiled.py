"""Modules with compiled functions, imported by the server only if a run computes a dataset."""

from contextlib import suppress
from importlib import import_module

with suppress(Exception):
    import_module("pseudorigid.dynamics.ensemble")
    # The first call of any compiled function initialises numba.
    import_module("numba").njit(lambda: 0)()
