"""The last invariant curve of the main island."""

from collections.abc import Iterator
from typing import Annotated

from ..fields import ABSENT, LARGEST, Between, YamlMapping, allowed, whole
from ..scene import CrossFieldError, Dataset, Scene, listing, not_elliptic


class LastCurve(Scene):
    """residues of the convergents of noble rotation numbers"""

    stages = ("last_curve",)
    headline = "last residues"

    nobles: list[
        Annotated[
            list[Annotated[int, whole(0, 1000)]], allowed("a continued fraction", min_length=1)
        ]
    ] = allowed("a list of 1 to 8 continued fractions", default=ABSENT, min_length=1, max_length=8)
    """Noble rotation numbers, in turns per impact, each as the first quotients of its continued
    fraction: [0, 5, 1, 15] is 1/(5 + 1/(1 + 1/(15 + ...))), with ones from there on. Without this
    field one number on either side of the last curve within `between` is chosen."""
    convergents: int = whole(2, 20)
    """Number of convergents of each rotation number whose periodic orbits are found. Each further
    convergent has a period about 1.6 times as long."""
    between: Between
    """Part of the symmetry line y = 0 in which the orbits are sought, in section radii from the
    section's centre. The end nearer to the fixed point comes first."""
    impacts: int = whole(100, LARGEST)
    """Number of impacts of the orbit that starts at the last convergent's periodic point. It shows
    whether a curve confines the orbit."""
    drawn: int = whole(100, LARGEST)
    """Number of these impacts that are drawn."""

    @classmethod
    def cross_field_errors(cls, block: YamlMapping) -> Iterator[CrossFieldError]:
        """Check that the orbits can be computed and drawn."""
        yield from super().cross_field_errors(block)
        yield from not_elliptic(block, "energy")
        start, end = block["between"]
        if start == end:
            yield ("between",), block["between"], "two fractions that differ"
        nobles = block.get("nobles", [[1], [1]])
        for i, noble in enumerate(nobles):
            before, period = 0, 1
            for quotient in noble[1:] + [1] * (block["convergents"] - 1):
                before, period = period, before + quotient * period
            if not 0 < period <= LARGEST:
                words = f"one whose last convergent has a period from 1 to {LARGEST}, not {period}"
                yield ("nobles", i), noble, words
        if block["drawn"] * len(nobles) > LARGEST:
            words = f"at most {LARGEST} points drawn, counted over all nobles"
            yield ("drawn",), block["drawn"], words

    @staticmethod
    def numbers(block: YamlMapping, last_curve: Dataset) -> dict[str, str]:
        """Give the residue of each number's last convergent, and its period."""
        last = last_curve.isel(convergent=-1)
        return {"last residues": listing(last, "{:.2g} at period {:.0f}", "residue", "period")}
