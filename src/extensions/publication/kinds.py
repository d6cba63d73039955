"""The kind of picture of the model itself: Figure 1."""

from paper.groups import OfPeriodicOrbit
from pipeline.config.schema.fields import allowed


class Model(OfPeriodicOrbit):
    """the ball at rest, between two impacts and at one"""

    stages = ("motion",)
    on_section = False
    headline = "between impacts"

    duration: float = allowed("a number with 0 < duration <= 10000", gt=0, le=10_000)
    """Time from the impact that is drawn to the state between impacts that is drawn, in 1/omega."""
