"""Curves of chains over the plane: right to 12 digits, in order, and faults are seen."""

import independent_solver as judge
import numpy as np
import pytest
import xarray as xr
from mpmath import mp, mpf
from slowly import slowly

from pseudorigid.analyses.continuation import loci
from pseudorigid.analyses.continuation.half_orbit import B
from pseudorigid.dynamics import fixed_point
from pseudorigid.figures.canvas.ragged_rows import rows
from pseudorigid.sweep import chains

PLANE = {
    "k": [0.14, 0.2, 0.26, 0.33],
    "energy": [0.1, 1.0, 10.0, 40.0],
    "chains": [4, 6, 7],
}


@pytest.fixture(scope="module")
def curves():
    """The dataset of three chains, sought at one k each."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(chains, "_SOUGHT", 1)
        return chains.chains(PLANE)


def curve(curves, order, kind):
    """K and E/g^2 of the only curve of a kind of a chain."""
    (part,) = (
        part
        for o, name, part in zip(
            curves["order"].values, curves["kind"].values, rows(curves), strict=True
        )
        if (o, name) == (order, kind)
    )
    return curves["k"].values[part], curves["energy"].values[part]


def at(curves, order, kind, k):
    """The point of a curve that is nearest to a k."""
    ks, energies = curve(curves, order, kind)
    i = int(np.argmin(np.abs(ks - k)))
    return float(ks[i]), float(energies[i])


# --- 60 digits, g = 1 ----------------------------------------------------------------------------

STEP = mpf(10) ** -20


def state_at(k, energy, x, y):
    """The state (x, xdot, udot) of a point (x, y) of the section."""
    s = mp.sqrt(((1 + k) * (2 * energy + 2 * x - k * x * x) - y * y) / k)
    return x, (y + k * s) / (1 + k), (s - y) / (1 + k)


def after(k, state, impacts):
    for _ in range(impacts):
        state = judge.exact_map(k, mpf(1), *state)[:3]
    return state


def defect(k, energy, x, y, period):
    """The end (x, y) of half an orbit of an even period."""
    x, v, w = after(k, state_at(k, energy, x, y), period // 2)
    return x, v - k * w


def eta(k, state):
    """-k U' where the centre is highest in the flight after an impact."""
    x, v, w = state
    e = 2 * (v + w) / (1 + k)
    b, c = v - k * e, w - e
    return -k * (x * mp.sin(-b) + c * mp.cos(-b))


def event(k, order, kind, energy, x):
    """The equations that hold at a fold or doubling of an orbit of even period."""
    (x1, y1), (x0, y0) = (defect(k, energy, x + d, mpf(0), order) for d in (STEP, -STEP))
    if kind == "fold":
        entry = (y1 - y0) / (2 * STEP)
    else:
        (_, y3), (_, y2) = (defect(k, energy, x, d, order) for d in (STEP, -STEP))
        entry = (x1 - x0) * (y3 - y2) / (4 * STEP * STEP)
    return defect(k, energy, x, mpf(0), order)[1], entry


def solved(equations, energy, x):
    """Newton's method with differences that are wide against the equations' own."""
    wide = mpf(10) ** -12
    for _ in range(3):
        h, entry = equations(energy, x)
        h_e, entry_e = (
            (a - b) / wide for a, b in zip(equations(energy + wide, x), (h, entry), strict=True)
        )
        h_x, entry_x = (
            (a - b) / wide for a, b in zip(equations(energy, x + wide), (h, entry), strict=True)
        )
        determinant = h_e * entry_x - h_x * entry_e
        step = (h * entry_x - entry * h_x) / determinant
        energy, x = energy - step, x - (h_e * entry - entry_e * h) / determinant
    assert abs(step) < mpf(10) ** -18 * energy
    return energy


