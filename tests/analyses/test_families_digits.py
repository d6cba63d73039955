"""Energies of events along families are right to 12 digits, against computations in 60 digits."""

import independent_solver as judge
import pytest
from family_search import PAPER, energy_of, rho, searched, six_born_at, up_to_period_six
from mpmath import mp, mpf

from pseudorigid.analyses.continuation import search
from pseudorigid.analyses.continuation.curve import solve_at
from pseudorigid.analyses.continuation.half_orbit import ENERGY
from pseudorigid.analyses.continuation.symmetric import Parameter

K, G = mpf("0.2"), mpf("0.04")


@pytest.fixture(scope="module")
def six():
    return up_to_period_six()


def fixed_trace(theta):
    """Trace of the fixed point, from the closed form (design of the fixed point, g = 1)."""
    c = 1 - theta * mp.cot(theta)
    shear = c * (2 * theta - mp.sin(2 * theta)) / (theta * (1 + K))
    return 2 * (1 + K * (mp.cos(2 * theta) - shear)) / (1 + K)


def fixed_energy(theta):
    c = 1 - theta * mp.cot(theta)
    return G * G * ((1 + K) * theta**2 + c * c - 1) / (2 * K)


def state_at(energy, x, y):
    """The state (x, xdot, udot) of a point (x, y) of the section."""
    square = (1 + K) * (2 * energy + 2 * G * x - K * x * x) - y * y
    s = mp.sqrt(square / K)
    return x, (y + K * s) / (1 + K), (s - y) / (1 + K)


def after(state, impacts):
    for _ in range(impacts):
        state = judge.exact_map(K, G, *state)[:3]
    return state


def on_section(energy, x, y, impacts):
    """The point (x, y) after some impacts."""
    x, v, w = after(state_at(energy, x, y), impacts)
    return x, v - K * w


def apex(state):
    """Strain -xi and eta = -k U' where the centre is highest in the flight after an impact."""
    x, v, w = state
    e = 2 * (v + w) / (1 + K)
    b, c = v - K * e, w - e
    t = -b / G
    return x * mp.cos(t) - c * mp.sin(t), -K * (x * mp.sin(t) + c * mp.cos(t))


def fall(energy, a, eta, guess):
    """The state at the end of the fall from an apex with strain -a and U' = -eta/k."""
    rate = -eta / K
    height = (K * a * a / 2 + K * rate * rate / 2 - energy) / G
    t = mp.findroot(lambda t: height + G * t * t / 2 - a * mp.cos(t) + rate * mp.sin(t), mpf(guess))
    return a * mp.cos(t) - rate * mp.sin(t), G * t, a * mp.sin(t) + rate * mp.cos(t)


def solved(equations, guess):
    """Newton's method with differences, in 60 digits."""
    return mp.findroot(equations, [mpf(value) for value in guess], tol=mpf(10) ** -60)


STEP = mpf(10) ** -20


def events_of(found, number, kind):
    family = found.families[number]
    return [
        (found.parameter.energy(e.point.p) * PAPER.g**2, e.turns, e.order)
        for e in family.events
        if e.kind == kind
    ]


@pytest.mark.parametrize("order", [4, 5, 6, 7, 8])
def test_resonances_of_the_fixed_point_are_right_to_12_digits(order):
    """Against the closed form in 60 digits; the search does not use it."""
    found = search.Search(Parameter(ENERGY, 0.2, rho(PAPER, -0.003), rho(PAPER, 0.0599)), 8)
    point = solve_at(found.systems[1, 0], (-0.25, rho(PAPER, 0.01)), 0.1)
    found.add(1, 0, point)
    energies = {q: e for e, p, q in events_of(found, 0, "resonance") if p == 1}
    with mp.workdps(60):
        wanted = 2 * mp.cos(2 * mp.pi / order)
        theta = mp.findroot(lambda t: fixed_trace(t) - wanted, (mpf("0.7"), mpf("1.9")),
                            solver="anderson")  # fmt: skip
        assert abs(energies[order] / fixed_energy(theta) - 1) < mpf("1e-12")


