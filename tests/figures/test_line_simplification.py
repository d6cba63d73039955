"""Simplified lines keep their bends and lose the vertices on straight pieces."""

import numpy as np
import pytest

from pseudorigid.figures.canvas.line_simplification import bends

_STRAIGHT = np.arange(0, 30_000, 10)


@pytest.mark.parametrize(
    ("across", "up", "kept"),
    [
        ([7], [7], [0]),
        ([0, 100], [0, 100], [0, 1]),
        ([0, 100, 100], [0, 0, 100], [0, 1, 2]),
        ([0, 100, 0], [0, 0, 0], [0, 1, 2]),  # there and back again
        ([0, 50, 100, 50, 0], [0, 0, 0, 0, 0], [0, 2, 4]),
        (_STRAIGHT, 3 * _STRAIGHT, [0, 2999]),
        (_STRAIGHT, 3 * _STRAIGHT + np.arange(3000) % 3, [0, 2999]),
    ],
)
def test_ends_and_bends_are_kept(across, up, kept):
    assert bends(across, up, 4) == kept


def test_a_curve_stays_within_the_tolerance_and_has_bends():
    t = np.linspace(0.0, 1.0, 3000)
    x, y = np.floor(2e5 * t), np.floor(4e5 * t * t * (1.0 - t))
    keep = bends(x, y, 4)
    assert len(keep) < 300
    off = np.abs(np.interp(x, x[keep], y[keep]) - y)
    assert off.max() < 4 * 2.5  # measured upwards, where the slope is at most 2
    u, v = np.diff(x[keep]), np.diff(y[keep])
    assert np.all(u[:-1] * v[1:] != u[1:] * v[:-1])
