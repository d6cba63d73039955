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


def kept_by_definition(x, y, tolerance):
    """Keep a vertex where the chord to the next one does not pass all since the last one kept."""
    keep = [0]
    for i in range(1, len(x) - 1):
        first, last = keep[-1], i + 1
        wide, high = x[last] - x[first], y[last] - y[first]
        dx, dy = x[first + 1 : last] - x[first], y[first + 1 : last] - y[first]
        square, along = wide * wide + high * high, dx * wide + dy * high
        near = np.abs(dx * high - dy * wide) <= tolerance * np.sqrt(float(square))
        if square == 0 or not np.all(near & (along >= 0) & (along <= square)):
            keep.append(i)
    return [*keep, len(x) - 1]


@pytest.mark.parametrize("seed", range(6))
def test_random_lines_keep_what_the_definition_keeps(seed):
    """Straight lines with noise, circles, walks, turns back and parabolas."""
    random = np.random.default_rng(seed)
    for count in random.integers(2, 150, 20):
        t, size = np.arange(count), random.uniform(0.1, 100.0)
        turns = random.uniform(1e-3, 0.3) * t
        for line in (
            (size * t, random.uniform(-size, size) * t + random.integers(-6, 7, count)),
            (1e5 * np.cos(turns), 1e5 * np.sin(turns)),
            random.integers(-3, 4, (2, count)).cumsum(axis=1),
            (size * t, size * np.abs(t - count // 2)),
            (size * t, random.uniform(-0.3, 0.3) * t**2),
        ):
            x, y = (np.floor(a).astype(np.int64) for a in line)
            for tolerance in (1, 4):
                assert bends(x, y, tolerance) == kept_by_definition(x, y, tolerance)
