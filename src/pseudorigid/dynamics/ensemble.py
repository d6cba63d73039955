"""Impact map over arrays of states, in SIMD lanes and on all cores."""

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import Any

import numba
import numpy as np

from ..kernel import impact, lanes
from .inputs import not_allowed, number

MIN_IMPACTS_PER_THREAD = 20_000  # half a millisecond
MIN_ORBITS_PER_THREAD = 32  # fewer orbits leave vectors of lanes incomplete


def threads() -> int:
    """Return OMP_NUM_THREADS, or the number of cores of this process."""
    setting = os.environ.get("OMP_NUM_THREADS", "")
    if setting.isdigit():
        return max(1, int(setting))
    # The cores of this process; macOS knows those of the machine alone.
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def in_threads(work: Callable[..., int], impacts: int, *arrays: np.ndarray) -> int:
    """Apply `work` to pieces of arrays, one in each thread, and return the sum of its results.

    The arrays are cut along their first axis, the orbits, which have `impacts` impacts each.
    """
    orbits = len(arrays[0])
    busy = orbits * impacts // MIN_IMPACTS_PER_THREAD
    workers = min(threads(), orbits // MIN_ORBITS_PER_THREAD, busy)
    if workers < 2:
        return work(*arrays)
    pieces = zip(*(np.array_split(a, workers) for a in arrays), strict=True)
    with ThreadPoolExecutor(workers) as pool:
        return sum(pool.map(lambda piece: work(*piece), pieces))


@dataclass(unsafe_hash=True)
class ImpactMap:
    """Way to find the next impact, with counts of the impacts computed and missed.

    By default every impact is found by a march that misses none in exact arithmetic. `scan` =
    (step, tolerance), both in 1/omega, positive and finite, selects steps of constant length until
    the gap changes sign, and bisection until the bracket is no longer than the tolerance. Maps with
    the same `scan` are equal, whatever they counted.
    """

    scan: Any = None
    impacts: int = field(default=0, init=False, repr=False, compare=False)
    missed: int = field(default=0, init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        if self.scan is not None:
            try:
                step, tolerance = self.scan
            except (TypeError, ValueError):
                raise not_allowed("scan", self.scan, "None, or (step, tolerance)") from None
            named = {"step": step, "tolerance": tolerance}.items()
            self.scan = tuple(number(*item, "above 0, finite", lambda v: v > 0.0) for item in named)

    @property
    def certified(self) -> bool:
        """Whether no impact can be missed."""
        return self.scan is None

    def count(self, impacts: int, missed: int) -> None:
        """Add to the numbers of impacts computed and missed."""
        self.impacts += impacts
        self.missed += missed

    def iterate(
        self, columns: list[np.ndarray], k: float, g: float, impacts: int, out: np.ndarray
    ) -> None:
        """Advance columns x, v, w, tau in place, as `impact.iterate`, in lanes and threads."""
        compiled = not getattr(numba.config, "DISABLE_JIT", False)
        fits_lanes = self.certified and impacts > 0 and compiled

        def advance_piece(*arrays: np.ndarray) -> int:
            x, v, w, tau, out = arrays
            if fits_lanes and x.size >= lanes.MIN_ORBITS_FOR_LANES:
                lanes.iterate(x, v, w, k, g, impacts, tau, out)
                return 0
            return impact.iterate(x, v, w, k, g, impacts, tau, out, self.scan)

        self.count(impacts * len(out), in_threads(advance_piece, impacts, *columns, out))