def test_the_births_of_the_three_period_six_orbits_are_right_to_12_digits(six):
    with mp.workdps(60):
        theta = mp.findroot(lambda t: fixed_trace(t) - 1, (mpf("0.7"), mpf("1.9")),
                            solver="anderson")  # fmt: skip
        for line in (0, 1):
            family = six_born_at(six, line, "resonance")
            (end,) = (e for e in family.ends if e.kind == "resonance")
            assert abs(energy_of(six, end.p) / fixed_energy(theta) - 1) < mpf("1e-12")
        family = six_born_at(six, 1, "touch")
        (end,) = (e for e in family.ends if e.kind == "touch")

        def beyond(energy):
            """eta after a start at rest on the floor, which only touches it."""
            x = G / K - mp.sqrt((2 * energy + G * G / K) / K)
            return apex(after((x, mpf(0), mpf(0)), 3))[1]

        born = energy_of(six, end.p)
        exact = mp.findroot(beyond, (mpf(born), mpf(born) * (1 + mpf("1e-9"))), solver="secant")
        assert abs(born / exact - 1) < mpf("1e-12")


def test_the_first_doublings_of_the_period_six_orbits_are_right_to_12_digits(six):
    with mp.workdps(60):
        family = six_born_at(six, 0, "resonance")
        event = next(e for e in family.events if e.kind == "doubling")
        unit = mpf(repr(PAPER.g)) / PAPER.k
        energy, x = energy_of(six, event.point.p), (1.0 + event.point.p * 2.0 * event.point.q
                                                   / (1.0 + event.point.q**2)) * unit  # fmt: skip

        def on_fix_r(energy, x):
            ahead, behind = (on_section(energy, x + d, mpf(0), 3) for d in (STEP, -STEP))
            above, below = (on_section(energy, x, d, 3) for d in (STEP, -STEP))
            first = (ahead[0] - behind[0]) / (2 * STEP)
            last = (above[1] - below[1]) / (2 * STEP)
            return on_section(energy, x, mpf(0), 3)[1], first * last

        exact = solved(on_fix_r, (energy, x))[0]
        assert abs(energy / exact - 1) < mpf("1e-12")
        family = six_born_at(six, 1, "touch")
        events = [e for e in family.events if e.kind == "doubling"]
        event = min(events, key=lambda e: e.point.p)
        energy = energy_of(six, event.point.p)
        a = (1.0 + event.point.p * 2.0 * event.point.q / (1.0 + event.point.q**2)) * unit
        (guess, *_) = family.system.times(event.point.data)

        def on_fix_rp(energy, a):
            def end(a, eta):
                return apex(after(fall(energy, a, eta, guess), 2))

            ahead, behind = (end(a + d, mpf(0)) for d in (STEP, -STEP))
            above, below = (end(a, d) for d in (STEP, -STEP))
            first = (ahead[0] - behind[0]) / (2 * STEP)
            last = (above[1] - below[1]) / (2 * STEP)
            return end(a, mpf(0))[1], first * last

        exact = solved(on_fix_rp, (energy, a))[0]
        assert abs(energy / exact - 1) < mpf("1e-12")


@pytest.mark.slow
def test_the_doubling_of_an_orbit_without_symmetry_is_right_to_12_digits():
    """Period 4 breaks its symmetry at E = 0.0380, and doubles its period at 0.0421."""
    found = searched(PAPER, 0.0378, 0.0424, 8, 2)
    (four,) = (f for f in found.families if f.period == 4 and f.line < 0)
    (event,) = (e for e in four.events if e.kind == "doubling")
    (child,) = (f for f in found.families if f.period == 8 and f.line < 0)
    (end,) = (e for e in child.ends if e.kind == "doubling")
    assert (end.family, end.p) == (four.number, event.point.p)
    unit, energy = PAPER.g / PAPER.k, energy_of(found, event.point.p)
    at_x, at_y, radius = event.point.place
    x = unit * (1.0 + radius * at_x)
    y = unit * radius * (PAPER.k * (1.0 + PAPER.k)) ** 0.5 * at_y
    with mp.workdps(60):

        def equations(energy, x, y):
            last = on_section(energy, x, y, 4)
            sides = [
                [on_section(energy, x + a * d, y + b * d, 4)[i] for d in (STEP, -STEP)]
                for i, (a, b) in enumerate(((1, 0), (0, 1)))
            ]
            trace = sum(ahead - behind for ahead, behind in sides) / (2 * STEP)
            return last[0] - x, last[1] - y, trace + 2

        exact = solved(equations, (energy, x, y))[0]
        assert abs(energy / exact - 1) < mpf("1e-12")
