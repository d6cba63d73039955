"""Rotation number and exponent of orbits against their start along y = 0, at several energies."""

import math

import numpy as np
import xarray as xr

from . import fixed_point
from .ball import Ball
from .follow import follow
from .variables import variables


def rotation(ball, energy, energies, starts, impacts):
    """Rotation number around the fixed point, and exponent, of starts along y = 0.

    Parameters
    ----------
    ball : Ball
    energy : float
        The first of the energies.
    energies : sequence of float
        The others.
    starts : int
        How many starts at each energy, evenly from the fixed point to the section's rim.
    impacts : int
        Of each orbit.

    Returns
    -------
    Dataset
        On (energy, start): place, the start in section radii from the centre; rotation, turns an
        impact around the fixed point, a weighted Birkhoff average; exponent, over the second half
        of the orbit. On energy: fixed_place, fixed_rotation (NaN where it is not elliptic).
        Attribute impacts.

    References
    ----------
    Das, Saiki, Sander and Yorke, Quantitative quasiperiodicity, Nonlinearity 30 (2017);
    weights; here they are (t (1 - t))^3.
    """
    all_energies = np.array([energy, *energies], dtype=float)
    rows = [_one_energy(ball, value, starts, impacts) for value in all_energies.tolist()]
    place, turns, grown, centre, about = (np.array(column) for column in zip(*rows, strict=True))
    names = {
        "place": "start along y = 0, in section radii from the centre",
        "rotation": "rotation number around the fixed point",
        "exponent": "Lyapunov exponent an impact",
    }
    data = variables(("energy", "start"), (place, turns, grown), names)
    names = {
        "energy": "energy",
        "fixed_place": "the fixed point, in section radii from the centre",
        "fixed_rotation": "rotation number of the fixed point",
    }
    data |= variables("energy", (all_energies, centre, about), names)
    return xr.Dataset(data, attrs={"impacts": impacts})


def _one_energy(ball, energy, starts, impacts):
    unit = Ball(ball.k, 1.0)  # lengths in g R: neither number depends on the unit
    e = energy / (ball.g * ball.g)
    theta = fixed_point.half_time(ball.k, e)
    about = fixed_point.rotation(fixed_point.trace(ball.k, theta))
    middle, radius = unit.section(e)
    at = fixed_point.place(ball.k, theta)
    centre = (at - middle) / radius
    place = centre + (1.0 - centre) * (np.arange(starts) + 0.5) / starts
    time = (np.arange(impacts) + 0.5) / impacts
    bump = time * (1.0 - time)
    weight = bump * bump * bump
    weight /= weight.sum()
    turns, grown = np.empty(starts), np.empty(starts)
    states = [a.copy() for a in unit.start(place, e)]
    expected = 0.5 if math.isnan(about) else about
    follow(*states, ball.k, at, expected, weight, grown, turns)
    return place, turns, grown, centre, about
