"""Clusters of impacts in the sea, and what they remember."""

from ..fields import Between, listed, real, whole
from ..scene import Scene, bounded, listing

LONGEST = 1_000_000  # flight: their histogram has ten bins a unit of time


class Clusters(Scene):
    """clusters of impacts and their memory

    Flight times of {{ s.orbits }} orbits in the chaotic sea at energy {{ s.energy }} for k = {{
    s.ball.k }}, g = {{ s.ball.g }}; and what one cluster of impacts says of later ones, for
    clusters cut at flights longer than {{ s.cuts|join(", ") }}: correlation of the first state's y
    = xdot - k udot with that of a later cluster, the same of x, and the share of the variance of y,
    and of x, that the cell explains in which the earlier cluster starts. Lines above and below a
    mark are 95 % intervals by a bootstrap over whole orbits.

    What to see: where a cluster starts says something about where the next one starts, whatever
    the cut.
    """

    stages = ("clusters",)
    headline = "time between clusters"
    example = """
    ball: {k: 0.3333333333333333, g: 0.02}
    energy: 0.05
    between: [0.55, 0.68]
    orbits: 16
    impacts: 2000
    cuts: [15, 20]
    lags: 2
    resamples: 50
    seed: 1
    """

    between: Between
    """the part of y = 0 on which orbits start"""
    orbits: whole(2, 100_000)
    """how many orbits"""
    impacts: whole(100, 10_000_000)
    """impacts of each orbit"""
    cuts: listed(real("a time above 0", gt=0), "a list of 1 to 7 times", 1, 7)
    """a longer flight parts two clusters; an analysis for each"""
    lags: whole(1, 100)
    """up to how many clusters later correlations are computed"""
    resamples: whole(10, 100_000)
    """resamplings of the orbits behind each interval"""
    seed: whole(0, 2**31)
    """of the resampling"""

    @classmethod
    def cross_field_errors(cls, block):
        """What is held at once: every impact, and every sample of the bootstrap."""
        cross_field_errors = [*super().cross_field_errors(block)]
        yield from cross_field_errors
        yield from bounded(block, "orbits", "impacts", "impacts in all")
        yield from bounded(block, "orbits", "resamples", "orbits drawn")
        (k, g), energy = (block["ball"][n] for n in "kg"), block["energy"]
        if not cross_field_errors and 4 * (2 * energy + g * g / k) > (LONGEST * g) ** 2:
            longest = 2 * (2 * energy + g * g / k) ** 0.5 / g
            what = f"one with flights of at most {LONGEST} at this energy (here {longest:.3g})"
            yield ("ball", "g"), g, what

    @staticmethod
    def numbers(block, clusters):
        """The mean time from one cluster to the next, for each cut."""
        return {"time between clusters": listing(clusters, "{:.2f} cut at {:g}", "period", "cut")}
