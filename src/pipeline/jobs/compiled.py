"""What the server imports besides where something is to be computed, not only drawn."""

from contextlib import suppress
from importlib import import_module

with suppress(Exception):
    import_module("pseudorigid.dynamics.ensemble")
    # What numba loads at the first call of anything.
    import_module("numba").njit(lambda: 0)()
