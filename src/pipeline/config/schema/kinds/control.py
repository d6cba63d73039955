"""Regular orbits with area kept, with the reversor, with both, and with neither."""

from collections.abc import Iterator
from typing import Annotated

from annotated_types import Predicate

from ..fields import LARGEST, Fraction, YamlMapping, allowed, rising, whole
from ..scene import CrossFieldError, Dataset, Scene, bounded


class Control(Scene):
    """what regular motion needs: area kept, or the reversor"""

    stages = ("control",)
    headline = "regular share"

    strengths: Annotated[
        list[Annotated[float, allowed("a number from 1e-6 to 0.5", ge=1e-6, le=0.5)]],
        allowed("a rising list of 1 to 12 strengths", min_length=1, max_length=12),
        Predicate(rising),
    ]
    """Strengths eps of the changes of the map: about the largest displacement of a point, in
    section radii. Each costs five runs of all orbits."""
    orbits: int = whole(10, 100_000)
    """Number of orbits of each map. They start evenly over the whole section. More orbits narrow
    the intervals of the shares."""
    impacts: int = whole(64, 10_000_000)
    """Number of impacts of each orbit. A spiral that changes areas by a factor of 1 - eps an impact
    is told from a curve after about 4.4/eps impacts. Shares are kept after an eighth, a quarter and
    half of these impacts too."""
    period: int = whole(2, 12)
    """Period of the elliptic orbit whose islands are followed beside the fixed point."""
    starts: list[Fraction] = allowed("a list of 1 to 50 fractions", min_length=1, max_length=50)
    """Starts of the orbits that are drawn, as fractions of the section's radius along y = 0."""
    shown: float = allowed("one of strengths", gt=0)
    """Strength at which these orbits are drawn."""
    drawn: int = whole(1, LARGEST)
    """Number of impacts of each orbit that are drawn."""
    resamples: int = whole(10, 100_000)
    """Bootstrap samples of whole orbits for each 95 % confidence interval; a few hundred do."""
    seed: int = whole(0, 2**31)
    """Random seed of the bootstrap. It decides the ends of the confidence intervals of means, and
    nothing else."""

    @classmethod
    def cross_field_errors(cls, block: YamlMapping) -> Iterator[CrossFieldError]:
        """Check that the strength shown is computed, and that all impacts fit into memory."""
        yield from super().cross_field_errors(block)
        if block["shown"] not in block["strengths"]:
            words = f"one of strengths: {', '.join(map(str, block['strengths']))}"
            yield ("shown",), block["shown"], words
        if block["drawn"] > block["impacts"]:
            yield ("drawn",), block["drawn"], f"at most impacts = {block['impacts']}"
        yield from bounded(block, "orbits", "resamples", "orbits drawn")
        points = block["impacts"] * len(block["starts"])
        if points > LARGEST:
            words = f"at most {LARGEST} impacts, counted over all starts"
            yield ("impacts",), block["impacts"], words

    @staticmethod
    def numbers(block: YamlMapping, control: Dataset) -> dict[str, str]:
        """Give the regular share of each map at the strength that is drawn."""
        share = control["class_share"].sel({"class": "regular"}).isel(length=-1)
        rows = share.sel(strength=block["shown"], method="nearest").values.tolist()
        texts = [
            f"{name} {value:.3f}"
            for name, value in zip(control["map"].values.tolist(), rows, strict=True)
        ]
        none = float(share.isel(map=0, strength=0))
        return {"regular share": f"{', '.join(texts)}; impact map {none:.3f}"}
