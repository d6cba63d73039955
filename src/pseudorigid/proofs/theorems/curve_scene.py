"""Stage behind the picture of proved invariant curves; its data are doubles."""

import numpy as np
import xarray as xr

from ...dynamics.ball import Ball
from ...dynamics.variables import AREA, LENGTH, SPEED, described
from ..checks import curve
from ..checks.certificate import Finding
from ..enclosure.surface import Surface
from .requests import prove_curve
from .statements import THEOREMS


def scene_curves(ball: Ball, energy: float, rotation_numbers: list[float]) -> xr.Dataset:
    """Prove invariant curves around the fixed point, and tabulate polygons inside them.

    A curve around the fixed point that is a theorem at this ball and energy is proved from its
    certificate, if its rotation number is stated to be close to one of the list; others are
    searched. Theorems about curves around longer orbits at this ball and energy are added.

    Parameters
    ----------
    ball : Ball
    energy : float
        This, k and g are taken as the decimals that they print as.
    rotation_numbers : list of float
        Clockwise turns per impact, each between 0 and 1.

    Returns
    -------
    xarray.Dataset
        x, y (corner): the corners of polygons inside the curves, one after the other, and place
        (corner), the curve's place in the list; rotation, share, area, period (curve);
        radius, half of the section's width.

    Raises
    ------
    ValueError
        A curve cannot be proved.

    References
    ----------
    Kanso and Papadopoulos, section 4.2: quasi-periodic trajectories bound the chaotic ones.

    Examples
    --------
    >>> from pseudorigid import Ball
    >>> scene_curves(Ball(k=0.2, g=0.04), 0.01, [0.17295]).sizes["curve"]  # doctest: +SKIP
    2
    """
    surface = Surface(*(str(value) for value in (ball.k, ball.g, energy)))
    here = [
        theorem
        for theorem in THEOREMS.values()
        if theorem.checker is curve.check and theorem.bounds["surface"] == surface
    ]
    findings = [_near(surface, value, here) for value in rotation_numbers]
    findings += [it.prove(it.text()) for it in here if it.bounds["period"] > 1]
    corners = [
        (x, y, place)
        for place, finding in enumerate(findings)
        for polygon in finding.parts["polygons"]
        for x, y in [*polygon, polygon[0], (np.nan, np.nan)]
    ]
    columns = np.array(corners).T
    digits = {name: [float(finding.digits[name]) for finding in findings]
              for name in ("rotation number", "share", "area")}  # fmt: skip
    data = {
        "x": ("corner", columns[0], "corners of the polygons, x; NaN after each", LENGTH),
        "y": ("corner", columns[1], "corners of the polygons, y; NaN after each", SPEED),
        "place": ("corner", columns[2].astype(np.int64), "place of the corner's curve"),
        "rotation": ("curve", digits["rotation number"], "clockwise turns per period"),
        "share": ("curve", digits["share"], "area inside one curve, as a share of the section"),
        "area": ("curve", digits["area"], "area inside one curve", AREA),
        "period": ("curve", [len(it.parts["polygons"]) for it in findings], "period of the orbit"),
    }

    data["radius"] = (), float(surface.radius()), "half of the section's width on y = 0", LENGTH
    attrs = {"k": float(surface.k), "g": float(surface.g)}
    return xr.Dataset(described(data), attrs=attrs)


def _near(surface: Surface, value: float, theorems: list) -> Finding:
    """Prove a curve with about this rotation number, from a theorem's certificate if there is."""
    for theorem in theorems:
        low, high = theorem.bounds["rotation"]
        if theorem.bounds["period"] == 1 and low <= value <= high:
            return theorem.prove(theorem.text())
    return prove_curve(surface, surface.energy, value)[1]
