"""Axes that no scene gives: round, around the data, with ticks."""

import numpy as np
import pytest

from pseudorigid.figures.axes.limits import of_data


@pytest.mark.parametrize("low", [-0.37, 0.0, 1e-9, 12345.6])
@pytest.mark.parametrize("span", [1e-12, 3e-4, 0.99, 1.0, 7e5])
@pytest.mark.parametrize("margin", [0.0, 0.08])
def test_axes_hold_the_data_and_have_ticks(low, span, margin):
    axis = of_data(np.array([low, low + span, np.nan]), margin=margin)
    start, end = axis["limits"]
    assert start <= low
    assert low + span <= end
    if span > 1e-9 * abs(low):
        assert end - start <= 1.6 * span
    assert 2 <= len(axis["ticks"]) <= 8
    assert all(start <= tick <= end for tick in axis["ticks"])
    assert axis["ticks"] == sorted(set(axis["ticks"]))


def test_limits_and_ticks_are_round_numbers():
    axis = of_data(np.array([-0.174, 0.573]), most=6)
    assert axis == {"limits": [-0.2, 0.6], "ticks": [-0.2, 0.0, 0.2, 0.4, 0.6]}
    assert of_data([0, 200000], room=0.0)["limits"] == [0, 200000]
