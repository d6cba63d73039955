"""Clusters of impacts in the sea, and what they remember."""

from ..fields import Between, listed, real, whole
from ..scene import Scene


class Clusters(Scene):
    """clusters of impacts and their memory

    Flight times of {{ s.orbits }} orbits in the chaotic sea at energy {{ s.energy }} for k = {{
    s.ball.k }}, g = {{ s.ball.g }}, and correlations from one cluster of impacts to later ones,
    for clusters cut at flights longer than {{ s.cuts|join(", ") }}.

    What to see: where a cluster starts says something about where the next one starts, whatever
    the cut.
    """

    stages = ("clusters",)
    telling = "clusters"

    between: Between
    """the part of y = 0 on which orbits start"""
    orbits: whole(2, 100_000)
    """how many orbits"""
    impacts: whole(100, 10_000_000)
    """impacts of each orbit"""
    cuts: listed(real("a time above 0", gt=0), "a list of times")
    """a longer flight parts two clusters; an analysis for each"""
    lags: whole(1, 100)
    """up to how many clusters later correlations are computed"""
    resamples: whole(10, 100_000)
    """resamplings of the orbits behind each interval"""
    seed: whole(0, 2**31)
    """of the resampling"""

    @staticmethod
    def numbers(block, clusters):
        """How many cuts."""
        return {"clusters": f"cut at {len(block['cuts'])} times"}
