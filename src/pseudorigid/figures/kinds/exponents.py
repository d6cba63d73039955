"""Lyapunov exponents against the number of impacts: Figure 7 of the paper."""

import numpy as np

from ...dynamics.variables import final_exponents
from ..axes.limits import complete, of_data, refuse_empty
from ..axes.panel import Axis, Panel
from ..axes.plane import Plane
from ..canvas import style
from ..canvas.sheet import POINT

_FROM = 0.25  # of the impacts: where the inset begins
_LEAST = 170  # pixels between the first two exponents that have room for an inset


@style.pinned()
def draw(scene, lyapunov):
    """The exponents' histories, one hue an orbit, named at their ends.

    The largest ones have an inset below them, with a line at each of its ticks. It stands above its
    own part of the impacts, with the same ticks.

    Parameters
    ----------
    scene : dict
    lyapunov : xarray.Dataset
        Of that stage: exponent (impact, orbit, index) and impact.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    ValueError
        Axes that show nothing.
    """
    impact, exponent = lyapunov["impact"].values, lyapunov["exponent"].values
    greatest = exponent.max(axis=2)
    scene = complete(
        scene,
        impact=lambda: of_data([0, int(impact[-1])], room=0.0),
        exponent=lambda: of_data(exponent),
        largest=lambda: of_data(greatest[greatest.shape[0] // 2 :], most=4),
    )
    over = np.broadcast_to(impact[:, None, None], exponent.shape)
    refuse_empty(scene["axes"], {"impact": over, "exponent": exponent}, joined=True)
    picture = plane(scene)
    _, orbits, indices = exponent.shape
    ends = np.median(final_exponents(lyapunov), axis=0)
    inset = _inset(picture, scene["axes"]["largest"], *ends[:2], last=impact[-1])
    if inset:
        later = impact >= inset.across.limits[0]
        refuse_empty(scene["axes"], {"largest": greatest[later]})
    for orbit in range(orbits):
        hue = style.HUES[orbit % len(style.HUES)]
        there = ~np.isnan(exponent[:, orbit, 0])
        for index in range(indices):
            picture.line(impact[there], exponent[there, orbit, index], color=hue, lw=0.8)
        if inset:
            how = {"color": hue, "lw": 0.8, "clip": inset.frame}
            inset.line(impact[there], greatest[there, orbit], **how)
    picture.beside([(ends[index], rf"$\lambda_{index + 1}$") for index in range(indices)])
    return picture.figure


class _Inset(Panel):
    kept = (-np.inf, np.inf)
    size = 7.0


def _inset(picture, largest, first, second, last):
    """The panel between the first exponent and the second at the right.

    None without room there, or where the last impact comes before its begin.
    """
    left, _, right, _ = picture.frame
    _, (high, low) = picture.place(0.0, [first, second])
    if not high - low > _LEAST:
        return None
    start, end = picture.across.limits
    start += _FROM * (end - start)
    if last < start:
        return None
    outer = zip(picture.across.ticks, picture.across.labels, strict=True)
    shown = {tick: label for tick, label in outer if start < tick < end}
    across = Axis((start, end), [*shown], labels=[*shown.values()])
    bottom = low + (_Inset.tick + _Inset.gap + 1.6 * _Inset.size) * POINT
    frame = left + _FROM * (right - left), bottom, right, high - 0.2 * (high - low)
    return _Inset(picture.sheet, frame, across, Axis(**largest))


def plane(scene):
    """The empty picture of a scene with its axes."""
    names = ("Number of impacts", "Lyapunov exponents")
    return Plane(scene, ("impact", "exponent"), names, right=84)
