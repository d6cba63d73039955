"""The orbits of a scene from exact starts."""

from collections.abc import Callable

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
) -> xr.Dataset:
    """Compute the orbits of a scene, one after the other (CF), correctly rounded.

    The numbers are exact, and the starts in the form of the argument `start` of `true_orbit`.
    `progress` is called with the share done of the current orbit, and its index. Raises ValueError
    as `true_orbit` does.

    >>> true_scene_orbits("1/5", "1/25", "1/100", ["0.5", "-0.2"], [3, 2]).sizes["point"]
    5
    """
    surface = Surface(k, g, energy)
    impacts = impacts if isinstance(impacts, list) else [impacts] * len(starts)
    exact_starts = [Start(surface, start) for start in starts]
    pieces = []
    for i, (start, count) in enumerate(zip(exact_starts, impacts, strict=True)):
        report = None if progress is None else lambda share, orbit=i: progress(share, orbit)
        pieces.append(follow(start, count, report).values.T)
    ball = Ball(k=float(surface.k), g=float(surface.g))
    floats = [start.floats() for start in exact_starts]
    states = [start_state(ball, float(surface.energy), start) for start in floats]
    return ragged_orbits(pieces, floats, states, impacts)
