"""Lobes of the manifolds, and the flux through them."""

from ..fields import YamlMapping, allowed, whole
from ..scene import Dataset, OfSea, listing


class Flux(OfSea):
    """crossings and lobes of both branches"""

    stages = ("flux",)
    headline = "lobes"

    period: int = whole(2, 12, 2)
    """Period of the hyperbolic orbit whose branches enclose the regions. It must be even."""
    distance: float = allowed("a number from 1e-5 to 1, in section radii", ge=1e-5, le=1)
    """Largest distance between neighbouring points of the traced branches, in section radii. It
    decides how well areas of polygons agree with the exact areas of the lobes."""
    grid: int = whole(10, 3000)
    """The flux is counted along the orbits, and over a grid of this many points to a side, in the
    rectangle around the section. The work grows with its square."""

    @staticmethod
    def numbers(block: YamlMapping, flux: Dataset) -> dict[str, str]:
        """Give the areas of the lobes in (x, y), or why there are none."""
        with_area = flux.dropna("side", subset=["area"])
        missing = {
            f"no {side} lobes": flux.attrs[f"missing_{side}"]
            for side in flux["side"].values
            if f"missing_{side}" in flux.attrs
        }
        for side in with_area["side"].values[with_area["region"].isnull().values]:
            missing[f"no {side} region"] = "a jump of the map cuts its edge"
        return {"lobes": listing(with_area, "{} {:.10g}", "side", "area")} | missing
