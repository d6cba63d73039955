"""Orbits on the energy surface: Figures 2 and 8 of the paper."""

from ..fields import YamlMapping
from ..scene import Dataset, OfChaoticOrbits, OnSurface, measured_energy


class Portrait(OnSurface, OfChaoticOrbits):
    """orbits on the energy surface"""

    stages = ("orbits",)
    headline = "impacts"
    studied = "portrait"

    @staticmethod
    def numbers(block: YamlMapping, orbits: Dataset) -> dict[str, str]:
        """Count orbits and impacts; give their energy and how near they come to grazing."""
        speed = float((orbits["xdot"] + orbits["udot"]).min())
        return {
            "orbits": f"{orbits.sizes['orbit']:,}",
            "impacts": f"{orbits.sizes['point']:,}",
            **measured_energy(block, orbits),
            "least speed of contact": f"{speed:.2g}",
            "x": f"{float(orbits['x'].min()):.4f} to {float(orbits['x'].max()):.4f}",
        }
