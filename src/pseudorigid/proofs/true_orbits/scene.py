"""The orbits of a scene from exact starts."""

import os
import shutil
from collections.abc import Callable
from pathlib import Path

import xarray as xr

from ...dynamics.ball import Ball
from ...dynamics.orbits import ragged_orbits
from ...dynamics.starts import start_state
from ..enclosure.surface import Exact, Surface
from .orbit import follow
from .start import Start


def true_scene_orbits(
    k: Exact,
    g: Exact,
    energy: Exact,
    starts: list,
    impacts: int | list[int],
    *,
    progress: Callable | None = None,
    folder: str | os.PathLike | None = None,
) -> xr.Dataset:
    """Compute the orbits of a scene, one after the other (CF), correctly rounded.

    Parameters
    ----------
    k, g, energy : int, Fraction, Decimal or str
        The ball and its energy, exact.
    starts : list
        Exact starts in the form of the argument `start` of `true_orbit`.
    impacts : int or list of int
        How many of each orbit.
    progress : callable, optional
        Called with the share done and the seconds left of the current orbit, and its index.
    folder : path, optional
        Holds checkpoints of the finished orbits and the current one while the run lasts.

    Returns
    -------
    xarray.Dataset
        x, xdot, udot, tau on `point`; on `orbit` start and row_size, and start_x and start_xdot
        where a start is a point.

    Raises
    ------
    ValueError
        As from `true_orbit`.

    Examples
    --------
    >>> true_scene_orbits("1/5", "1/25", "1/100", ["0.5", "-0.2"], [3, 2]).sizes["point"]
    5
    """
    surface = Surface(k, g, energy)
    impacts = impacts if isinstance(impacts, list) else [impacts] * len(starts)
    exact_starts = [Start(surface, start) for start in starts]
    if folder is not None:
        Path(folder).mkdir(parents=True, exist_ok=True)
    pieces = []
    for i, (start, count) in enumerate(zip(exact_starts, impacts, strict=True)):
        report = None if progress is None else lambda *done, orbit=i: progress(*done, orbit)
        checkpoint = None if folder is None else Path(folder) / f"orbit_{i}.npz"
        pieces.append(follow(start, count, report, checkpoint).values.T)
    if folder is not None:
        shutil.rmtree(folder, ignore_errors=True)
    ball = Ball(k=float(surface.k), g=float(surface.g))
    floats = [start.floats() for start in exact_starts]
    states = [start_state(ball, float(surface.energy), start) for start in floats]
    return ragged_orbits(pieces, floats, states, impacts)
