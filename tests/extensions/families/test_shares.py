"""The regular share along a line: that of the sweep, split into the chains of families."""

import numpy as np
import pytest

from extensions.atlas.cell import cell
from extensions.families.families import families
from extensions.families.shares import causes, elliptic_orbits, extrema, shares
from pseudorigid import Ball

BALL, SPAN = Ball(0.2, 0.04), [0.0075, 0.0095]


@pytest.fixture(scope="module")
def held():
    return families(BALL, 0.01, "energy", [0.007, 0.01], 6, 4)


@pytest.fixture(scope="module")
def data(held):
    return shares(BALL, 0.01, held, "energy", SPAN, 0.001, 200, 4000)


def test_the_share_is_that_of_a_cell_of_the_sweep(data):
    assert data["energy"].values.tolist() == [0.008, 0.009]
    for value, e in zip(data["regular"].values, (5.0, 5.625), strict=True):
        assert value == cell(0.2, e, 200, 4000)["regular"]


def test_every_regular_orbit_is_in_one_chain_or_outside(data):
    total = data["share"].sum("family") + data["outside"]
    assert np.allclose(total, data["regular"], atol=1e-12)


def test_the_six_islands_are_those_of_the_sweep(held, data):
    """The sweep counts the same islands by their winding number, 1/6."""
    (six,) = np.flatnonzero((data["share"].values[1] > 0.0) & (held["period"].values == 6))
    counted = cell(0.2, 5.625, 200, 4000)
    assert (counted["chain_period"], counted["chain_turns"]) == (6, 1)
    assert data["share"].values[1, six] == pytest.approx(counted["chain_share"], abs=0.011)


def test_elliptic_orbits_close(held):
    found = elliptic_orbits(BALL, held, "energy", 0.009)
    assert sorted(points.shape[1] for _, points in found) == [1, 6]
    for _, points in found:
        x, y = points[:, -1]
        after = BALL.impact(*BALL.state_xy(x, y, 0.009))
        assert after[0] == pytest.approx(points[0, 0], abs=1e-9)


def test_extrema_stand_out_from_their_intervals():
    share = np.array([0.5, 0.3, 0.1, 0.12, 0.3, 0.6, 0.2, 0.2, 0.7])
    narrow, wide = 0.05, 0.6
    assert extrema(share, share - narrow, share + narrow) == [(2, 1, 4), (5, 4, 6), (6, 5, 8)]
    assert extrema(share, share - wide, share + wide) == []


def test_nothing_is_a_cause_for_lying_near():
    """A chain that does not account for half of the change is no cause, whatever its events."""
    share = np.array([[0.30, 0.05], [0.10, 0.04], [0.30, 0.05]])
    total = share.sum(axis=1)
    held = families(BALL, 0.01, "energy", [0.007, 0.008], 6, 2)
    (number,) = np.flatnonzero(held["end_kind"].values[:, 1] == "resonance")[:1]
    at = float(held["end_energy"].values[number, 1])
    values = np.array([at - 0.001, at, at + 0.001])
    by_family = np.zeros((3, held.sizes["family"]))
    by_family[:, number] = share[:, 1]
    by_family[:, -1] = share[:, 0] if number != held.sizes["family"] - 1 else 0.0
    held["event_energy"].values[held["event_family"].values == held.sizes["family"] - 1] = 9.0
    held["end_energy"].values[-1] = 9.0
    bounds = total, total - 0.01, total + 0.01
    table = causes(held, "energy", values, bounds, by_family, [], 0.0005)
    assert list(table["cause_event"][1]) == ["unexplained"]
    assert table["slope_change"][1] == pytest.approx([-0.21, 0.21])
    assert table["slope_part"][1][:, 0] == pytest.approx([20 / 21, 20 / 21])
    # The last curve beyond a resonance counts only if it breaks within a step of the extremum, and
    # the orbits beyond the resonance were half of the fall.
    event = "last curve beyond 1/5 breaks"
    for broken, beyond, cause in (
        (at - 0.0003, [0.15, 0.0, 0.0], event),
        (at - 0.0003, [0.08, 0.0, 0.0], "unexplained"),
        (at - 0.0006, [0.15, 0.0, 0.0], "unexplained"),
        (np.nan, [0.15, 0.0, 0.0], "unexplained"),
    ):
        curves = [(event, broken, np.array(beyond))]
        table = causes(held, "energy", values, bounds, by_family, curves, 0.0005)
        assert list(table["cause_event"][1]) == [cause]
    by_family[:, number], by_family[:, -1] = share[:, 0], share[:, 1]
    table = causes(held, "energy", values, bounds, by_family, [], 0.0005)
    assert table["cause_family"][1] == [number]
