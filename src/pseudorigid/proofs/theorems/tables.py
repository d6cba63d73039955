"""What the stages behind the pictures of proofs share; their data are doubles."""

from collections.abc import Callable, Sequence

import numpy as np
import xarray as xr
from flint import arb

from ...dynamics.ball import Ball
from ...dynamics.variables import described
from ..checks.certificate import Finding
from ..checks.hsets import HSet
from ..enclosure.surface import Surface
from .statements import THEOREMS, Theorem

_CORNERS = (1, 1), (1, -1), (-1, -1), (-1, 1)  # p and q, around a set


def surface_of(ball: Ball, energy: float) -> Surface:
    """Return the Surface whose k, g and energy are the decimals that the numbers print as."""
    return Surface(*(str(value) for value in (ball.k, ball.g, energy)))


def theorems_at(surface: Surface, checker: Callable[..., Finding]) -> list[Theorem]:
    """Return the theorems on a surface that a checker proves."""
    return [
        theorem
        for theorem in THEOREMS.values()
        if theorem.checker is checker and theorem.bounds["surface"] == surface
    ]


def doubles(balls: Sequence) -> np.ndarray:
    """Round nested lists of balls to an array of doubles."""
    return np.array(balls, dtype=object).astype(float)


def corners(sets: list[HSet]) -> tuple[np.ndarray, np.ndarray]:
    """Return x and y of the corners around each set, (set, corner)."""
    x, y = doubles([[hset.box(arb(p), arb(q)) for p, q in _CORNERS] for hset in sets]).T
    return x.T, y.T


def dataset(table: dict, surface: Surface) -> xr.Dataset:
    """Return the dataset of a table, as for `described`, with k and g as attributes."""
    return xr.Dataset(described(table), attrs={"k": float(surface.k), "g": float(surface.g)})
