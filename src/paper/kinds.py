"""Kinds of picture of the paper: Figures 2 to 8."""

from collections.abc import Iterator
from typing import Literal

from paper.groups import (
    OfBranches,
    OfManifolds,
    OfOrbits,
    OfPeriodicOrbit,
    OfRecords,
    OnSurface,
    Window,
)
from pipeline.config.schema.fields import ABSENT, Axis, allowed, whole
from pipeline.config.schema.scene import CrossFieldError


class Portrait(OnSurface, OfOrbits):
    """orbits on the energy surface"""

    stages = ("orbits",)
    headline = "impacts"


class Motion(OfPeriodicOrbit):
    """a periodic motion in time"""

    stages = ("motion",)
    axes_depend_on = ("period", "type", "duration")
    headline = "orbit"

    duration: float = allowed("a number with 0 < duration <= 10000", gt=0, le=10_000)
    """Length of time that is drawn, in 1/omega, from an impact on."""
    axes: dict[Literal["t", "displacement"], Axis] = ABSENT
    """Limits and ticks of the axes `t` (time, 1/omega) and `displacement` (height, R, and
    strain)."""


class Tangle(OfBranches, OfOrbits, OnSurface):
    """manifolds on the energy surface"""

    stages = ("orbits", "manifolds", "periodic")
    headline = "orbit"


class Closeup(OfManifolds):
    """manifolds in a window around one point"""

    stages = ("manifolds",)
    axes_depend_on = ("period", "type", "point", "window")
    headline = "x of the point"

    point: int = whole(0, 11)
    """Point that the window surrounds, from 0 to period - 1, in the order of dataset `periodic`."""
    window: Window
    """Part of the section that is drawn, relative to the point."""
    length: float = allowed("a number above 0, in section radii", gt=0)
    """Arc length along which the branches of all points of the orbit are traced. Longer branches
    bring more lines into the window."""
    axes: dict[Literal["x", "xdot"], Axis] = ABSENT
    """Limits and ticks of the axes `x` (position, R) and `xdot` (velocity, omega R). An axis that
    is left out has the limits of the window."""

    def lengths(self) -> Iterator[tuple[tuple[str, ...], float]]:
        """Yield the one length of all branches."""
        yield ("length",), self.length

    def cross_field_errors(self) -> Iterator[CrossFieldError]:
        """Check that the orbit has such a point."""
        yield from super().cross_field_errors()
        last = self.period - 1
        if self.point > last:
            yield ("point",), self.point, f"a whole number from 0 to period - 1 = {last}"


class Exponents(OfRecords):
    """Lyapunov exponents against the number of impacts"""

    stages = ("lyapunov",)
    axes_depend_on = ("impacts",)
    headline = "largest exponent"

    axes: dict[Literal["impact", "exponent", "largest"], Axis] = ABSENT
    """Limits and ticks of the axes `impact` (number of impacts), `exponent` (per impact) and
    `largest` (exponents of the upper panel)."""
