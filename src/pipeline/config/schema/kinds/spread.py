"""Exponents of many orbits, at many lengths."""

from collections.abc import Iterator

from ..fields import Fraction, YamlMapping, allowed, whole
from ..scene import CrossFieldError, Dataset, OfRecords


class Spread(OfRecords):
    """Lyapunov exponents of many orbits at many lengths"""

    stages = ("spread", "lyapunov")
    headline = "long-run exponent"

    orbits: int = whole(2, 1000)
    """Number of long orbits. They start uniformly over the whole section, in islands as well as in
    the chaotic sea; their exponents decide which of them are chaotic."""
    length: int = whole(100, 100_000_000)
    """Number of impacts of each long orbit, a multiple of `blocks`. The error of the long-run
    exponent falls as its square root grows."""
    blocks: int = whole(2, 10_000)
    """Number of equal blocks into which a long orbit is divided. Exponents are averaged over each
    block, so that one block is the shortest run whose distribution can be drawn."""
    regular: list[Fraction] = allowed("a list of fractions", min_length=1)
    """Starts of regular orbits, as fractions of the section's radius along y = 0. Their exponents
    tend to zero and are drawn beside ln n/n."""
    regular_impacts: int = whole(16, 10_000_000)
    """Number of impacts of each regular orbit."""
    cells: int = whole(2, 1000)
    """The rectangle around the section is divided into this many cells to a side, to count which of
    them chaotic orbits enter."""
    visits: int = whole(2, 100_000_000)
    """Number of impacts of each chaotic orbit whose cells are counted."""

    @classmethod
    def cross_field_errors(cls, block: YamlMapping) -> Iterator[CrossFieldError]:
        """Check that the length is a multiple of the blocks."""
        yield from super().cross_field_errors(block)
        if block["length"] % block["blocks"]:
            yield ("blocks",), block["blocks"], f"a divisor of length = {block['length']}"

    @staticmethod
    def numbers(block: YamlMapping, spread: Dataset, lyapunov: Dataset) -> dict[str, str]:
        """Give the largest exponent's mean over all chaotic orbits, with its standard error."""
        from pseudorigid.analyses.spread import in_sea

        largest = spread["exponent"].values[:, in_sea(spread)].mean(axis=0).max(axis=-1)
        error = largest.std(ddof=1) / largest.size**0.5
        return {"long-run exponent": f"{largest.mean():.5f} \N{PLUS-MINUS SIGN} {error:.5f}"}
