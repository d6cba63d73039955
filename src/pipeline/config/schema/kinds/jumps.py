"""The curves where the map jumps."""

from ..fields import Energy, listed, whole
from ..scene import listing
from .portrait import Portrait


class Jumps(Portrait):
    """the curves where the map and its inverse jump

    The section at energy {{ s.energy }} for k = {{ s.ball.k }}, g = {{ s.ball.g }} in the chart
    (x, y): orbits, symmetry lines, the rim of grazing impacts, and the curves where the map and
    its inverse jump; below, at energies next to that where these curves are born.

    What to see: the curves lie in the sea, and shrink to a point of the rim at E = g^2 (1 + k/2).
    """

    stages = ("jumps", "orbits")
    headline = "jump curve"
    studied = None
    example = """
    ball: {k: 0.3333333333333333, g: 0.02}
    energy: 0.01
    energies: [0.0005, 0.002]
    sides: 400
    starts: [-0.3, 0.7]
    impacts: [200, 2000]
    sea: [1]
    """

    energies: listed(Energy, "a list of energies", 1, 20)
    """further energies, drawn below"""
    sides: whole(4, 100_000, 4)
    """sides of each curve as it is drawn, and measured beside half and a quarter of them"""

    @staticmethod
    def numbers(block, jumps, orbits):
        """How long the curve is in (x, y) at each energy."""
        return {"jump curve": "length " + listing(jumps, "{:.4f} at E = {:g}", "length", "energy")}
