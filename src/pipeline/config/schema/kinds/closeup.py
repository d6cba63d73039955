"""Stable and unstable manifolds near one saddle: Figure 6 of the paper."""

import math
from collections.abc import Iterator
from typing import Literal

from ..fields import ABSENT, Axis, Window, YamlMapping, allowed, whole
from ..scene import CrossFieldError, Dataset, OfManifolds, beyond


class Closeup(OfManifolds):
    """manifolds in a window around one point"""

    stages = ("manifolds",)
    axes_depend_on = ("period", "type", "point", "window")
    headline = "x of the point"
    studied = "closeup"

    point: int = whole(0, 11)
    """Point that the window surrounds, from 0 to period - 1, in the order of dataset `periodic`."""
    window: Window
    """Part of the section that is drawn, relative to the point."""
    length: float = allowed("a number above 0, in section radii", gt=0)
    """Arc length along which the branches of all points of the orbit are traced, in section radii.
    Longer branches bring more lines into the window."""
    axes: dict[Literal["x", "xdot"], Axis] = ABSENT
    """Limits and ticks of the axes `x` (position, R) and `xdot` (velocity, omega R). An axis that
    is left out has the limits of the window."""

    @classmethod
    def cross_field_errors(cls, block: YamlMapping) -> Iterator[CrossFieldError]:
        """Check that the orbit has such a point."""
        yield from super().cross_field_errors(block)
        last = block["period"] - 1
        if block["point"] > last:
            yield ("point",), block["point"], f"a whole number from 0 to period - 1 = {last}"

    @classmethod
    def hidden(cls, block: YamlMapping) -> Iterator[str]:
        """Yield a line for each side of the window that is longer than its axis."""
        k, g, energy = block["ball"]["k"], block["ball"]["g"], block["energy"]
        radius = math.sqrt((2 * energy + g * g / k) / k)
        for name, axis in block.get("axes", {}).items():
            (low, high), (left, right) = block["window"][name], axis["limits"]
            if radius * (high - low) > 1.001 * (right - left):  # limits are rounded
                yield f"window.{name} {[low, high]} is wider than {beyond(name, axis['limits'])}"

    @staticmethod
    def numbers(block: YamlMapping, periodic: Dataset, manifolds: Dataset) -> dict[str, str]:
        """Describe the orbit, the window and the point."""
        quantities, attributes = Closeup.about_orbit(periodic, block), manifolds.attrs
        for name in ("x", "xdot"):
            ends = attributes[f"window_{name}"]
            quantities[f"window, {name}"] = "{:.7g} to {:.7g}".format(*ends)
        for name in ("x", "xdot"):
            quantities[f"{name} of the point"] = f"{attributes[f'point_{name}']:.7f}"
        return quantities
