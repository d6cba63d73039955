"""The regular share along a line: that of the sweep, split into the chains of families."""

import numpy as np
import pytest
import xarray as xr

from extensions.atlas.cell import cell
from extensions.families import causes as causes_module
from extensions.families import shares as shares_module
from extensions.families.causes import causes, extrema
from extensions.families.dataset import families
from extensions.families.shares import shares
from pseudorigid import Ball, symmetric_orbits
from pseudorigid.dynamics.variables import chart, states_of

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


def test_parts_are_shares_of_the_section(data):
    """Orbits beyond a resonance of the fixed point are regular and in no chain of another one."""
    beyond, regular = data["beyond"].values, data["regular"].values[:, None]
    assert np.all((beyond >= 0.0) & (beyond <= regular))
    assert data["resonance_order"].values.tolist() == sorted(data["resonance_order"].values)[::-1]
    assert np.all(beyond[beyond > 0.0] >= 1.0 / 200)
    assert np.all(np.abs(beyond * 200 - np.rint(beyond * 200)) < 1e-9)


def test_an_orbit_goes_around_a_point_that_it_surrounds():
    angle = np.linspace(0.0, 2.0 * np.pi, 40)
    x, y = 0.3 + np.cos(angle), -0.2 + 0.5 * np.sin(angle)
    for at, inside in (((0.3, -0.2), True), ((1.1, -0.2), True), ((1.5, -0.2), False),
                       ((0.3, 0.6), False), ((-0.9, -0.2), False)):  # fmt: skip
        assert shares_module._goes_around(x, y, *at) == inside
    half = angle <= np.pi
    assert not shares_module._goes_around(x[half], y[half], 0.3, -0.2)


def test_orbits_of_families_at_a_value_are_elliptic_and_close(held):
    line = shares_module.Line(BALL, 0.01, "energy", held)
    found = shares_module.elliptic_orbits(line, 0.009)
    periods = {int(held["period"].values[number]) for number, _ in found}
    assert {1, 6} <= periods
    for number, points in found:
        period = int(held["period"].values[number])
        assert points.shape == (2, period)
        states = BALL.state_xy(*points, 0.009)
        after = np.array(BALL.impact(*states)[:3])
        image = np.array([after[0], after[1] - 0.2 * after[2]])
        assert np.allclose(image, np.roll(points, -1, axis=1), atol=1e-9)
        first = np.ravel(BALL.state_xy(*points[:, 0], 0.009))
        assert abs(np.trace(BALL.chart_jacobian(*first, period))) < 2.0


def test_only_elliptic_orbits_have_islands():
    orbits = symmetric_orbits(BALL, 0.01, 6)
    x, y = chart(BALL.k, *states_of(orbits))
    for i, kind in enumerate(orbits["type"].values):
        found = shares_module._elliptic_orbit(BALL, 0.01, x[i, 0] + 1e-5, y[i, 0], 6)
        assert (found is not None) == (kind == "elliptic")
        if found is not None:
            assert np.allclose(found, [x[i], y[i]], atol=1e-9)


@pytest.mark.parametrize(("beyond", "above", "expected"), [
    ([0.1, 0.1, 0.0, 0.0], [1, 1, 1, 1], [("last", "breaks", 0, 3)]),
    ([0.0, 0.002, 0.003, 0.1], [1, 1, 1, 1], [("first", "forms", 3, 0)]),
    ([0.1, 0.1, 0.0, 0.1], [1, 1, 0, 0], [("first", "forms", 3, 2)]),  # a chain is born between
    ([0.1, 0.0, 0.1, 0.1], [0, 0, 0, 0], [("last", "breaks", 0, 2), ("first", "forms", 3, 0)]),
    ([0.1, 0.1, 0.1, 0.1], [1, 1, 1, 1], []),
])  # fmt: skip
def test_curves_break_or_form_where_the_share_beyond_vanishes(monkeypatch, beyond, above, expected):
    asked = []
    monkeypatch.setattr(shares_module, "breakup", lambda *given: asked.append(given[1:]) or 0.5)
    values = np.array([10.0, 11.0, 12.0, 13.0])
    line = shares_module.Line(BALL, 0.01, "energy", None)
    given = values, np.array(above, bool), 1, 5, np.array(beyond)
    found = shares_module._breakups(line, *given)
    names = [f"{which} curve beyond 1/5 {event}" for which, event, *_ in expected]
    assert [event for event, _, _ in found] == names
    assert asked == [(1, 5, values[first], values[last]) for *_, first, last in expected]


