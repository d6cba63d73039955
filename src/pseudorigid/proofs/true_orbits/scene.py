"""The orbits of a scene from exact starts."""

import json
import shutil
from pathlib import Path

import numpy as np

from ...dynamics.ball import Ball
from ...dynamics.orbits import ragged_orbits
from ...dynamics.starts import start_state
from ..enclosure.surface import Surface, exact
from . import keeping
from .orbit import true_orbit


def true_scene_orbits(k, g, energy, starts, impacts, *, progress=None, folder=None):
    """The orbits of a scene, as `dynamics.orbits.scene_orbits` returns them, correctly rounded.

    Parameters
    ----------
    k, g, energy
        Exact, as for `true_orbit`.
    starts : list
        Exact fractions of the section's radius along y = 0, or points {"x": x, "y": y}.
    impacts : int or list of int
        How many of each orbit.
    progress : callable, optional
        Called with the share done and the seconds left of the orbit at work, and its index.
    folder : path, optional
        Where finished orbits and the checkpoint of the one at work are while the run lasts.

    Raises
    ------
    ValueError
        As `true_orbit`; a start {"x", "xdot"}, whose y is not a decimal.
    """
    if any(isinstance(start, dict) and "y" not in start for start in starts):
        raise ValueError("an exact start is a fraction or a point {x, y}, not {x, xdot}")
    counts = impacts if isinstance(impacts, list) else [impacts] * len(starts)
    pieces = []
    for index, (start, count) in enumerate(zip(starts, counts, strict=True)):
        pieces.append(_kept(folder, index, k, g, energy, _place(start), count, progress))
    if folder is not None:
        shutil.rmtree(folder, ignore_errors=True)
    ball = Ball(float(exact("k", k)), float(exact("g", g)))
    states = [start_state(ball, float(exact("energy", energy)), _rounded(s)) for s in starts]
    return ragged_orbits(pieces, [_rounded(start) for start in starts], states, counts)


def _place(start):
    """The arguments of `true_orbit` for a start, numbers as the decimals that they are written."""
    given = start if isinstance(start, dict) else {"start": start}
    return {name: str(value) for name, value in given.items()}


def _rounded(start):
    if isinstance(start, dict):
        return {name: float(exact(name, str(value))) for name, value in start.items()}
    return float(exact("start", str(start)))


def _kept(folder, index, k, g, energy, place, count, progress):
    """One orbit of a scene, (4, count), from the folder if it is there."""
    report = None if progress is None else lambda *done: progress(*done, index)
    if folder is None:
        found = true_orbit(k, g, energy, count, **place, progress=report)
        return _columns(found)
    Path(folder).mkdir(parents=True, exist_ok=True)
    identity = json.dumps([str(Surface(k, g, energy)), place, count], sort_keys=True)
    file = Path(folder) / f"orbit_{index}.npz"
    saved = keeping.load(file)
    if saved is not None and str(saved["identity"]) == identity:
        return saved["values"]
    found = true_orbit(
        k, g, energy, count, **place, progress=report,
        checkpoint=Path(folder) / f"orbit_{index}.part.npz",
    )  # fmt: skip
    values = _columns(found)
    keeping.save(file, identity=identity, values=values)
    return values


def _columns(dataset):
    return np.array([dataset[name].values for name in ("x", "xdot", "udot", "tau")])
