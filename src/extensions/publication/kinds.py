"""Kinds of picture of the model itself: Figure 1, and the ball in motion."""

from collections.abc import Iterator
from typing import Annotated, Literal

from annotated_types import Predicate

from paper.groups import OfOrbits, OfPeriodicOrbit
from pipeline.config.schema.fields import allowed, whole
from pipeline.config.schema.scene import CrossFieldError


class Model(OfPeriodicOrbit):
    """the ball at rest, between two impacts and at one"""

    stages = ("motion",)
    on_section = False
    headline = "between impacts"

    duration: float = allowed("a number with 0 < duration <= 10000", gt=0, le=10_000)
    """Time from the impact that is drawn to the state between impacts that is drawn, in 1/omega."""


class Animation(OfOrbits):
    """a bouncing ball, and its impacts on the section, as a moving picture"""

    stages = ("orbits", "frames")
    on_section = False
    headline = "frames"

    frames: list[Annotated[int, whole(2, 200)]] = allowed(
        "a list of whole numbers from 2 to 200, one for each start", min_length=1
    )
    """Number of frames of each orbit. A frame is shown for 0.08 s. An orbit begins in slow motion
    and is shown faster and faster up to its last impact."""
    formats: Annotated[
        list[Literal["png", "gif"]],
        allowed("[png, gif] or [png]"),
        Predicate(lambda given: given in (["png"], ["png", "gif"])),
    ] = ["png", "gif"]  # type: ignore[assignment]
    """File formats of the picture: gif moves, and png is its last frame."""

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Check that there is one number of frames for each start."""
        yield from super().cross_field_errors()
        if len(self.frames) != len(self.starts):
            words = f"one number for each of the {len(self.starts)} starts"
            yield ("frames",), self.frames, words
