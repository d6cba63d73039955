"""The last invariant curve of the main island."""

from ..fields import LARGEST, Between, listed, whole
from ..scene import Scene, listing, not_elliptic


class LastCurve(Scene):
    """residues of the convergents of noble rotation numbers

    Greene's residues of {{ s.convergents }} convergents of noble rotation numbers at energy
    {{ s.energy }} for k = {{ s.ball.k }}, g = {{ s.ball.g }}; below, in the same colours, an orbit
    that starts at the periodic point of the last convergent of each.

    What to see: by Greene's criterion, residues that fall to zero mean a curve of that rotation
    number. Residues that grow mean that there is none: the orbit from there wanders through the
    sea and has no rotation number. The last curve of the main island lies between.
    """

    stages = ("last_curve",)
    headline = "last residues"
    example = """
    ball: {k: 0.3, g: 0.02}
    energy: 0.002
    convergents: 4
    between: [-0.3, 0.3]
    impacts: 2000
    drawn: 1000
    """

    nobles: listed(
        listed(whole(0, 1000), "a continued fraction"), "a list of 1 to 8 continued fractions", 1, 8
    ) = None
    """rotation numbers, each a continued fraction with ones after its end; without them one on
    either side of the last curve that `between` shows"""
    convergents: whole(2, 20)
    """how many convergents of each"""
    between: Between
    """the part of y = 0 on which their orbits are sought"""
    impacts: whole(100, LARGEST)
    """impacts of the orbit at the last convergent"""
    drawn: whole(100, LARGEST)
    """how many of these are drawn"""

    @classmethod
    def cross_field_errors(cls, block):
        """Orbits that can be followed, and drawn, from two places."""
        cross_field_errors = [*super().cross_field_errors(block)]
        yield from cross_field_errors
        if not cross_field_errors:
            yield from not_elliptic(block, "energy")
        one, other = block["between"]
        if one == other:
            yield ("between",), block["between"], "two fractions that differ"
        nobles = block.get("nobles", [[1], [1]])
        for i, noble in enumerate(nobles):
            before, period = 0, 1
            for quotient in noble[1:] + [1] * (block["convergents"] - 1):
                before, period = period, before + quotient * period
            if not 0 < period <= LARGEST:
                what = f"one whose last convergent has a period from 1 to {LARGEST}, not {period}"
                yield ("nobles", i), noble, what
        if block["drawn"] * len(nobles) > LARGEST:
            what = f"at most {LARGEST} points drawn, counted over all nobles"
            yield ("drawn",), block["drawn"], what

    @staticmethod
    def numbers(block, last_curve):
        """The residue of the last convergent of either number, and its period."""
        last = last_curve.isel(convergent=-1)
        return {"last residues": listing(last, "{:.2g} at period {:.0f}", "residue", "period")}
