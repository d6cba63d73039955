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
    telling = "time between clusters"

    between: Between
    orbits: whole(2, 100_000)
    impacts: whole(100, 10_000_000)
    cuts: listed(real("a time above 0", gt=0), "a list of times")
    lags: whole(1, 100)
    resamples: whole(10, 100_000)
    seed: whole(0, 2**31)

    @staticmethod
    def numbers(block, clusters):
        """The mean time from one cluster to the next, for each cut."""
        pairs = zip(clusters["cut"].values, clusters["period"].values, strict=True)
        return {"time between clusters": ", ".join(f"{t:.2f} cut at {cut:g}" for cut, t in pairs)}
