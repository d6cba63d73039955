"""The sets of a proved horseshoe along a connection, and one covering relation."""

from typing import Annotated, Literal

from ..fields import ABSENT, Axis, YamlMapping, allowed
from ..scene import Dataset, OfBranches


class Horseshoe(OfBranches):
    """the sets of a proved horseshoe along a connection of the orbit"""

    stages = ("manifolds", "horseshoe")
    axes_depend_on = ("period", "type", "branches", "connection")
    headline = "sets"

    connection: Annotated[Literal["outer", "inner"], allowed("outer or inner")]
    """Side of the branches along which the orbit is connected with itself, and along which the sets
    of the horseshoe lie. The branches of this side should be among `branches`."""
    type: Annotated[Literal["hyperbolic"], allowed("hyperbolic")]
    """Stability of the periodic orbit. Horseshoes are proved on hyperbolic orbits only."""
    axes: dict[Literal["x", "y", "p", "q"], Axis] = ABSENT
    """Limits and ticks of the axes `x` (position, R) and `y` = xdot - k udot (omega R) above, and
    of `p` and `q`, the coordinates of the middle set, below. An axis that is left out has limits
    that hold its data."""

    @staticmethod
    def numbers(
        block: YamlMapping, periodic: Dataset, manifolds: Dataset, horseshoe: Dataset
    ) -> dict[str, str]:
        """Describe the orbit, and count the sets."""
        return Horseshoe.about_orbit(periodic, block) | {"sets": f"{horseshoe.sizes['set']}"}
