"""Clusters of impacts in the chaotic sea, and their memory."""

from collections.abc import Iterator
from typing import Annotated

from ..fields import YamlMapping, allowed, whole
from ..scene import CrossFieldError, Dataset, OfSea, bounded, is_sound, listing

LONGEST_FLIGHT = 1_000_000  # 1/omega: the histogram of flight times has ten bins a unit of time


class Clusters(OfSea):
    """clusters of impacts and their memory"""

    stages = ("clusters",)
    headline = "time between clusters"

    cuts: list[Annotated[float, allowed("a time above 0", gt=0)]] = allowed(
        "a list of 1 to 7 times", min_length=1, max_length=7
    )
    """Times, in 1/omega. A flight longer than a cut separates two clusters of impacts. The analysis
    is repeated for each cut, to show what depends on the choice."""
    lags: int = whole(1, 100)
    """A cluster is compared with this many later ones: the next, the next but one, and so on."""
    resamples: int = whole(10, 100_000)
    """Bootstrap samples of whole orbits for each 95 % confidence interval; a few hundred do."""
    seed: int = whole(0, 2**31)
    """Random seed of the bootstrap. The same seed gives the same confidence intervals; another one
    shifts their ends a little, and nothing else. Any number will do."""

    @classmethod
    def cross_field_errors(cls, block: YamlMapping) -> Iterator[CrossFieldError]:
        """Check that all bootstrap samples fit into memory, and that no flight is too long."""
        yield from super().cross_field_errors(block)
        yield from bounded(block, "orbits", "resamples", "orbits drawn")
        (k, g), energy = (block["ball"][n] for n in "kg"), block["energy"]
        if is_sound(block) and 4 * (2 * energy + g * g / k) > (LONGEST_FLIGHT * g) ** 2:
            longest = 2 * (2 * energy + g * g / k) ** 0.5 / g
            words = f"one with flights of at most {LONGEST_FLIGHT} at this energy"
            yield ("ball", "g"), g, f"{words} (here {longest:.3g})"

    @staticmethod
    def numbers(block: YamlMapping, clusters: Dataset) -> dict[str, str]:
        """Give the mean time from one cluster to the next, for each cut."""
        return {"time between clusters": listing(clusters, "{:.2f} cut at {:g}", "period", "cut")}
