"""Which points a polygon with many sides contains, and its area, against a sum over all sides."""

import numpy as np
import pytest

from extensions.claims.analyses.polygon import Polygon


@pytest.mark.parametrize("turn", [1, -1])
def test_a_star_contains_what_a_ray_through_all_sides_says(turn):
    angle = turn * 2.0 * np.pi * np.arange(301) / 301
    radius = 1.0 + 0.4 * np.cos(5.0 * angle)
    vertices = 0.3 + radius * np.array([np.cos(angle), np.sin(angle)])
    polygon = Polygon(vertices)
    x, y = np.random.default_rng(1).uniform(-1.5, 2.0, (2, 40, 50))
    away, around = np.hypot(x - 0.3, y - 0.3), np.arctan2(y - 0.3, x - 0.3)
    edge = 1.0 + 0.4 * np.cos(5.0 * around)
    sure = np.abs(away - edge) > 0.01
    inside = polygon.contains(x, y)
    assert inside.shape == x.shape and 200 < inside.sum() < 1800
    assert np.array_equal(inside[sure], (away < edge)[sure])
    assert polygon.area() == pytest.approx(np.pi * (1.0 + 0.5 * 0.4**2), rel=3e-3)
