"""Orbits on the energy surface: Figures 2 and 8 of the paper."""

from ..fields import LARGEST, distinct, listed, whole
from ..scene import OfOrbits, OnSurface, measured_energy

PLACES = "a list of places in starts, counted from 0, none of them twice"


class Portrait(OnSurface, OfOrbits):
    """orbits on the energy surface

    {{ s.starts|length }} orbits of {{ s.impacts|sum if s.impacts is iterable else s.impacts *
    s.starts|length }} impacts in all, at energy {{ s.energy }} for k = {{ s.ball.k }}, g = {{
    s.ball.g }}: position x (downwards), velocity and strain rate just before each impact. They
    lie on one half of an ellipsoid, the surface of this energy, which ends at the rim where impacts
    graze. The surface is opaque: points on its far side are not drawn.

    What to see: closed curves, one colour an orbit, are regular motion. Those around one point
    belong to the elliptic fixed point, chains of small ones to elliptic orbits of a longer
    period. Grey points are one orbit that wanders over an area: chaos.
    """

    stages = ("orbits",)
    headline = "impacts"
    studied = "portrait"
    example = """
    ball: {k: 0.3333333333333333, g: 0.02}
    energy: 0.01
    starts: [-0.3, {x: 0.1, y: 0.02}, 0.7]
    impacts: [200, 200, 2000]
    sea: [2]
    """

    sea: listed(whole(0, LARGEST), PLACES, 0, None, distinct) = []
    """which orbits are chaotic, drawn in grey"""

    @classmethod
    def cross_field_errors(cls, block):
        """Places in `sea` are places in `starts`."""
        yield from super().cross_field_errors(block)
        last = len(block["starts"]) - 1
        for place in block["sea"]:
            if place > last:
                yield ("sea",), place, f"a place in starts, from 0 to {last}"

    @staticmethod
    def numbers(block, orbits):
        """How many orbits and impacts, their energy, and how near they come to grazing."""
        speed = float((orbits["xdot"] + orbits["udot"]).min())
        return {
            "orbits": f"{orbits.sizes['orbit']:,}",
            "impacts": f"{orbits.sizes['point']:,}",
            **measured_energy(block, orbits),
            "least speed of contact": f"{speed:.2g}",
            "x": f"{float(orbits['x'].min()):.4f} to {float(orbits['x'].max()):.4f}",
        }
