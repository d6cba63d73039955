"""Orbits of exact starts, correctly rounded."""

import math
import os
import time
from collections.abc import Callable, Mapping

import numpy as np
import xarray as xr
from flint import ctx

from pseudorigid.dynamics.ball import Ball
from pseudorigid.dynamics.inputs import whole_number
from pseudorigid.dynamics.lyapunov import lyapunov_spectrum
from pseudorigid.dynamics.orbits import ragged_orbits, start_state
from pseudorigid.dynamics.variables import attributes_of, variables
from pseudorigid.kernel.arithmetic import log
from pseudorigid.verified.flight import UndecidedError

from ..enclosure.surface import Exact, Surface
from .enclosed_run import FRAME_BITS, GUARD_BITS, RESULT_BITS, Run, ShortOfBitsError, Start

_BYTES_PER_IMPACT = 200  # doubles in the run and the Dataset, and room


def true_orbit(
    k: Exact,
    g: Exact,
    energy: Exact,
    impacts: int,
    *,
    x: Exact | None = None,
    y: Exact = 0,
    start: Exact | Mapping[str, Exact] | None = None,
    progress: Callable | None = None,
) -> xr.Dataset:
    """Compute the orbit of an exact start under the impact map, eq. (28), correctly rounded.

    Parameters
    ----------
    k, g, energy : int, Fraction, Decimal or str
        The ball and its energy, exact.
    impacts : int
        How many.
    x, y : int, Fraction, Decimal or str
        The start in the chart, y = xdot - k udot.
    start : int, Fraction, Decimal, str or mapping
        Used instead of x and y: a fraction, -1 to 1, of the section's radius along y = 0; or a
        mapping with x and either y or xdot.
    progress : callable, optional
        Called now and then with the share of the impacts done, 0 to 1.

    Returns
    -------
    xarray.Dataset
        x, xdot, udot, tau on `impact`, the start excluded: each the double nearest to the true
        value, or 0 where that is closer to 0 than 2^-80. Attribute bits: the precision used.

    Raises
    ------
    ValueError
        A number is not exact or not allowed, the start is on or beyond the rim, a flight grazes to
        within the precision, or the orbit needs more than MOST_BITS bits.
    MemoryError
        The orbit needs too much memory.

    References
    ----------
    Lohner, Enclosing the solutions of ordinary initial and boundary value problems (1987).

    Examples
    --------
    >>> true_orbit("1/5", "1/25", "1/100", 3, start="1/2").sizes["impact"]
    3
    """
    surface = Surface(k, g, energy)
    if start is None and x is not None:
        start = {"x": x, "y": y}
    elif start is None or x is not None:
        raise ValueError("give either x and y, or start")
    run = follow(Start(surface, start), impacts, progress)
    data = variables("impact", run.values.T)
    impact = "impact", np.arange(1, run.impacts + 1), attributes_of("number of impacts")
    return xr.Dataset(data, coords={"impact": impact}, attrs={"bits": run.bits})


def true_scene_orbits(
    ball: Ball,
    energy: float,
    starts: list,
    impacts: int | list[int],
    *,
    progress: Callable | None = None,
) -> xr.Dataset:
    """Compute the orbits of a scene, one after the other (CF), correctly rounded.

    Each number means the decimal that Python prints: 0.2 is 1/5. `progress` is called with the
    share of all orbits that is done, and the current orbit in words. Raises ValueError as
    `true_orbit` does.

    >>> true_scene_orbits(Ball(k=0.2, g=0.04), 0.01, [0.5, -0.2], [3, 2]).sizes["point"]
    5
    """
    surface = Surface(str(ball.k), str(ball.g), str(energy))
    impacts = impacts if isinstance(impacts, list) else [impacts] * len(starts)
    exact_starts = [Start(surface, _as_text(start)) for start in starts]
    pieces = []
    for i, (start, count) in enumerate(zip(exact_starts, impacts, strict=True)):

        def report(share: float, orbit: int = i) -> None:
            if progress is not None:
                progress((orbit + share) / len(starts), f"orbit {orbit + 1} of {len(starts)}")

        pieces.append(follow(start, count, report).values.T)
    states = [start_state(ball, energy, start) for start in starts]
    return ragged_orbits(ball, pieces, starts, states, impacts)


def _as_text(start: float | dict[str, float]) -> str | dict[str, str]:
    """Return a start with its numbers as decimals."""
    if isinstance(start, dict):
        return {name: str(value) for name, value in start.items()}
    return str(start)


def follow(start: Start, impacts: int, progress: Callable | None = None) -> Run:
    """Return the finished run of an orbit.

    `progress` is called as by `true_orbit`, at most once a second and at the end.
    """
    impacts = whole_number("impacts", impacts)
    needed = _BYTES_PER_IMPACT * impacts
    if needed > os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") // 2:
        raise MemoryError(f"{impacts} impacts need {needed / 1e9:.0f} GB of memory")
    run = Run(start, impacts, _bits_needed(start, impacts))
    reported = time.monotonic()
    while run.count < impacts:
        try:
            run.step()
        except UndecidedError as error:
            reason = f"the orbit cannot be followed beyond impact {run.count}: {error}"
            raise ValueError(reason) from None
        except ShortOfBitsError:
            run = Run(start, impacts, run.bits + run.bits // 4 + 100)
        now = time.monotonic()
        if progress is not None and (run.count == impacts or now - reported > 1.0):
            reported = now
            progress(run.count / impacts)
    return run


def _bits_needed(start: Start, impacts: int) -> int:
    """Estimate the precision to start with, from the stretch along the orbit in doubles."""
    surface = start.surface
    ball = Ball(k=float(surface.k), g=float(surface.g))
    with ctx.workprec(FRAME_BITS):
        x, y = (float(a) for a in start.balls())
    spectrum = lyapunov_spectrum(ball, ball.state_xy(x, y, float(surface.energy)), impacts)
    stretch = spectrum["exponent"].values[:, 0] * spectrum["impact"].values
    growth = float(np.nanmax(stretch, initial=0.0)) / log(2.0)
    # the true orbit stretches equally only in the mean: the spread grows like the square root
    return RESULT_BITS + GUARD_BITS + int(growth + 12.0 * math.sqrt(growth)) + 64
