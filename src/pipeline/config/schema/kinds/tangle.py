"""Stable and unstable manifolds on the energy surface: Figure 5 of the paper."""

from ..fields import YamlMapping
from ..scene import Dataset, OfBranches, OfOrbits, OnSurface


class Tangle(OfBranches, OfOrbits, OnSurface):
    """manifolds on the energy surface"""

    stages = ("orbits", "manifolds", "periodic")
    headline = "orbit"
    studied = "tangle"

    @staticmethod
    def numbers(
        block: YamlMapping, orbits: Dataset, periodic: Dataset, manifolds: Dataset
    ) -> dict[str, str]:
        """Describe the orbit, and count its branches and their points."""
        return Tangle.about_orbit(periodic, block) | {
            "branches": f"{manifolds.sizes['branch']:,}",
            "points of the lines": f"{manifolds.sizes['vertex']:,}",
        }
