"""The last invariant curve of the main island."""

from ..fields import Between, listed, whole
from ..scene import Scene


class LastCurve(Scene):
    """residues of the convergents of noble rotation numbers

    Greene's residues of {{ s.convergents }} convergents of two noble rotation numbers at energy
    {{ s.energy }} for k = {{ s.ball.k }}, g = {{ s.ball.g }}, and an orbit that starts at the
    last of each.

    What to see: residues that fall to zero mean a curve, residues that grow mean none; the last
    curve of the main island lies between.
    """

    stages = ("last_curve",)
    telling = "convergents"

    nobles: listed(listed(whole(0, 1000), "a continued fraction"), "a list of continued fractions")
    """rotation numbers, each a continued fraction with ones after its end"""
    convergents: whole(2, 20)
    """how many convergents of each"""
    between: Between
    """the part of y = 0 on which their orbits are sought"""
    impacts: whole(100, 100_000_000)
    """impacts of the orbit at the last convergent"""
    drawn: whole(100, 10_000_000)
    """how many of these are drawn"""

    @staticmethod
    def numbers(block, last_curve):
        """How many."""
        return {"convergents": f"{block['convergents']}"}
