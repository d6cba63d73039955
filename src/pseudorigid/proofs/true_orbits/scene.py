"""The orbits of a scene from exact starts."""

import json
from pathlib import Path

import numpy as np

from ...dynamics.ball import Ball
from ...dynamics.orbits import ragged_orbits
from ..enclosure.surface import Surface, exact
from . import keeping
from .orbit import true_orbit


def true_scene_orbits(k, g, energy, starts, impacts, *, progress=None, folder=None):
    """The orbits of a scene, as `dynamics.orbits.scene_orbits` returns them, correctly rounded.

    Parameters
    ----------
    k, g, energy, starts
        Exact, as for `true_orbit`; starts are fractions of the section's radius along y = 0.
    impacts : list of int
        How many of each orbit.
    progress : callable, optional
        Called with the share done and the seconds left of the orbit at work, and its index.
    folder : path, optional
        Where finished orbits and the checkpoint of the one at work are while the run lasts.
    """
    pieces = []
    for index, (start, count) in enumerate(zip(starts, impacts, strict=True)):
        pieces.append(_kept(folder, index, k, g, energy, start, count, progress))
    if folder is not None:
        for file in Path(folder).glob("orbit_*.npz"):
            file.unlink()
    ball = Ball(float(exact("k", k)), float(exact("g", g)))
    fractions = [float(exact("start", start)) for start in starts]
    states = [ball.start(start, float(exact("energy", energy))) for start in fractions]
    return ragged_orbits(pieces, fractions, states, impacts)


def _kept(folder, index, k, g, energy, start, count, progress):
    """One orbit of a scene, (4, count), from the folder if it is there."""
    report = None if progress is None else lambda *done: progress(*done, index)
    if folder is None:
        found = true_orbit(k, g, energy, count, start=start, progress=report)
        return _columns(found)
    Path(folder).mkdir(parents=True, exist_ok=True)
    identity = json.dumps([str(Surface(k, g, energy)), str(exact("start", start)), count])
    file = Path(folder) / f"orbit_{index}.npz"
    saved = keeping.load(file)
    if saved is not None and str(saved["identity"]) == identity:
        return saved["values"]
    found = true_orbit(
        k, g, energy, count, start=start, progress=report,
        checkpoint=Path(folder) / f"orbit_{index}.part.npz",
    )  # fmt: skip
    values = _columns(found)
    keeping.save(file, identity=identity, values=values)
    return values


def _columns(dataset):
    return np.array([dataset[name].values for name in ("x", "xdot", "udot", "tau")])