def exact_energy(k, energy, order, kind):
    """The energy of an event at a k, in 60 digits, next to an approximate one."""
    x = None if kind == "rim" else place_of(order, kind, k)
    with mp.workdps(60):
        k = mpf(k)
        if kind == "rim":

            def beyond(e):
                x = 1 / k - mp.sqrt((2 * e + 1 / k) / k)
                end = after(k, (x, mpf(0), mpf(0)), order // 2)
                return eta(k, end) if order % 2 else end[1] - k * end[2]

            near = mpf(energy), mpf(energy) * (1 + mpf("1e-9"))
            return mp.findroot(beyond, near, solver="secant", tol=mpf(10) ** -40)
        return solved(lambda e, x: event(k, order, kind, e, x), mpf(energy), mpf(x))


def place_of(order, kind, k):
    """X and the energy of an event at a k, from where the chain's events are found."""
    start = loci.chain_events(k, order)[kind]
    q, rho, _ = start.place
    return (1.0 + rho * 2.0 * q / (1.0 + q * q)) / k


@pytest.mark.parametrize(
    ("order", "kind", "near"),
    [(4, "fold", 0.26), (6, "doubling", 0.2), *slowly((7, "rim", 0.3))],
)
def test_folds_doublings_and_lost_impacts_are_right_to_12_digits(curves, order, kind, near):
    k, energy = at(curves, order, kind, near)
    exact = exact_energy(k, energy, order, kind)
    assert abs(energy / exact - 1) < 1e-12
    other = exact_energy(k + 1e-10, energy, order, kind)  # a planted fault
    assert abs(energy / other - 1) > 1e-11


def test_curves_pass_through_the_events_of_families(curves):
    """At another k, where a search that follows E finds them."""
    for order, k in ((4, 0.23), (6, 0.17), (7, 0.29)):
        for kind, start in loci.chain_events(k, order).items():
            ks, energies = curve(curves, order, kind)
            there = np.interp(k, ks, energies)
            assert there == pytest.approx(loci.energy_at(start.place), rel=2e-3), (order, kind)


def disordered(curves):
    """Chains whose doubling is not between the birth and the lost impact, at k = 0.2 to 0.33."""
    found = []
    for order in PLANE["chains"]:
        birth = "fold" if order == 4 else "resonance"
        for k in (0.2, 0.24, 0.28, 0.32):
            energies = [
                np.interp(k, *curve(curves, order, kind)) for kind in (birth, "doubling", "rim")
            ]
            if energies != sorted(energies):
                found.append((order, k))
    return found


def test_every_chain_doubles_between_its_birth_and_the_loss_of_an_impact(curves):
    assert disordered(curves) == []


def test_curves_of_another_chain_or_event_are_noticed(curves):
    swapped = curves.copy(deep=True)
    kinds = swapped["kind"].values.copy()
    six = [i for i, order in enumerate(swapped["order"].values) if order == 6]
    (doubling,), (rim,) = ([i for i in six if kinds[i] == kind] for kind in ("doubling", "rim"))
    kinds[doubling], kinds[rim] = kinds[rim], kinds[doubling]
    swapped["kind"] = ("curve", kinds)
    assert disordered(swapped)
    k, energy = at(curves, 7, "rim", 0.3)
    assert abs(energy / exact_energy(k, at(curves, 6, "rim", 0.3)[1], 6, "rim") - 1) > 1e-3


def test_an_entry_that_does_not_vanish_is_not_followed():
    limits = loci.Limits((0.1, 0.3), (0.1, 40.0))
    start = loci.chain_events(0.2, 6)["doubling"]
    assert len(loci.follow(6, start, limits)) > 20
    assert loci.follow(6, start._replace(entry=B), limits) == []


def test_births_are_the_closed_form_and_jumps_begin_where_the_proof_says(curves):
    for order in PLANE["chains"]:
        for k, energy in list(zip(*curve(curves, order, "resonance"), strict=True))[::60]:
            assert energy == fixed_point.resonance(float(k), 1, order)
    k, energy = curve(curves, 0, "jumps")
    assert np.array_equal(energy, 1.0 + 0.5 * k)


def test_a_chain_of_which_the_resonance_is_not_in_the_plane_has_no_curves():
    few = chains.chains({"k": [0.1, 0.11], "energy": [1.0, 2.0], "chains": [3]})
    assert isinstance(few, xr.Dataset)
    assert few["kind"].values.tolist() == ["jumps"]
