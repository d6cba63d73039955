"""The orbits of a scene from exact starts."""

from collections.abc import Callable

import xarray as xr

from ...dynamics.ball import Ball
from ...dynamics.orbits import ragged_orbits
from ...dynamics.starts import start_state
from ..enclosure.surface import Surface
from .orbit import follow
from .start import Start


def true_scene_orbits(
    ball: Ball,
    energy: float,
    starts: list,
    impacts: int | list[int],
    *,
    progress: Callable | None = None,
) -> xr.Dataset:
    """Compute the orbits of a scene, one after the other (CF), correctly rounded.

    Each number stands for the decimal that Python prints: 0.2 is 1/5. `progress` is called with the
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
    return ragged_orbits(pieces, starts, states, impacts)


def _as_text(start: float | dict[str, float]) -> str | dict[str, str]:
    """Return a start with its numbers as decimals."""
    if isinstance(start, dict):
        return {name: str(value) for name, value in start.items()}
    return str(start)
