"""Impact map over arrays of states, in SIMD lanes and on all cores."""

import os
from concurrent.futures import ThreadPoolExecutor

import numba
import numpy as np

from ..kernel import impact, lanes
from .inputs import not_allowed, number

MIN_IMPACTS_PER_THREAD = 20_000  # half a millisecond
MIN_ORBITS_PER_THREAD = 32  # fewer orbits leave vectors of lanes incomplete


def threads() -> int:
    """Return OMP_NUM_THREADS, or the number of cores of this process."""
    setting = os.environ.get("OMP_NUM_THREADS", "")
    return max(1, int(setting)) if setting.isdigit() else len(os.sched_getaffinity(0))


def shared(work, impacts, *arrays):
    """Apply `work` to pieces of arrays, one in each thread, and return the sum of its results.

    The arrays are cut along their first axis, the orbits, which have `impacts` impacts each.
    """
    orbits = len(arrays[0])
    enough = orbits * impacts // MIN_IMPACTS_PER_THREAD
    workers = min(threads(), orbits // MIN_ORBITS_PER_THREAD, enough)
    if workers < 2:
        return work(*arrays)
    pieces = zip(*(np.array_split(a, workers) for a in arrays), strict=True)
    with ThreadPoolExecutor(workers) as pool:
        return sum(pool.map(lambda piece: work(*piece), pieces))


class ImpactMap:
    """Impact map over arrays of states, with counts of the impacts computed and missed.

    Methods take states x, v, w (n,), that is x (R), xdot (R omega) and udot (omega) just before an
    impact, and the ball's k and g. By default every impact is found by a march that misses none.
    `scan` = (step, tolerance), both in 1/omega, positive and finite, selects steps of constant
    length until the gap changes sign, and bisection until the bracket is no longer than the
    tolerance. Maps with the same `scan` are equal, whatever they counted.
    """

    def __init__(self, scan=None):
        if scan is not None:
            try:
                step, tolerance = scan
            except (TypeError, ValueError):
                raise not_allowed("scan", scan, "None, or (step, tolerance)") from None
            named = {"step": step, "tolerance": tolerance}.items()
            scan = tuple(number(*item, "above 0, finite", lambda v: v > 0.0) for item in named)
        self.root_finder = scan
        self.impacts = 0
        self.missed = 0

    def __repr__(self):
        return "ImpactMap()" if self.certified else f"ImpactMap(scan={self.root_finder})"

    def __eq__(self, other):
        if not isinstance(other, ImpactMap):
            return NotImplemented
        return self.root_finder == other.root_finder

    def __hash__(self):
        return hash(self.root_finder)

    @property
    def certified(self) -> bool:
        """Whether no impact can be missed."""
        return self.root_finder is None

    def steps(self, x, v, w, k, g, impacts, tau):
        """Advance states by `impacts` in place; `tau` (n,) receives the last times of flight."""
        self._advance(x, v, w, k, g, impacts, tau, np.empty((x.size, 0, 4)))

    def history(self, x, v, w, k, g, out):
        """Advance states in place, and write x, v, w, tau of each impact to out (n, impacts, 4)."""
        self._advance(x, v, w, k, g, out.shape[1], np.empty(x.size), out)

    def steps_back(self, x, v, w, k, g, impacts, tau):
        """Apply the inverse map in place; `tau` (n,) receives the last times of flight."""
        missed = impact.steps_back(x, v, w, k, g, impacts, tau, self.root_finder)
        self.count(impacts * x.size, missed)

    def jacobians(self, x, v, w, k, g, impacts, out):
        """Write the Jacobians of `impacts` impacts, eq. (33), to out (n, 3, 3); keep the states."""
        missed = impact.jacobians(x, v, w, k, g, impacts, out, self.root_finder)
        self.count(impacts * x.size, missed)

    def count(self, impacts, missed):
        """Add to the numbers of impacts computed and missed."""
        self.impacts += impacts
        self.missed += missed

    def _advance(self, x, v, w, k, g, impacts, tau, out):
        for_lanes = self.certified and impacts > 0 and not numba.config.DISABLE_JIT

        def advance_piece(x, v, w, tau, out):
            if for_lanes and x.size >= lanes.MIN_ORBITS_FOR_LANES:
                lanes.steps(x, v, w, k, g, impacts, tau, out)
                return 0
            if out.size > 0:
                return impact.history(x, v, w, k, g, out, self.root_finder)
            return impact.steps(x, v, w, k, g, impacts, tau, self.root_finder)

        self.count(impacts * x.size, shared(advance_piece, impacts, x, v, w, tau, out))
