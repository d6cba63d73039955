"""The map of many states: orbits in SIMD lanes and on all cores, each with the bits it has alone.

And, state by state, the way back and the Jacobian.
"""

import os
from concurrent.futures import ThreadPoolExecutor

import numba
import numpy as np

from ..kernel import impact, lanes
from .inputs import not_allowed, number

MIN_IMPACTS_PER_THREAD = 20_000  # impacts, half a millisecond, that a thread does at least


def threads() -> int:
    """How many threads to use.

    Returns
    -------
    int
        OMP_NUM_THREADS, or one for each core of this process.
    """
    given = os.environ.get("OMP_NUM_THREADS", "")
    return max(1, int(given)) if given.isdigit() else len(os.sched_getaffinity(0))


def shared(work, impacts, *arrays):
    """Do work on pieces of arrays, one piece a thread, if that is worth starting one.

    Parameters
    ----------
    work : callable
        Takes the pieces, returns a number.
    impacts : int
        Of each orbit: a thread is started only where it has WORTH of them to do.
    *arrays : ndarray
        Cut along their first axis, the orbits.

    Returns
    -------
    int
        The sum of what `work` returns.
    """
    orbits = len(arrays[0])
    workers = min(threads(), orbits // lanes.LANES, orbits * impacts // MIN_IMPACTS_PER_THREAD)
    if workers < 2:
        return work(*arrays)
    pieces = zip(*(np.array_split(a, workers) for a in arrays), strict=True)
    with ThreadPoolExecutor(workers) as pool:
        return sum(pool.map(lambda piece: work(*piece), pieces))


class ImpactMap:
    """The impact map over arrays of states, and how many impacts it computed and missed so far.

    Methods take states x, v, w (n,), that is x (R), xdot (R omega) and udot (omega) just before an
    impact, and the ball's k and g.

    Parameters
    ----------
    scan : (float, float), optional
        None for the certified march, which misses no impact; or step and tolerance (1/omega), each
        above 0 and finite: steps in time of constant length until the gap changes sign, then
        bisection until the bracket is no longer than the tolerance.

    Attributes
    ----------
    root_finder : None or (float, float)
        `scan`, as the kernel's functions take it.
    impacts, missed : int
        Computed so far, and of these the ones that came after an impact that was flown past.

    Raises
    ------
    ValueError
        A step or tolerance out of range.

    Notes
    -----
    Maps with the same `scan` are equal, whatever they counted.
    """

    def __init__(self, scan=None):
        if scan is not None:
            try:
                step, tolerance = scan
            except (TypeError, ValueError):
                raise not_allowed("scan", scan, "None, or (step, tolerance)") from None
            named = ("step", step), ("tolerance", tolerance)
            scan = tuple(number(*pair, "above 0, finite", lambda v: v > 0.0) for pair in named)
        self.root_finder = scan
        self.impacts = 0
        self.missed = 0

    def __repr__(self):
        return "ImpactMap()" if self.certified else f"ImpactMap(scan={self.root_finder})"

    def __eq__(self, other):
        return (
            self.root_finder == other.root_finder
            if isinstance(other, ImpactMap)
            else NotImplemented
        )

    def __hash__(self):
        return hash(self.root_finder)

    @property
    def certified(self):
        """Whether every impact is the first one."""
        return self.root_finder is None

    def steps(self, x, v, w, k, g, impacts, tau):
        """Advance states in place; the memory does not grow with `impacts`.

        Parameters
        ----------
        x, v, w : ndarray, shape (n,)
            Overwritten.
        k, g : float
        impacts : int
        tau : ndarray, shape (n,)
            The last flights' times (1/omega) are written here.
        """
        self._share(x, v, w, k, g, impacts, tau, np.empty((x.size, 0, 4)))

    def history(self, x, v, w, k, g, out):
        """Advance states in place and keep every impact.

        Parameters
        ----------
        x, v, w : ndarray, shape (n,)
            Overwritten.
        k, g : float
        out : ndarray, shape (n, impacts, 4)
            x, v, w and tau of each impact are written here, the start excluded.
        """
        self._share(x, v, w, k, g, out.shape[1], np.empty(x.size), out)

    def steps_back(self, x, v, w, k, g, impacts, tau):
        """`steps` towards the past: F^-1 = R F R.

        Parameters
        ----------
        x, v, w : ndarray, shape (n,)
            Overwritten.
        k, g : float
        impacts : int
        tau : ndarray, shape (n,)
            The times (1/omega) of the flights that the states reached begin are written here.
        """
        missed = impact.steps_back(x, v, w, k, g, impacts, tau, self.root_finder)
        self.count(impacts * x.size, missed)

    def jacobians(self, x, v, w, k, g, impacts, out):
        """The Jacobian of `impacts` impacts at each state, eq. (33).

        Parameters
        ----------
        x, v, w : ndarray, shape (n,)
            They stay.
        k, g : float
        impacts : int
        out : ndarray, shape (n, 3, 3)
            Row i, column j: the derivative of the i-th new variable by the j-th old one.
        """
        missed = impact.jacobians(x, v, w, k, g, impacts, out, self.root_finder)
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
        if (
            self.certified
            and x.size >= lanes.MIN_ORBITS_FOR_LANES
            and impacts > 0
            and not numba.config.DISABLE_JIT
        ):
            lanes.steps(x, v, w, k, g, impacts, tau, out)
            return 0
        if out.size > 0:
            return impact.history(x, v, w, k, g, out, self.root_finder)
        return impact.steps(x, v, w, k, g, impacts, tau, self.root_finder)
