"""The compiled functions of sweeps, loaded by the server if a run computes a sweep.

Each of the many blocks of a sweep would otherwise spend 0.1 s on loading them.
"""

from contextlib import suppress
from importlib import import_module

with suppress(Exception):
    import_module("pseudorigid.sweep.cell").cells(0.2, [1.0], 20, 200)
