"""Stage behind the picture of a graph through the sea; its data are doubles."""

import numpy as np
import xarray as xr
from flint import ctx

from ...dynamics.ball import Ball
from ...dynamics.variables import LENGTH, SPEED
from ..checks import graph
from .tables import corners, dataset, surface_of, theorems_at


def scene_graph(ball: Ball, energy: float) -> xr.Dataset:
    """Prove the graph of coverings that is a theorem at a ball and energy, and tabulate its sets.

    The sets that connections join come first, then those of the connections' chains. ValueError is
    raised if no theorem states a graph at this ball and energy.

    >>> from pseudorigid import Ball
    >>> scene_graph(Ball(k=0.2, g=0.04), 0.005).sizes["connection"]
    4
    """
    surface = surface_of(ball, energy)
    here = theorems_at(surface, graph.check)
    if not here:
        raise ValueError(f"no graph is a theorem at {surface}")
    proved = here[0].prove(here[0].text())
    sets, connections = proved.parts["graph"].sets, proved.parts["graph"].connections
    chains = [(n, hset) for n, it in enumerate(connections) for hset in it.chain]
    owner = [-1] * len(sets) + [n for n, _ in chains]
    with ctx.workprec(graph.BITS):
        corner_x, corner_y = corners([*sets, *(hset for _, hset in chains)])
        entropy = float(proved.digits["entropy"].lower())
        radius = float(surface.radius())
    source, target, impacts = np.array([(it.source, it.target, it.impacts) for it in connections]).T
    corner = ("set", "corner")
    table = {
        "corner_x": (corner, corner_x, "corners of the set, x", LENGTH),
        "corner_y": (corner, corner_y, "corners of the set, y = xdot - k udot", SPEED),
        "connection": ("set", np.array(owner), "connection of the set's chain; -1 at the ends"),
        "source": ("connection", source, "set that the connection leaves"),
        "target": ("connection", target, "set to which the connection leads"),
        "impacts": ("connection", impacts, "number of impacts of the connection"),
        "entropy": ((), entropy, "proved lower bound of the entropy, in nats per impact"),
        "radius": ((), radius, "half of the section's width on y = 0", LENGTH),
    }
    return dataset(table, surface)
