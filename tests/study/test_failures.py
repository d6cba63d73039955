"""Failures of methods: shares and counts against those of an independent solver."""

import numpy as np
import pytest

from helpers.independent_solver import judge
from study import stages, states
from study.methods.counted_methods import OURS, scan_method

BALL = states.BALL
SCAN = scan_method(0.5, 1e-12)


def flown_past(method, columns):
    """Return which flights of a method end at another root than those of the mpmath solver."""
    tau, _ = method.solve(BALL, *columns)
    true = [judge(BALL.k, BALL.g, *state).tau for state in zip(*columns, strict=True)]
    return [not abs(a - b) <= min(b, 1) / 10 for a, b in zip(tau.tolist(), true, strict=True)]


@pytest.fixture(scope="module")
def edges():
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(stages, "DISTANCES", (0, 4))
        patch.setattr(stages, "DEPTHS", (3, 9))
        return stages.failures((OURS, SCAN), count=25)


@pytest.mark.parametrize("side", stages.SIDES)
@pytest.mark.parametrize(("i", "near", "touch"), [(0, 0, 3), (1, 4, 9)])
def test_shares_of_failures_are_those_of_an_independent_solver(edges, side, i, near, touch):
    scan = edges.isel(method=1, side=stages.SIDES.index(side))
    columns = states.grazing_at(near, side, 25)
    assert scan["near"].values[i] == np.mean(flown_past(SCAN, columns))
    columns = states.near_miss(side * 10.0**-touch, 25)
    assert scan["touch"].values[i] == np.mean(flown_past(SCAN, columns))


def test_the_march_does_not_fail_and_a_scan_misses_touches_shorter_than_its_step(edges):
    assert not (edges["near"].values[0].any() or edges["touch"].values[0].any())
    assert edges["touch"].values[1, 0].min() > 0.5


def test_the_count_of_missed_impacts_is_that_of_an_independent_solver(monkeypatch):
    """Each flight of the chaotic orbit that is counted ends at a later root."""
    impacts = 60_000
    columns, truth = stages.certified_orbit(BALL, states.chaotic(), impacts)
    tau, _ = SCAN.solve(BALL, *columns)
    suspects = np.abs(tau - truth) > 1e-6
    late = flown_past(SCAN, columns[:, suspects])
    monkeypatch.setattr(stages, "MILLION", impacts)
    data = stages.missed((SCAN, OURS), [impacts, 0])
    assert data["missed_hard"][1].tolist() == [sum(late), 0] and sum(late) > 5
    assert data["missed_sea"][1].tolist() == [sum(late), 0]
    counted = stages.missed_flights([SCAN], 10_000)
    first = int(counted["first"].values[1])
    assert counted["missed"].values[1, -1] == suspects[:10_000].sum() and suspects[first]
    assert np.array_equal(counted["state"].values[1], columns[:, first])
    monkeypatch.setattr(stages, "MILLION", first // 2 + 1)  # in parts: the miss is in a later one
    assert stages.missed_flights([SCAN], 10_000).identical(counted)
    monkeypatch.setattr(stages, "ORBIT_METHODS", (OURS, SCAN))
    monkeypatch.setattr(stages, "AGREE_STARTS", 1)
    whole = stages.drift(impacts)
    assert whole["missed"].values.tolist() == [0, sum(late)]
    assert whole["drift"].values[1].max() < 1e-9  # energy does not show missed impacts
