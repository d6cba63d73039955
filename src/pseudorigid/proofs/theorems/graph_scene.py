"""Stage behind the picture of a graph through the sea; its data are doubles."""

import numpy as np
import xarray as xr
from flint import arb, ctx

from ...dynamics.ball import Ball
from ...dynamics.variables import LENGTH, SPEED, described
from ..checks import graph
from ..enclosure.surface import Surface
from .statements import THEOREMS

_CORNERS = (1, 1), (1, -1), (-1, -1), (-1, 1)


def scene_graph(ball: Ball, energy: float) -> xr.Dataset:
    """Prove the graph of coverings that is a theorem at a ball and energy, and tabulate its sets.

    Parameters
    ----------
    ball : Ball
    energy : float
        This, k and g are taken as the decimals that they print as.

    Returns
    -------
    xarray.Dataset
        corner_x, corner_y (set, corner): around each set; connection (set): the connection on whose
        chain it lies, -1 for the sets that connections join, which come first; source, target,
        impacts (connection); entropy, the proved lower bound; radius, half of the section's width.

    Raises
    ------
    ValueError
        No theorem states a graph at this ball and energy, or its certificate does not prove it.

    References
    ----------
    Lind and Marcus, An Introduction to Symbolic Dynamics and Coding, section 4.1.

    Examples
    --------
    >>> from pseudorigid import Ball
    >>> scene_graph(Ball(k=0.2, g=0.04), 0.005).sizes["connection"]
    4
    """
    surface = Surface(*(str(value) for value in (ball.k, ball.g, energy)))
    here = [
        theorem
        for theorem in THEOREMS.values()
        if theorem.checker is graph.check and theorem.bounds["surface"] == surface
    ]
    if not here:
        raise ValueError(f"no graph is a theorem at {surface}")
    result = here[0].prove(here[0].text())
    found = result.parts["graph"]
    sets = [*found.sets, *(hset for it in found.connections for hset in it.chain)]
    owner = [-1] * len(found.sets)
    owner += [n for n, it in enumerate(found.connections) for _ in it.chain]
    with ctx.workprec(graph.BITS):
        corners = [[hset.box(arb(p), arb(q)) for p, q in _CORNERS] for hset in sets]
        corners = np.array(corners, dtype=object).astype(float)
        entropy = float(result.digits["entropy"].lower())
        radius = float(surface.radius())
    links = np.array([(it.source, it.target, it.impacts) for it in found.connections])
    corner = ("set", "corner")
    data = {
        "corner_x": (corner, corners[:, :, 0], "corners of the set, x", LENGTH),
        "corner_y": (corner, corners[:, :, 1], "corners of the set, y = xdot - k udot", SPEED),
        "connection": ("set", np.array(owner), "connection of the set's chain; -1 at the ends"),
        "source": ("connection", links[:, 0], "set that the connection leaves"),
        "target": ("connection", links[:, 1], "set to which the connection leads"),
        "impacts": ("connection", links[:, 2], "number of impacts of the connection"),
        "entropy": ((), entropy, "proved lower bound of the entropy, in nats per impact"),
        "radius": ((), radius, "half of the section's width on y = 0", LENGTH),
    }
    attrs = {"k": float(surface.k), "g": float(surface.g)}
    return xr.Dataset(described(data), attrs=attrs)
