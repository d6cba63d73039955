"""The last invariant curve of the main island."""

from ..fields import LARGEST, Between, listed, whole
from ..scene import Scene, listing


class LastCurve(Scene):
    """residues of the convergents of noble rotation numbers

    Greene's residues of {{ s.convergents }} convergents of two noble rotation numbers at energy
    {{ s.energy }} for k = {{ s.ball.k }}, g = {{ s.ball.g }}; below, in the same colours, an orbit
    that starts at the periodic point of the last convergent of each.

    What to see: residues that fall to zero mean a curve of that rotation number. Residues that grow
    mean that there is none: the orbit from there wanders through the sea and has no rotation
    number. The last curve of the main island lies between.
    """

    stages = ("last_curve",)
    telling = "last residues"

    nobles: listed(listed(whole(0, 1000), "a continued fraction"), "a list of continued fractions")
    """rotation numbers, each a continued fraction with ones after its end"""
    convergents: whole(2, 20)
    """how many convergents of each"""
    between: Between
    """the part of y = 0 on which their orbits are sought"""
    impacts: whole(100, LARGEST)
    """impacts of the orbit at the last convergent"""
    drawn: whole(100, LARGEST)
    """how many of these are drawn"""

    @classmethod
    def faults(cls, block):
        """Orbits that can be followed, and drawn."""
        yield from super().faults(block)
        for i, noble in enumerate(block["nobles"]):
            before, period = 0, 1
            for quotient in noble[1:] + [1] * (block["convergents"] - 1):
                before, period = period, before + quotient * period
            if not 0 < period <= LARGEST:
                what = f"one whose last convergent has a period from 1 to {LARGEST}, not {period}"
                yield ("nobles", i), noble, what
        if block["drawn"] * len(block["nobles"]) > LARGEST:
            what = f"at most {LARGEST} points drawn, counted over all nobles"
            yield ("drawn",), block["drawn"], what

    @staticmethod
    def numbers(block, last_curve):
        """The residue of the last convergent of either number, and its period."""
        last = last_curve.isel(convergent=-1)
        return {"last residues": listing(last, "{:.2g} at period {:.0f}", "residue", "period")}
