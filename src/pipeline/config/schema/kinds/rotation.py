"""Rotation number and exponent against the start."""

from ..fields import Between, Energy, listed, whole
from ..scene import Scene, listing, not_elliptic


class Rotation(Scene):
    """rotation number and exponent against the start

    Rotation number around the fixed point, and exponent, of {{ s.starts }} starts along y = 0,
    from the fixed point to the rim, at energy {{ s.energy }} for k = {{ s.ball.k }}, g = {{
    s.ball.g }}. Below: a part of these starts at higher resolution, with the rotation numbers of
    chains of islands beside their plateaus; and how far the rotation number departs from the fixed
    point's, at this energy and at {{ s.energies|join(", ") }}.

    What to see: plateaus where islands lock the rotation number, so that curves leave gaps
    between them; it is not monotone at every energy.
    """

    stages = ("rotation",)
    headline = "at the fixed point"
    example = """
    ball: {k: 0.1, g: 0.02}
    energy: 0.01
    energies: [0.001, 0.005]
    starts: 80
    impacts: 1000
    detail: [-0.3, -0.2]
    detail_impacts: 1000
    """

    energies: listed(Energy, "a list of energies", 1, 20)
    """further energies, drawn with the first"""
    starts: whole(2, 100_000)
    """how many starts from the fixed point to the rim"""
    impacts: whole(100, 10_000_000)
    """impacts of each orbit"""
    detail: Between
    """a part of y = 0 over which as many starts lie again"""
    detail_impacts: whole(100, 10_000_000)
    """impacts of each orbit there"""

    @classmethod
    def cross_field_errors(cls, block):
        """Rotation numbers are about an elliptic fixed point."""
        cross_field_errors = [*super().cross_field_errors(block)]
        yield from cross_field_errors
        if not cross_field_errors:
            yield from not_elliptic(block, "energy")
            yield from not_elliptic(block, "energies")

    @staticmethod
    def numbers(block, rotation):
        """The rotation number at the fixed point, at each energy."""
        found = listing(rotation, "{:.6f} at E = {:g}", "fixed_rotation", "energy")
        return {"at the fixed point": found}
