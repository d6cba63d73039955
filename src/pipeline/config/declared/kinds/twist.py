"""The fixed point's twist against the energy."""

from ..fields import Energy, axes_of, listed, rising
from ..scene import Scene


class Twist(Scene):
    """the fixed point's twist coefficient against the energy

    The twist coefficient (Birkhoff's first) of the elliptic fixed point against the energy, for k
    = {{ s.ball.k }}, g = {{ s.ball.g }}. At {{ s.energies|length }} energies from
    {{ s.energies|first }} to {{ s.energies|last }} it is enclosed, and rounded to a double;
    straight lines join these values.

    What to see: where it is not zero, Moser's theorem gives invariant curves around the point.
    Positive means that the rotation number falls away from the point. A zero is proved at the ring,
    its energy enclosed to ten digits and more; whether there is another one is not. Below that
    energy the normal form has a circle without shear, which shrinks into the point.
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
        """Marks are among the energies."""
        yield from super().faults(block)
        for mark in block["marks"]:
            if mark not in block["energies"]:
                yield ("marks",), mark, "one of energies"

    @staticmethod
    def numbers(block, twist):
        """Where it vanishes."""
        return {"zero of the twist": f"{float(twist['zero']):.12f}"}
