"""The map of many states: orbits in SIMD lanes and on all cores, each with the bits it has alone;
and, state by state, the way back and the Jacobian.
"""

import math
import os
from concurrent.futures import ThreadPoolExecutor

import numba
import numpy as np

from ..kernel import impact, lanes

WORTH = 20_000  # impacts, half a millisecond, that a thread does at least


def threads() -> int:
    """How many threads to use: OMP_NUM_THREADS, or one for each core of this process."""
    given = os.environ.get("OMP_NUM_THREADS", "")
    return max(1, int(given)) if given.isdigit() else len(os.sched_getaffinity(0))


def shared(work, impacts, *arrays):
    """The sum of what `work` returns for the pieces of the arrays, cut along their first axis, the
    orbits, of which each does `impacts`: one piece a thread, if that is worth starting one.
    """
    orbits = len(arrays[0])
    workers = min(threads(), orbits // lanes.LANES, orbits * impacts // WORTH)
    if workers < 2:
        return work(*arrays)
    pieces = zip(*(np.array_split(a, workers) for a in arrays), strict=True)
    with ThreadPoolExecutor(workers) as pool:
        return sum(pool.map(lambda piece: work(*piece), pieces))


class ImpactMap:
    """The impact map over arrays of states, and how many impacts it computed and missed so far.

    Args:
        scan: None for the certified march, which misses none; or (step, tolerance), each above 0
            and finite: steps in time of constant length until the gap changes sign, then
            bisection until the bracket is no longer than the tolerance.

    States are x, v, w (n,), advanced in place.

    Raises:
        ValueError: a step or tolerance out of range.
    """

    def __init__(self, scan=None):
        if scan is not None:
            scan = tuple(float(value) for value in scan)
            for name, value in zip(("step", "tolerance"), scan, strict=True):
                if not 0.0 < value < math.inf:
                    raise ValueError(f"{name} = {value!r} is not allowed: above 0, finite")
        self.how = scan
        self.impacts = 0
        self.missed = 0

    @property
    def certified(self):
        """Whether every impact is the first one."""
        return self.how is None

    def steps(self, x, v, w, k, g, impacts, tau):
        """Advance the states by `impacts`; tau (n,) is the last flight's.

        The memory does not grow with `impacts`.
        """
        self._share(x, v, w, k, g, impacts, tau, np.empty((x.size, 0, 4)))

    def history(self, x, v, w, k, g, out):
        """Every impact of the states: out (n, impacts, 4) holds x, v, w and tau."""
        self._share(x, v, w, k, g, out.shape[1], np.empty(x.size), out)

    def steps_back(self, x, v, w, k, g, impacts, tau):
        """`steps` towards the past."""
        missed = impact.steps_back(x, v, w, k, g, impacts, tau, self.how)
        self.count(impacts * x.size, missed)

    def jacobians(self, x, v, w, k, g, impacts, out):
        """The Jacobian of `impacts` impacts at each state, which stays: out (n, 3, 3)."""
        missed = impact.jacobians(x, v, w, k, g, impacts, out, self.how)
        self.count(impacts * x.size, missed)

    def count(self, impacts, missed):
        """Add to the impacts that were computed, and to those that were flown past."""
        self.impacts += impacts
        self.missed += missed

    def _share(self, x, v, w, k, g, impacts, tau, out):
        def some(x, v, w, tau, out):
            return self._some(x, v, w, k, g, impacts, tau, out)

        self.count(impacts * x.size, shared(some, impacts, x, v, w, tau, out))

    def _some(self, x, v, w, k, g, impacts, tau, out):
        """One thread's share; how many impacts it missed."""
        if self.certified and x.size >= lanes.FEW and impacts > 0 and not numba.config.DISABLE_JIT:
            lanes.steps(x, v, w, k, g, impacts, tau, out)
            return 0
        if out.size > 0:
            return impact.history(x, v, w, k, g, out, self.how)
        return impact.steps(x, v, w, k, g, impacts, tau, self.how)
