"""The section with proved invariant curves."""

from typing import Annotated

from ..fields import Number, YamlMapping, allowed
from ..scene import Dataset, OfChaoticOrbits


class Curves(OfChaoticOrbits):
    """proved invariant curves on the section"""

    stages = ("curves", "orbits")
    headline = "proved share"

    rotation_numbers: Annotated[
        list[Annotated[Number, allowed("above 0, below 1", gt=0, lt=1)]],
        allowed("a list of numbers between 0 and 1", min_length=1, max_length=10),
    ]
    """Rotation numbers of the curves around the fixed point, in clockwise turns per impact. Each
    curve has a number close to the given one. Proved curves around longer orbits at the scene's
    energy are added."""

    @staticmethod
    def numbers(block: YamlMapping, curves: Dataset, orbits: Dataset) -> dict[str, str]:
        """Give the share of the section inside the largest curve and those around long orbits."""
        share, period = curves["share"].values, curves["period"].values
        total = float(share[period == 1].max() + (share * period)[period > 1].sum())
        return {"proved share": f"{total:.4f} of the section"}
