"""The map of many states: orbits in SIMD lanes and on all cores, each with the bits it has alone;
and, state by state, the way back and the Jacobian.
"""

import os
from concurrent.futures import ThreadPoolExecutor

import numba
import numpy as np

from . import impact, lanes
from .impact import jacobians, steps_back

__all__ = ["history", "jacobians", "steps", "steps_back", "threads"]

# Fewer orbits than this are faster one after the other.
_FEW = 12


def threads() -> int:
    """How many threads to use: OMP_NUM_THREADS, or one for each core of this process."""
    given = os.environ.get("OMP_NUM_THREADS", "")
    return max(1, int(given)) if given.isdigit() else len(os.sched_getaffinity(0))


def steps(x, v, w, k, g, impacts, tau):
    """Advance the states x, v, w (n,) in place by `impacts`; tau (n,) is the last flight's.

    The memory does not grow with `impacts`.
    """
    _share(x, v, w, k, g, impacts, tau, np.empty((x.size, 0, 4)))


def history(x, v, w, k, g, out):
    """Every impact of the states x, v, w (n,): out (n, impacts, 4) holds x, v, w and tau.

    The states are advanced in place to the last one.
    """
    _share(x, v, w, k, g, out.shape[1], np.empty(x.size), out)


def _share(x, v, w, k, g, impacts, tau, out):
    workers = min(threads(), x.size // lanes.LANES)
    if workers < 2:
        return _some(x, v, w, k, g, impacts, tau, out)
    pieces = [np.array_split(a, workers) for a in (x, v, w, tau, out)]
    with ThreadPoolExecutor(workers) as pool:
        jobs = [
            pool.submit(_some, x, v, w, k, g, impacts, tau, out)
            for x, v, w, tau, out in zip(*pieces, strict=True)
        ]
    for job in jobs:
        job.result()


def _some(x, v, w, k, g, impacts, tau, out):
    """One thread's share."""
    if x.size >= _FEW and impacts > 0 and not numba.config.DISABLE_JIT:
        lanes.steps(x, v, w, k, g, impacts, tau, out)
    elif out.size > 0:
        impact.history(x, v, w, k, g, out)
    else:
        impact.steps(x, v, w, k, g, impacts, tau)
