"""The orbit of an exact start, correctly rounded."""

import os
from pathlib import Path

import numpy as np
import xarray as xr

from ...dynamics.inputs import whole_number
from ...dynamics.variables import attributes_of, variables
from ..enclosure.surface import Surface
from . import checkpoints
from .enclosed_run import Run, ShortOfBitsError
from .start import Start, bits_needed


def true_orbit(k, g, energy, impacts, *, x=None, y=0, start=None, progress=None, checkpoint=None):
    """The orbit of an exact start under the impact map, eq. (28), correctly rounded.

    Parameters
    ----------
    k, g, energy : int, Fraction, Decimal or str
        The ball and its energy, exact.
    impacts : int
        How many.
    x, y : int, Fraction, Decimal or str
        The start in the chart, y = xdot - k udot.
    start : int, Fraction, Decimal, str or mapping
        In place of x and y: a fraction, -1 to 1, of the section's radius along y = 0; or a mapping
        with x and either y or xdot.
    progress : callable, optional
        Called now and then with the share done, 0 to 1, and the seconds that are left.
    checkpoint : path, optional
        A file that holds what has been computed while the run lasts; a run that was killed goes on
        from there.

    Returns
    -------
    xarray.Dataset
        x, xdot, udot, tau on `impact`, the start excluded: each the double nearest to the true
        value, or 0 where that is closer to 0 than 2^-80. Attribute bits: the precision it took.

    Raises
    ------
    ValueError
        Numbers that are not exact or not allowed, a start on or beyond the rim, a flight that
        grazes to within the precision, more bits than MOST_BITS, too little memory.

    Examples
    --------
    >>> true_orbit("1/5", "1/25", "1/100", 3, start="1/2").sizes["impact"]
    3
    """
    surface = Surface(k, g, energy)
    if (x is None) == (start is None):
        raise ValueError("where the orbit starts is given by x and y, or by start: by one of them")
    place = Start(surface, {"x": x, "y": y} if start is None else start)
    checkpoint = None if checkpoint is None else Path(checkpoint)
    impacts = whole_number("impacts", impacts)
    _memory(impacts)
    run = _resumed(checkpoint, surface, place, impacts)
    if run is None:
        run = Run(surface, place, impacts, bits_needed(surface, place, impacts))
    clock = checkpoints.Clock(run, progress, checkpoint)
    while run.count < impacts:
        try:
            run.step()
        except ShortOfBitsError:
            run = Run(surface, place, impacts, run.bits + run.bits // 4 + 100)
            clock = checkpoints.Clock(run, progress, checkpoint)
        clock.tick(run)
    if checkpoint is not None:
        checkpoint.unlink(missing_ok=True)
    data = variables("impact", run.values.T)
    impact = "impact", np.arange(1, impacts + 1), attributes_of("number of impacts")
    return xr.Dataset(data, coords={"impact": impact}, attrs={"bits": run.bits})


def _memory(impacts):
    """ValueError where the results would not fit into memory."""
    needed = 200 * impacts  # bytes, as doubles in the run, the Dataset and a checkpoint
    there = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    if needed > there // 2:
        raise ValueError(f"{impacts} impacts need {needed / 1e9:.0f} GB of memory")


def _resumed(checkpoint, surface, place, impacts):
    """The run of a checkpoint of this very orbit, or None."""
    saved = checkpoint and checkpoints.load(checkpoint, place.identity(impacts))
    return saved and Run.restored(surface, place, impacts, str(saved["state"]), saved["values"])
