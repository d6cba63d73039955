"""Stable and unstable manifolds on the energy surface: Figure 5 of the paper."""

from ..fields import YamlMapping
from ..scene import Dataset, OfBranches, OfOrbits, OnSurface


class Tangle(OfBranches, OfOrbits, OnSurface):
    """manifolds on the energy surface"""

    stages = ("orbits", "manifolds", "periodic")
    headline = "orbit"
    studied = "tangle"
    example = """
    ball: {k: 0.3, g: 0.02}
    energy: 0.002
    period: 5
    type: hyperbolic
    branches: {outer: {length: 0.8}, inner: {length: 0.4}}
    resolution: {distance: 0.02, bend: 20}
    starts: [-0.3, 0.1]
    impacts: 300
    """

    @staticmethod
    def numbers(
        block: YamlMapping, orbits: Dataset, periodic: Dataset, manifolds: Dataset
    ) -> dict[str, str]:
        """Describe the orbit, and count its branches and their points."""
        return Tangle.about_orbit(periodic, block) | {
            "branches": f"{manifolds.sizes['branch']:,}",
            "points of the lines": f"{manifolds.sizes['vertex']:,}",
        }
