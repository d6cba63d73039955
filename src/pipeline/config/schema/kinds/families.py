"""Families of periodic orbits against the energy or the inertia."""

from collections import Counter
from collections.abc import Iterator
from typing import Literal

from ..fields import Range, YamlMapping, allowed, whole
from ..scene import CrossFieldError, Dataset, Scene, exact, is_sound

MOST_CELLS = 2_000  # of the regular share


class Families(Scene):
    """families of periodic orbits, below the regular share of the section"""

    stages = ("families", "shares")
    headline = "families"

    parameter: Literal["energy", "k"] = allowed("energy or k", default="energy")
    """What orbits are followed against: the energy of the ball, or its inertia k at the scene's
    E/g^2."""
    span: Range
    """Least and largest value of the parameter. Families are followed between them."""
    period: int = whole(1, 24)
    """Largest period of the orbits. There are about twice as many orbits for each further
    period."""
    levels: int = whole(1, 10_000)
    """Number of values of the parameter, evenly in the radius of the section, at which brute force
    seeks orbits that no family holds yet. A family that lives between two of them is found if it
    branches off from another one."""
    drawn: int = whole(1, 24)
    """Largest period that is drawn. More than a hundred families in one panel cannot be told
    apart."""
    step: float = allowed("a positive number", gt=0)
    """Distance in the parameter between two values of the regular share; these are multiples of
    it."""
    starts: int = whole(1, 1_000_000)
    """Number of orbits behind each value of the regular share, evenly over half of the section."""
    impacts: int = whole(100, 10_000_000)
    """Largest number of impacts of these orbits."""

    @classmethod
    def cross_field_errors(cls, block: YamlMapping) -> Iterator[CrossFieldError]:
        """Check that the section exists over the whole span."""
        yield from super().cross_field_errors(block)
        if not is_sound(block):
            return
        k, g, energy = (exact(v) for v in (block["ball"]["k"], block["ball"]["g"], block["energy"]))
        low, high = (exact(value) for value in block["span"])
        if block["parameter"] == "energy":
            lowest, highest = -g * g / (2 * k), k / 2 - g
            if not lowest < low:
                yield ("span",), block["span"], f"numbers above -g^2/(2k) = {float(lowest)}"
            if not high < highest:
                yield ("span",), block["span"], f"numbers below k/2 - g = {float(highest)}"
        elif not (low > 0 and high <= 1 and 1 + 2 * high * energy / (g * g) > 0):
            yield ("span",), block["span"], "numbers with 0 < k <= 1 and energy > -g^2/(2k)"
        if (high - low) / exact(block["step"]) > MOST_CELLS:
            least = float((high - low) / MOST_CELLS)
            yield ("step",), block["step"], f"at least {least:g}, {MOST_CELLS} values in the span"
        if block["drawn"] > block["period"]:
            yield ("drawn",), block["drawn"], f"at most period = {block['period']}"

    @staticmethod
    def numbers(block: YamlMapping, families: Dataset, shares: Dataset) -> dict[str, str]:
        """Give the number of families and events, and the fixed point's resonances."""
        lines = families["line"].values.tolist()
        kinds = Counter(families["event_kind"].values.tolist())
        events = [f"{n} {'p/q' if k == 'resonance' else k}" for k, n in sorted(kinds.items())]
        chosen = (families["event_family"].values == 0) & (families["event_order"].values > 2)
        names = f"event_{block['parameter']}", "event_turns", "event_order"
        resonances = zip(*(families[name].values[chosen].tolist() for name in names), strict=True)
        places = [f"{p}/{q} at {value:.12g}" for value, p, q in sorted(resonances)]
        return {
            "families": f"{len(lines)}, {lines.count('none')} of them without symmetry",
            "events": ", ".join(events) or "none",
            "fixed point": ", ".join(places) or "none",
        }
