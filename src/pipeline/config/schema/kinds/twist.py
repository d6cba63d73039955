"""The fixed point's twist against the energy."""

import math

from ..fields import Energy, axes_of, listed, rising
from ..scene import Scene, fixed_point_trace, not_elliptic

CLOSE = 1e-9  # of a trace to one that belongs to a root of unity


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
    axes_depend_on = ("energies",)
    along = {"energy": "energies"}
    headline = "zero of the twist"
    example = """
    ball: {k: 0.3, g: 0.02}
    energy: 0.002
    energies: [0.0005, 0.001, 0.002, 0.003, 0.004, 0.005]
    marks: [0.002]
    """

    energies: listed(Energy, "a list of energies in rising order", 2, 1000, rising)
    """where the coefficient is computed"""
    marks: listed(Energy, "a list of energies among those", 0, 10) = []
    """energies that are marked"""
    axes: axes_of("energy", "twist") = None

    @classmethod
    def cross_field_errors(cls, block):
        """Marks are among the energies; the fixed point has a twist at each of these."""
        cross_field_errors = [*super().cross_field_errors(block)]
        yield from cross_field_errors
        for mark in block["marks"]:
            if mark not in block["energies"]:
                yield ("marks",), mark, "one of energies"
        if not cross_field_errors:
            yield from not_elliptic(block, "energies")
            for i, energy in enumerate(block["energies"]):
                trace = fixed_point_trace(block["ball"], energy)
                if min(abs(trace - root) for root in (-1, 0)) < CLOSE:
                    what = "an energy at which no power of the multiplier up to the fourth is 1"
                    yield ("energies", i), energy, what

    @staticmethod
    def numbers(block, twist):
        """Where it vanishes."""
        zero = float(twist["zero"])
        return {"zero of the twist": "none between them" if math.isnan(zero) else f"{zero:.12f}"}
