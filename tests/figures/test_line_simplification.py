"""Simplified lines keep their bends and lose the vertices on straight pieces."""

import numpy as np
import pytest

from pseudorigid.figures.canvas.sheet import bends


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
