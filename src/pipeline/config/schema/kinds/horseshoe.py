"""The sets of a proved horseshoe along a connection, and one of its covering relations."""

from typing import Annotated, Literal

from pydantic import Field

from ..fields import axes_of
from ..scene import OfBranches

Side = Annotated[Literal["outer", "inner"], Field(description="outer or inner")]


class Horseshoe(OfBranches):
    """the sets of a proved horseshoe along a connection of the orbit

    The sets that prove a horseshoe on the {{ s.type }} orbit of period {{ s.period }} by its {{
    s.connection }} connection, at energy {{ s.energy }} for k = {{ s.ball.k }}, g = {{ s.ball.g
    }}; dots, far larger than the sets. Above, over the manifolds (pale lines: stable green,
    unstable blue): at the saddles (red) and along the connection, on the way out to the middle set
    (black) and back from it. Below: the middle set as a square, and across it the image of the set
    before it.

    What to see: the image crosses the square from side to side, its heavy ends lie beyond, and it
    touches neither top nor bottom. Each set covers the next in that way.
    """

    stages = ("manifolds", "horseshoe")
    axes_depend_on = ("period", "type", "branches", "connection")
    headline = "sets"
    example = """
    ball: {k: 0.3, g: 0.02}
    energy: 0.002
    period: 5
    type: hyperbolic
    branches: {outer: {length: 0.8}}
    resolution: {distance: 0.02, bend: 20}
    connection: outer
    """

    connection: Side
    """along which branches the orbit is connected with itself"""
    type: Annotated[Literal["hyperbolic"], Field(description="hyperbolic")]
    axes: axes_of("x", "y", "p", "q") = None

    @staticmethod
    def numbers(block, periodic, manifolds, horseshoe):
        """The orbit, and how many sets there are."""
        return Horseshoe.about_orbit(periodic, block) | {"sets": f"{horseshoe.sizes['set']}"}
