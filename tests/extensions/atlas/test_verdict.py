"""Verdicts on orbits, and the study of their errors and costs."""

import numpy as np
import pytest

from extensions.atlas import cell, starts, verdicts
from pseudorigid import Ball
from pseudorigid.dynamics import fixed_point, verdict

K, E = 0.2, 6.25


def classify(states, impacts):
    """Verdicts on states, with turns around the fixed point."""
    x, _, rotation = fixed_point.numbers(K, E)
    count = len(states[0])
    return verdict.classify_orbits(K, states, np.full(count, x), np.full(count, rotation), impacts)


def test_an_early_verdict_is_that_of_a_longer_run():
    states = starts.sunflower_points(K, E, 300)
    short, long = classify(states, 2000), classify(states, 8000)
    early = short.followed < 2000
    assert 0.8 < early.mean() < 1.0
    for name in ("regular", "strict", "lenient", "winding", "growth", "exponent", "followed"):
        assert np.array_equal(getattr(short, name)[early], getattr(long, name)[early])
    assert np.array_equal(short.strict[early], short.lenient[early])
    assert np.all(long.followed[~early] > 1000)


def test_growth_is_that_of_a_product_of_jacobians():
    impacts = 400
    states = np.array(starts.sunflower_points(K, E, 6))
    found = classify(states, impacts)
    ball = Ball(k=K, g=1.0)
    for i, start in enumerate(states.T):
        state = start
        vector, logs = np.array([0.0, K * state[2], -state[1]]), []
        for _ in range(impacts):
            vector = ball.jacobian(*state) @ vector
            state = ball.impact(*state)[:3]
            logs.append(np.log(np.abs(vector).sum()))
        growth = np.mean(logs[300:]) - np.mean(logs[100:200])
        assert found.growth[i] == pytest.approx(growth, abs=1e-4)
        assert found.exponent[i] == pytest.approx((logs[399] - logs[99]) / 300, abs=1e-4)


def test_frozen_verdicts():
    """Counts of 2,000 short orbits, of which some lie on either side of each threshold."""
    shares = cell.cell(0.2, 9.0, 2000, 500)
    counts = {name: round(2000 * float(shares[name])) for name in shares if "regular" in name}
    expected = {"regular_strict": 333, "regular": 367, "regular_lenient": 379}
    assert expected.items() <= counts.items()


@pytest.mark.slow
def test_wrong_verdicts_are_rare():
    data = verdicts.verdicts(cells=6, orbits=64)
    rows = {str(name): i for i, name in enumerate(data["name"].values)}
    safe, fixed = rows["as soon as safe"], rows["growth below 3"]
    assert np.all(data["wrong"].values[:, safe, -1] < 0.02)
    assert np.all(data["cost"].values[:, safe, -1] < 2000)
    assert np.array_equal(data["cost"].values[:, fixed], [data["length"].values] * 2)
    assert np.all(data["missed"].values + data["alarms"].values == data["wrong"].values)
    gaps = (data["exponent"] - data["exponent_long"]).values
    error = data["exponent_error"].values
    assert np.nanmax(np.abs(gaps) / np.maximum(error, 1e-3)) < 4