def test_extrema_stand_out_from_their_intervals():
    share = np.array([0.5, 0.3, 0.1, 0.12, 0.3, 0.6, 0.2, 0.2, 0.7])
    narrow, wide = 0.05, 0.6
    assert extrema(share, share - narrow, share + narrow) == [(2, 1, 4), (5, 4, 6), (6, 5, 8)]
    assert extrema(share, share - wide, share + wide) == []


@pytest.fixture(scope="module")
def minimum():
    """Families, values, shares of two chains with a minimum, and the number of the first one.

    An event of the first chain, which is small, lies at the minimum; those of the other one are far
    away.
    """
    held = families(BALL, 0.01, "energy", [0.007, 0.008], 6, 2)
    (number,) = np.flatnonzero(held["end_kind"].values[:, 1] == "resonance")[:1]
    last = held.sizes["family"] - 1
    assert number != last
    at = float(held["end_energy"].values[number, 1])
    held["event_energy"].values[held["event_family"].values == last] = 9.0
    held["end_energy"].values[last] = 9.0
    chains = np.zeros((3, held.sizes["family"]))
    chains[:, number], chains[:, last] = [0.05, 0.04, 0.05], [0.30, 0.10, 0.30]
    return held, at + np.array([-0.001, 0.0, 0.001]), chains, number


def caused(minimum, curves=(), swapped=False):
    """The rows of the extrema and slopes of this minimum."""
    held, values, chains, number = minimum
    if swapped:
        chains = chains.copy()
        chains[:, [number, -1]] = chains[:, [-1, number]]
    total = chains.sum(axis=1)
    bounds = total, total - 0.01, total + 0.01
    return causes(held, "energy", values, bounds, chains, curves, 0.0005)


def test_a_chain_that_lies_near_is_no_cause_unless_it_accounts_for_half_of_the_change(minimum):
    ((row,), slopes) = caused(minimum)
    assert row["cause_event"] == "unexplained"
    assert [slope["slope_change"] for slope in slopes] == pytest.approx([-0.21, 0.21])
    assert [slope["slope_part"][0] for slope in slopes] == pytest.approx([20 / 21, 20 / 21])
    # A curve that accounts for as much comes after the chain.
    chain, tie = minimum[-1], ("a curve", minimum[1][1], minimum[2][:, -1])
    ((row,), _) = caused(minimum, [tie], swapped=True)
    assert row["cause_family"] == chain


@pytest.mark.parametrize(
    ("place", "beyond", "is_cause"),
    [(-0.0003, 0.15, True), (-0.0003, 0.08, False), (-0.0006, 0.15, False), (np.nan, 0.15, False)],
)
def test_a_curve_is_a_cause_if_it_breaks_near_and_half_of_the_change_was_beyond_it(
    minimum, place, beyond, is_cause
):
    event = "last curve beyond 1/5 breaks"
    curve = event, minimum[1][1] + place, np.array([beyond, 0.0, 0.0])
    ((row,), _) = caused(minimum, [curve])
    assert row["cause_event"] == (event if is_cause else "unexplained")


def test_events_of_a_family_are_named_without_the_limits_of_its_range():
    rows = {"event_family": [0, 1, 1], "event_turns": [1, 0, 1], "event_order": [5, 1, 6]}
    data = xr.Dataset({name: ("event", values) for name, values in rows.items()})
    data["event_kind"] = "event", ["resonance", "fold", "resonance"]
    data["event_energy"] = "event", [0.1, 0.2, 0.3]
    data["end_kind"] = ("family", "side"), [["range", "rim"], ["touch", "range"]]
    data["end_energy"] = ("family", "side"), [[0.0, 0.4], [0.5, 1.0]]
    found = [causes_module._events_of(data, "energy", number) for number in (0, 1)]
    assert found[0] == [("resonance 1/5", 0.1), ("end: rim", 0.4)]
    assert found[1] == [("fold", 0.2), ("resonance 1/6", 0.3), ("end: touch", 0.5)]
