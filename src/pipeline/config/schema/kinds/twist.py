"""The fixed point's twist coefficient against the energy."""

import math
from collections.abc import Iterator
from typing import Annotated, Literal

from annotated_types import Predicate

from ..fields import ABSENT, Axis, Energy, YamlMapping, allowed, rising
from ..scene import CrossFieldError, Dataset, Scene, fixed_point_trace, is_sound, not_elliptic

RESONANT = 1e-9  # distance of a trace from one at which the multiplier is a root of unity


class Twist(Scene):
    """the fixed point's twist coefficient against the energy"""

    stages = ("twist",)
    axes_depend_on = ("energies",)
    along = {"energy": "energies"}
    headline = "zero of the twist"

    energies: Annotated[
        list[Energy],
        allowed("a list of energies in rising order", min_length=2, max_length=1000),
        Predicate(rising),
    ]
    """Energies at which the twist coefficient is computed, in m omega^2 R^2. Straight lines join
    the values."""
    marks: list[Energy] = allowed("a list of energies among those", default=[], max_length=10)
    """Energies, among `energies`, whose values are marked with a dot."""
    axes: dict[Literal["energy", "twist"], Axis] = ABSENT
    """Limits and ticks of the axes `energy` (m omega^2 R^2) and `twist` (the coefficient). An axis
    that is left out has limits that hold its data."""

    @classmethod
    def cross_field_errors(cls, block: YamlMapping) -> Iterator[CrossFieldError]:
        """Check that marks are among the energies, and that the twist exists at each of these."""
        yield from super().cross_field_errors(block)
        for mark in block["marks"]:
            if mark not in block["energies"]:
                yield ("marks",), mark, "one of energies"
        yield from not_elliptic(block, "energies")
        for i, energy in enumerate(block["energies"] if is_sound(block) else ()):
            trace = fixed_point_trace(block["ball"], energy)
            if min(abs(trace - root) for root in (-1, 0)) < RESONANT:
                words = "an energy at which no power of the multiplier up to the fourth is 1"
                yield ("energies", i), energy, words

    @staticmethod
    def numbers(block: YamlMapping, twist: Dataset) -> dict[str, str]:
        """Give the energy at which the twist vanishes."""
        zero = float(twist["zero"])
        return {"zero of the twist": "none between them" if math.isnan(zero) else f"{zero:.12f}"}
