"""Exact starts, and how many bits their orbits need."""

import json
import math

import numpy as np
from flint import arb, ctx

from ...dynamics.ball import Ball
from ...dynamics.lyapunov import lyapunov_spectrum
from ..enclosure.surface import ball_of, exact
from .follow import FRAME_BITS, GUARD, RESULT_BITS


class Start:
    """An exact start: balls of its coordinates at any precision."""

    def __init__(self, surface, x, y, start):
        if (x is None) == (start is None) or (x is None and y != 0):
            raise ValueError("a start is either x and y or a fraction of the section's radius")
        self.surface = surface
        self.fraction = None if start is None else exact("start", start)
        self.x = None if x is None else exact("x", x)
        self.y = exact("y", y)
        if not self._inside():
            what = f"start = {self.fraction}" if x is None else f"x = {self.x}, y = {self.y}"
            raise ValueError(f"{what} is not inside the section's rim at {surface}")

    def _inside(self):
        """Exactly: whether s > 0 there."""
        if self.fraction is not None:
            return -1 < self.fraction < 1
        k, g, energy = self.surface.k, self.surface.g, self.surface.energy
        return (1 + k) * (2 * energy + self.x * (2 * g - k * self.x)) > self.y * self.y

    def balls(self):
        """(x, y) at the context's precision."""
        if self.fraction is None:
            return ball_of(self.x), ball_of(self.y)
        k, g, _ = self.surface.constants()
        return g / k + ball_of(self.fraction) * self.surface.radius(), arb(0)

    def identity(self, impacts):
        """What a checkpoint must be of."""
        parts = (self.surface.k, self.surface.g, self.surface.energy, self.fraction, self.x, self.y)
        return json.dumps([str(part) for part in parts] + [impacts])


def bits_needed(surface, place, impacts):
    """Bits to start with, from the stretch along the orbit in double precision."""
    ball = Ball(k=float(surface.k), g=float(surface.g))
    with ctx.workprec(FRAME_BITS):
        x, y = (float(a) for a in place.balls())
    state = ball.state_xy(x, y, float(surface.energy))
    spectrum = lyapunov_spectrum(ball, state, impacts)
    stretch = spectrum["exponent"].values[:, 0] * spectrum["impact"].values
    growth = float(np.nanmax(stretch, initial=0.0)) / math.log(2.0)
    # the true orbit stretches by as much only in the mean: its spread grows like the root
    return RESULT_BITS + GUARD + int(growth + 12.0 * math.sqrt(growth)) + 64
