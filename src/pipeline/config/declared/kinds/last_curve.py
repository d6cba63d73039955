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
    telling = "last residues"

    nobles: listed(listed(whole(0, 1000), "a continued fraction"), "a list of continued fractions")
    convergents: whole(2, 20)
    between: Between
    impacts: whole(100, 100_000_000)
    drawn: whole(100, 10_000_000)

    @staticmethod
    def numbers(block, last_curve):
        """The residue of the last convergent of either number, and its period."""
        ends = (last_curve[name].values[:, -1] for name in ("residue", "period"))
        found = (f"{residue:.2g} at period {n:.0f}" for residue, n in zip(*ends, strict=True))
        return {"last residues": ", ".join(found)}
