"""The fixed point's twist against the energy."""

import math

from ..fields import Energy, axes_of, listed, rising
from ..scene import Scene

CLOSE = 1e-9  # of a trace to one that belongs to a root of unity


class Twist(Scene):
    """the fixed point's twist coefficient against the energy

    The twist coefficient (Birkhoff's first) of the elliptic fixed point against the energy, for k
    = {{ s.ball.k }}, g = {{ s.ball.g }}: doubles rounded from enclosures.

    What to see: where it is not zero, Moser's theorem gives invariant curves around the point. It
    vanishes once, at the ring, where the proof encloses the energy to ten digits and more; just
    below that energy curves without shear shrink into the point.
    """

    stages = ("twist",)
    framed_by = ("energies",)
    telling = "zero of the twist"

    energies: listed(Energy, "a list of energies in rising order", 2, 1000, rising)
    """where the coefficient is computed"""
    marks: listed(Energy, "a list of energies among those", 0, 10) = []
    """energies that are marked"""
    axes: axes_of("energy", "twist") = None

    @classmethod
    def faults(cls, block):
        """Marks are among the energies; the fixed point has a twist at each of these."""
        faults = [*super().faults(block)]
        yield from faults
        for mark in block["marks"]:
            if mark not in block["energies"]:
                yield ("marks",), mark, "one of energies"
        for i, energy in enumerate(block["energies"] if not faults else ()):
            trace = _trace(block["ball"]["k"], energy / block["ball"]["g"] ** 2)
            if not trace > -2:
                what = "an energy at which the fixed point is elliptic; here it is not"
                yield ("energies", i), energy, what
            elif min(abs(trace - root) for root in (-2, -1, 0, 2)) < CLOSE:
                what = "an energy at which no power of the multiplier up to the fourth is 1"
                yield ("energies", i), energy, what

    @staticmethod
    def numbers(block, twist):
        """Where it vanishes."""
        zero = float(twist["zero"])
        return {"zero of the twist": "none between them" if math.isnan(zero) else f"{zero:.12f}"}


def _trace(k, energy):
    """The trace at the fixed point at energy E/g^2, as in `pseudorigid.dynamics.fixed_point`.

    That module compiles code when it is imported, which takes too long for a check.
    """

    def bent(theta):
        return 1 - theta / math.tan(theta)

    low, high = 0.0, math.pi
    while (theta := (low + high) / 2) not in (low, high):
        below = ((1 + k) * theta * theta + bent(theta) ** 2 - 1) / (2 * k) < energy
        low, high = (theta, high) if below else (low, theta)
    shear = bent(theta) * (2 * theta - math.sin(2 * theta)) / (theta * (1 + k))
    return 2 * (1 + k * (math.cos(2 * theta) - shear)) / (1 + k)
