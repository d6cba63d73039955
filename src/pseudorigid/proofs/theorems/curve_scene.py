"""Stage behind the picture of proved invariant curves; its data are doubles."""

import numpy as np
import xarray as xr

from ...dynamics.ball import Ball
from ...dynamics.variables import AREA, LENGTH, SPEED
from ..checks import curve
from ..checks.certificate import Finding
from ..enclosure.surface import Surface
from .requests import prove_curve
from .tables import dataset, surface_of, theorems_at


def scene_curves(ball: Ball, energy: float, rotation_numbers: list[float]) -> xr.Dataset:
    """Prove invariant curves around the fixed point, and tabulate polygons inside them.

    A curve around the fixed point that is a theorem at this ball and energy is proved from its
    certificate, if its rotation number is stated to be close to one of the list; others are
    searched. Theorems about curves around longer orbits at this ball and energy are added. The
    rotation numbers are clockwise turns per impact, between 0 and 1. ValueError is raised for a
    curve that cannot be proved.

    >>> from pseudorigid import Ball
    >>> scene_curves(Ball(k=0.2, g=0.04), 0.01, [0.17295]).sizes["curve"]  # doctest: +SKIP
    2
    """
    surface = surface_of(ball, energy)
    here = theorems_at(surface, curve.check)
    findings = [_near(surface, value, here) for value in rotation_numbers]
    findings += [it.prove(it.text()) for it in here if it.bounds["period"] > 1]
    corners = [
        (x, y, place)
        for place, finding in enumerate(findings)
        for polygon in finding.parts["polygons"]
        for x, y in [*polygon, polygon[0], (np.nan, np.nan)]
    ]
    x, y, place = np.array(corners).T
    rotation, share, area = (
        [float(finding.digits[name]) for finding in findings]
        for name in ("rotation number", "share", "area")
    )
    table = {
        "x": ("corner", x, "corners of the polygons, x; NaN after each", LENGTH),
        "y": ("corner", y, "corners of the polygons, y; NaN after each", SPEED),
        "place": ("corner", place.astype(np.int64), "place of the corner's curve"),
        "rotation": ("curve", rotation, "clockwise turns per period"),
        "share": ("curve", share, "area inside one curve, as a share of the section"),
        "area": ("curve", area, "area inside one curve", AREA),
        "period": ("curve", [len(it.parts["polygons"]) for it in findings], "period of the orbit"),
        "radius": ((), float(surface.radius()), "half of the section's width on y = 0", LENGTH),
    }
    return dataset(table, surface)


def _near(surface: Surface, value: float, theorems: list) -> Finding:
    """Prove a curve with about this rotation number, from a theorem's certificate if there is."""
    for theorem in theorems:
        low, high = theorem.bounds["rotation"]
        if theorem.bounds["period"] == 1 and low <= value <= high:
            return theorem.prove(theorem.text())
    return prove_curve(surface, surface.energy, value)[1]
