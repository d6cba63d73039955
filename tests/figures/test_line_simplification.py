"""What is left out of a line: nothing that shows, and everything that is all but straight."""

import numpy as np

from pseudorigid.figures.canvas.line_simplification import bends


def test_ends_and_corners_stay():
    assert bends([], [], 4) in ([], [0])
    assert bends([7], [7], 4) == [0]
    assert bends([0, 100], [0, 100], 4) == [0, 1]
    assert bends([0, 100, 100], [0, 0, 100], 4) == [0, 1, 2]
    assert bends([0, 100, 0], [0, 0, 0], 4) == [0, 1, 2]  # there and back again
    assert bends([0, 50, 100, 50, 0], [0, 0, 0, 0, 0], 4) == [0, 2, 4]


def test_a_straight_line_is_its_ends():
    x = np.arange(0, 30_000, 10)
    assert bends(x, 3 * x, 4) == [0, len(x) - 1]
    assert bends(x, 3 * x + np.arange(len(x)) % 3, 4) == [0, len(x) - 1]


def test_a_curve_stays_within_the_tolerance_and_has_bends():
    t = np.linspace(0.0, 1.0, 3000)
    x, y = np.floor(2e5 * t), np.floor(4e5 * t * t * (1.0 - t))
    keep = bends(x, y, 4)
    assert len(keep) < 300
    off = np.abs(np.interp(x, x[keep], y[keep]) - y)
    assert off.max() < 4 * 2.5  # measured upwards, where the slope is at most 2
    u, v = np.diff(x[keep]), np.diff(y[keep])
    cross = u[:-1] * v[1:] - u[1:] * v[:-1]
    assert np.count_nonzero(cross == 0) == 0
