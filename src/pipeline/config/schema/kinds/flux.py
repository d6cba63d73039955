"""Lobes and the flux through them."""

from ..fields import Between, real, whole
from ..scene import Scene, bounded, listing


class Flux(Scene):
    """crossings and lobes of both branches

    Regions within the inner and the outer branches of the hyperbolic orbit of period {{ s.period
    }}, at energy {{ s.energy }} for k = {{ s.ball.k }}, g = {{ s.ball.g }}, and their lobes.

    The edge of a region is made of pieces of unstable and stable branches, which cross on y = 0
    (dots). Below, left: the stable (green) and unstable (blue) outer branches near their crossing;
    a lobe is what they enclose between two crossings. Below, right: the same of the inner branches,
    as the distance in x of the unstable branch from the stable one, which is the line at zero.

    What to see: the outer lobes are wide; the inner branches differ by less than a line's width.
    """

    stages = ("flux",)
    headline = "lobes"
    example = """
    ball: {k: 0.3333333333333333, g: 0.02}
    energy: 0.001
    period: 6
    distance: 0.01
    grid: 100
    between: [0.8, 0.9]
    orbits: 8
    impacts: 500
    """

    period: whole(2, 12, 2)
    """of the hyperbolic orbit"""
    distance: real("a number from 1e-5 to 1, in section radii", ge=1e-5, le=1)
    """between points along the branches"""
    grid: whole(10, 3000)
    """points to a side of the grid on which the flux is counted"""
    between: Between
    """the part of y = 0 on which orbits of the sea start"""
    orbits: whole(2, 100_000)
    """how many orbits of the sea"""
    impacts: whole(100, 10_000_000)
    """impacts of each of them"""

    @classmethod
    def cross_field_errors(cls, block):
        """Every impact is held."""
        yield from super().cross_field_errors(block)
        yield from bounded(block, "orbits", "impacts", "impacts in all")

    @staticmethod
    def numbers(block, flux):
        """Areas of the lobes in (x, y), or why there are none."""
        here = flux.dropna("side", subset=["area"])
        missing = {
            f"no {side} lobes": flux.attrs[f"missing_{side}"]
            for side in flux["side"].values
            if f"missing_{side}" in flux.attrs
        }
        for side in here["side"].values[here["region"].isnull().values]:
            missing[f"no {side} region"] = "a jump of the map cuts its edge"
        return {"lobes": listing(here, "{} {:.10g}", "side", "area")} | missing
