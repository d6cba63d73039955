"""Curves of chains over the plane: right to 12 digits, and in order."""

import numpy as np
import pytest
import xarray as xr
from mpmath import mp, mpf

from extensions.families import chains
from helpers.exact_orbits import after, apex, at_rest, event_energy, on_section
from helpers.slowly import slowly
from pseudorigid.dynamics import fixed_point
from pseudorigid.dynamics.variables import rows

PLANE = {"k": [0.14, 0.2, 0.26, 0.33], "energy": [0.1, 1.0, 10.0, 40.0], "chains": [4, 7]}


@pytest.fixture(scope="module")
def curves():
    """The dataset of two chains, sought at one k each."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(chains, "_SOUGHT", 1)
        return chains.chains(**PLANE)


def curve(curves, order, kind):
    """K and E/g^2 of the only curve of a kind of a chain."""
    every = zip(curves["order"].values, curves["kind"].values, rows(curves), strict=True)
    (part,) = (part for *named, part in every if named == [order, kind])
    return curves["k"].values[part], curves["energy"].values[part]


def at(curves, order, kind, k):
    """The point of a curve that is nearest to a k."""
    ks, energies = curve(curves, order, kind)
    i = int(np.argmin(np.abs(ks - k)))
    return float(ks[i]), float(energies[i])


def exact_energy(k, energy, order, kind):
    """The energy of an event at a k, in 60 digits, next to an approximate one."""
    x = None if kind == "rim" else place_of(order, kind, k)
    with mp.workdps(60):
        k, half = mpf(k), order // 2
        if kind != "rim":
            return event_energy(lambda e, *at: on_section(k, mpf(1), e, *at, half), kind, energy, x)

        def beyond(e):
            _, v, w = state = after(k, mpf(1), at_rest(k, 1, e), half)
            return apex(k, 1, state)[1] if order % 2 else v - k * w

        near = mpf(energy), mpf(energy) * (1 + mpf("1e-9"))
        return mp.findroot(beyond, near, solver="secant", tol=mpf(10) ** -40)


def place_of(order, kind, k):
    """X and the energy of an event at a k, from where the chain's events are found."""
    start = chains.chain_events(k, order)[kind]
    q, rho, _ = start.place
    return (1.0 + rho * 2.0 * q / (1.0 + q * q)) / k


@pytest.mark.parametrize(
    ("order", "kind", "near"), [(4, "fold", 0.26), (4, "doubling", 0.2), *slowly((7, "rim", 0.3))]
)
def test_folds_doublings_and_lost_impacts_are_right_to_12_digits(curves, order, kind, near):
    k, energy = at(curves, order, kind, near)
    exact = exact_energy(k, energy, order, kind)
    assert abs(energy / exact - 1) < 1e-12


def test_curves_pass_through_the_events_of_families(curves):
    """At another k, where a search that follows E finds them."""
    for order, k in ((4, 0.23), (7, 0.29)):
        for kind, start in chains.chain_events(k, order).items():
            ks, energies = curve(curves, order, kind)
            there = np.interp(k, ks, energies)
            assert there == pytest.approx(chains.energy_at(start.place), rel=2e-3), (order, kind)


def test_every_chain_doubles_between_its_birth_and_the_loss_of_an_impact(curves):
    for order in PLANE["chains"]:
        kinds = "fold" if order == 4 else "resonance", "doubling", "rim"
        for k in (0.2, 0.24, 0.28, 0.32):
            energies = [np.interp(k, *curve(curves, order, kind)) for kind in kinds]
            assert energies == sorted(energies), (order, k)


@pytest.mark.slow
def test_an_entry_that_does_not_vanish_is_not_followed():
    limits = chains.Limits((0.1, 0.3), (0.1, 40.0))
    start = chains.chain_events(0.2, 4)["doubling"]
    assert len(chains.follow(4, start, limits)) > 20
    assert chains.follow(4, start._replace(entry="b"), limits) == []


def test_births_are_the_closed_form_and_jumps_begin_where_the_proof_says(curves):
    for order in PLANE["chains"]:
        for k, energy in list(zip(*curve(curves, order, "resonance"), strict=True))[::60]:
            assert energy == fixed_point.resonance(float(k), 1, order)
    k, energy = curve(curves, 0, "jumps")
    assert np.array_equal(energy, 1.0 + 0.5 * k)


def test_a_chain_of_which_the_resonance_is_not_in_the_plane_has_no_curves():
    few = chains.chains([0.1, 0.11], [1.0, 2.0], [3])
    assert isinstance(few, xr.Dataset) and few["kind"].values.tolist() == ["jumps"]


def test_a_curve_is_known_where_it_passes_and_cut_at_the_plane():
    rows = [(0.1, 1.0), (0.2, 2.0), (0.3, 2.0)]
    for k, energy, passes in (
        (0.15, 1.5, True), (0.15, 1.514, True), (0.15, 1.53, False), (0.15, 1.47, False),
        (0.25, 2.0, True), (0.31, 2.0, False), (0.05, 1.0, False), (0.3, 2.0, True),
    ):  # fmt: skip
        assert chains._passes(rows, k, energy) == chains._passes(rows[::-1], k, energy) == passes
    limits = chains.Limits((0.1, 0.3), (1.5, 2.0))
    assert chains._within(rows, limits) == rows[1:]
    assert chains._wider(np.array([1.0, 2.0])) == pytest.approx((0.99, 2.01))
    assert chains._wider(np.array([1e-3, 2.0])) == pytest.approx((0.99e-3, 2.0 + 0.01 * 1.999))
    assert chains._wider(np.array([0.0, 2.0])) == pytest.approx((-0.02, 2.02))


@pytest.mark.parametrize("rows", [[(0.1, 2.0), (0.3, 4.0)], [(0.3, 4.0), (0.1, 2.0)]])
def test_a_curve_passes_through_a_point_in_either_direction(rows):
    off = chains._SAME * 3.0
    for k, energy, passes in (
        (0.2, 3.0, True), (0.2, 3.0 + 0.9 * off, True), (0.2, 3.0 - 0.9 * off, True),
        (0.2, 3.0 + 1.1 * off, False), (0.2, 3.0 - 1.1 * off, False), (0.4, 5.0, False),
    ):  # fmt: skip
        assert chains._passes(rows, k, energy) == passes
