"""This machine in a graphics card's place.

Run as a program, this file is a ./reproduce with this machine in the place of a card.
"""

import sys

import numba
import numpy as np

from extensions.atlas.gpu import card, orbit, run
from pipeline.cli.main import main


def _in_threads(function):
    point = numba.njit(error_model="numpy")(function)

    @numba.njit(error_model="numpy")
    def run(threads, *arguments):
        for thread in range(threads):
            point(thread, *arguments)

    return run


_RUN = {function.__name__: _in_threads(function) for function in orbit.ENTRY_POINTS}


class HostCard:
    """What `gpu.card.Card` has, with arrays of this machine."""

    name, driver, memory = "this machine", "none", 10**9

    def empty(self, size, dtype):
        return np.full(size, 77, dtype)

    def copied(self, values):
        return values.flatten()

    def read(self, array, dtype):
        assert array.dtype == dtype
        return array.copy()

    def run(self, kernel, threads, *arguments):
        _RUN[kernel](threads, *arguments)


if __name__ == "__main__":
    run.Card, card.require_driver = lambda _: HostCard(), lambda: None
    sys.exit(main(sys.argv[1:]))
