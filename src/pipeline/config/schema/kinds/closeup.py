"""Stable and unstable manifolds near one saddle: Figure 6 of the paper."""

import math

from ..fields import Window, axes_of, real, whole
from ..scene import OfManifolds, beyond


class Closeup(OfManifolds):
    """manifolds in a window around one point

    The surroundings of one point (dot), a saddle, of the {{ s.type }} orbit of period
    {{ s.period }}, at energy {{ s.energy }} for k = {{ s.ball.k }}, g = {{ s.ball.g }}: stable
    (green) and unstable (blue) manifolds of all its points that pass here.

    What to see: branches that come from other points arrive along the dot's own and swing to and
    fro across them. Each crossing is an orbit that leaves one point and ends at another.
    """

    stages = ("manifolds",)
    axes_depend_on = ("period", "type", "point", "window")
    headline = "x of the point"
    studied = "closeup"
    example = """
    ball: {k: 0.3, g: 0.02}
    energy: 0.002
    period: 6
    type: hyperbolic
    point: 1
    window: {x: [-0.05, 0.05], xdot: [-0.05, 0.05]}
    length: 1
    resolution: {distance: 0.02, bend: 20}
    """

    point: whole(0, 11)
    """which point of the orbit"""
    window: Window
    """what is shown around the point"""
    length: real("a number above 0, in section radii", gt=0)
    """how far the branches are followed"""
    axes: axes_of("x", "xdot") = None

    @classmethod
    def lengths(cls, block):
        """How far the branches are followed."""
        return {("length",): block["length"]}

    @classmethod
    def cross_field_errors(cls, block):
        """A point of the orbit."""
        yield from super().cross_field_errors(block)
        last = block["period"] - 1
        if block["point"] > last:
            yield ("point",), block["point"], f"a whole number from 0 to period - 1 = {last}"

    @classmethod
    def hidden(cls, block):
        """Sides of the window that are longer than their axes."""
        k, g, energy = block["ball"]["k"], block["ball"]["g"], block["energy"]
        radius = math.sqrt((2 * energy + g * g / k) / k)
        for axis, drawn in block.get("axes", {}).items():
            (low, high), (left, right) = block["window"][axis], drawn["limits"]
            if radius * (high - low) > 1.001 * (right - left):  # limits are rounded
                yield f"window.{axis} {[low, high]} is wider than {beyond(axis, drawn['limits'])}"

    @staticmethod
    def numbers(block, periodic, manifolds):
        """The orbit, the point, and the window around it."""
        found, about = Closeup.about_orbit(periodic, block), manifolds.attrs
        for name in ("x", "xdot"):
            found[f"window, {name}"] = "{:.7g} to {:.7g}".format(*about[f"window_{name}"])
        for name in ("x", "xdot"):
            found[f"{name} of the point"] = f"{about[f'point_{name}']:.7f}"
        return found
