"""Lyapunov exponents against the number of impacts: Figure 7 of the paper."""

from functools import partial

import numpy as np

from ...dynamics.variables import final_exponents
from ..axes.limits import complete, of_data, refuse_empty
from ..axes.panel import Axis, Window
from ..axes.plane import Plane
from ..canvas import style
from ..canvas.sheet import POINT

_INSET_START = 0.25  # of the impacts
_INSET_ROOM = 170  # pixels: the least distance of the first two exponents that takes an inset
_NAMES = "Number of impacts", "Lyapunov exponents"
plane = partial(Plane, axes=("impact", "exponent"), names=_NAMES, right=84)


@style.pinned()
def draw(scene, lyapunov):
    """Draw the histories of the exponents, one hue an orbit, and the largest ones in an inset.

    The inset stands above its own impacts. Raises ValueError if the axes show nothing.
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
        known = ~np.isnan(exponent[:, orbit, 0])
        for index in range(indices):
            picture.line(impact[known], exponent[known, orbit, index], color=hue, lw=0.8)
        if inset:
            inset.line(impact[known], greatest[known, orbit], color=hue, lw=0.8)
    picture.beside([(ends[index], rf"$\lambda_{index + 1}$") for index in range(indices)])
    return picture.figure


class _Inset(Window):
    size = 7.0


def _inset(picture, largest, first, second, last):
    """Return the panel between the first exponent and the second, None if there is no room."""
    left, _, right, _ = picture.frame
    _, (high, low) = picture.place(0.0, [first, second])
    if not high - low > _INSET_ROOM:
        return None
    start, end = picture.across.limits
    start += _INSET_START * (end - start)
    if last < start:
        return None
    labelled = zip(picture.across.ticks, picture.across.labels, strict=True)
    labels = {tick: label for tick, label in labelled if start < tick < end}
    across = Axis((start, end), [*labels], labels=[*labels.values()])
    bottom = low + (_Inset.tick + _Inset.gap + 1.6 * _Inset.size) * POINT
    frame = left + _INSET_START * (right - left), bottom, right, high - 0.2 * (high - low)
    return _Inset(picture.sheet, frame, across, Axis(**largest))
