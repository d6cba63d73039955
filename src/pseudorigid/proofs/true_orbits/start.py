"""Exact starts, and how many bits their orbits need."""

import json
import math

import numpy as np
from flint import arb, ctx

from ...dynamics.ball import Ball
from ...dynamics.lyapunov import lyapunov_spectrum
from ...kernel.arithmetic import log
from ..enclosure.surface import ball_of, exact
from .enclosed_run import FRAME_BITS, GUARD, RESULT_BITS


class Start:
    """An exact start: balls of its coordinates at any precision.

    Parameters
    ----------
    surface : Surface
    start : int, Fraction, Decimal, str or mapping
        A fraction of the section's radius along y = 0, or a mapping with x and y or xdot.

    Raises
    ------
    ValueError
        Numbers that are not exact, or a start on or beyond the rim.
    """

    def __init__(self, surface, start):
        self.surface = surface
        names = sorted(start) if isinstance(start, dict) else ["start"]
        if names not in (["start"], ["x", "y"], ["x", "xdot"]):
            raise ValueError(
                "a start is a fraction of the section's radius, or x and y, or x and xdot"
            )
        values = start if isinstance(start, dict) else {"start": start}
        self.numbers = {name: exact(name, values[name]) for name in names}
        if not self._inside():
            raise ValueError(f"the start {self} is not inside the section's rim at {surface}")

    def __str__(self):
        return ", ".join(f"{name} = {value}" for name, value in self.numbers.items())

    def _inside(self):
        """Exactly: whether s > 0 there."""
        k, g, energy = self.surface.k, self.surface.g, self.surface.energy
        if "start" in self.numbers:
            return -1 < self.numbers["start"] < 1
        x = self.numbers["x"]
        kinetic = 2 * energy + x * (2 * g - k * x)  # twice of it
        if "y" in self.numbers:
            return (1 + k) * kinetic > self.numbers["y"] ** 2
        xdot = self.numbers["xdot"]  # with udot > 0 of two, k udot^2 = 2 T - xdot^2
        return kinetic > xdot * xdot and (xdot >= 0 or kinetic > (1 + k) * xdot * xdot)

    def balls(self):
        """The point of the chart at the context's precision.

        Returns
        -------
        x, y : arb
        """
        k, g, energy = self.surface.constants()
        numbers = {name: ball_of(value) for name, value in self.numbers.items()}
        if "start" in numbers:
            return g / k + numbers["start"] * self.surface.radius(), arb(0)
        x = numbers["x"]
        if "y" in numbers:
            return x, numbers["y"]
        xdot = numbers["xdot"]
        udot = ((2 * energy + x * (2 * g - k * x) - xdot * xdot) / k).sqrt()
        return x, xdot - k * udot

    def floats(self):
        """The start as `dynamics.starts.start_state` takes it.

        Returns
        -------
        float or dict
        """
        numbers = {name: float(value) for name, value in self.numbers.items()}
        return numbers.get("start", numbers)

    def identity(self, impacts):
        """What a checkpoint must be of.

        Parameters
        ----------
        impacts : int

        Returns
        -------
        str
        """
        return json.dumps([str(self.surface), str(self), impacts])


def bits_needed(surface, place, impacts):
    """Bits to start with, from the stretch along the orbit in double precision.

    Parameters
    ----------
    surface : Surface
    place : Start
    impacts : int

    Returns
    -------
    int
    """
    ball = Ball(k=float(surface.k), g=float(surface.g))
    with ctx.workprec(FRAME_BITS):
        x, y = (float(a) for a in place.balls())
    state = ball.state_xy(x, y, float(surface.energy))
    spectrum = lyapunov_spectrum(ball, state, impacts)
    stretch = spectrum["exponent"].values[:, 0] * spectrum["impact"].values
    growth = float(np.nanmax(stretch, initial=0.0)) / log(2.0)
    # the true orbit stretches by as much only in the mean: its spread grows like the root
    return RESULT_BITS + GUARD + int(growth + 12.0 * math.sqrt(growth)) + 64
