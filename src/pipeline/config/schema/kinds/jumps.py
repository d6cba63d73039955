"""The curves where the map jumps."""

from ..fields import Energies, YamlMapping, whole
from ..scene import Dataset, OfChaoticOrbits, listing


class Jumps(OfChaoticOrbits):
    """the curves where the map and its inverse jump"""

    stages = ("jumps", "orbits")
    headline = "jump curve"

    energies: Energies
    """Further energies, in m omega^2 R^2, whose curves are drawn below the section."""
    sides: int = whole(4, 100_000, 4)
    """Number of straight sides of which each curve is drawn. Its length is measured with this
    number, half of it and a quarter of it, which gives the error of the length."""

    @staticmethod
    def numbers(block: YamlMapping, jumps: Dataset, orbits: Dataset) -> dict[str, str]:
        """Give the length of the curve in (x, y) at each energy."""
        return {"jump curve": "length " + listing(jumps, "{:.4f} at E = {:g}", "length", "energy")}
