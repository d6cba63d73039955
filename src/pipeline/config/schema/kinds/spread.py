"""Exponents of many orbits, at many lengths."""

from ..fields import Fraction, listed, whole
from ..scene import OfRecords


class Spread(OfRecords):
    """Lyapunov exponents of many orbits at many lengths

    Lyapunov exponents of the chaotic ones among {{ s.orbits }} orbits of {{ s.length }} impacts
    that start uniformly over the section, at energy {{ s.energy }} for k = {{ s.ball.k }}, g = {{
    s.ball.g }}: range, quartiles and mean over all stretches of a length; the distribution of runs
    as long as Figure 7's, with its three and the paper's number; exponents of regular orbits beside
    ln n/n.

    What to see: single runs scatter about the long-run value, and the paper's number is one such.
    """

    stages = ("spread", "lyapunov")
    headline = "long-run exponent"
    example = """
    ball: {k: 0.3333333333333333, g: 0.02}
    energy: 0.05
    orbits: 8
    length: 2000
    blocks: 20
    regular: [-0.05]
    regular_impacts: 1024
    cells: 10
    visits: 1000
    starts: [0.3, 0.5]
    impacts: 500
    records: 20
    """

    orbits: whole(2, 1000)
    """how many orbits start uniformly over the section"""
    length: whole(100, 100_000_000)
    """impacts of each of them"""
    blocks: whole(2, 10_000)
    """stretches into which each is cut"""
    regular: listed(Fraction, "a list of fractions")
    """starts of regular orbits"""
    regular_impacts: whole(16, 10_000_000)
    """impacts of each of them"""
    cells: whole(2, 1000)
    """cells to a side of the grid over the section"""
    visits: whole(2, 100_000_000)
    """impacts counted in those cells"""

    @classmethod
    def cross_field_errors(cls, block):
        """Blocks fit the length."""
        yield from super().cross_field_errors(block)
        if block["length"] % block["blocks"]:
            yield ("blocks",), block["blocks"], f"a divisor of length = {block['length']}"

    @staticmethod
    def numbers(block, spread, lyapunov):
        """The mean over all chaotic orbits."""
        from pseudorigid.analyses.spread import in_sea

        largest = spread["exponent"].values[:, in_sea(spread)].mean(axis=0).max(axis=-1)
        error = largest.std(ddof=1) / largest.size**0.5
        return {"long-run exponent": f"{largest.mean():.5f} \N{PLUS-MINUS SIGN} {error:.5f}"}
