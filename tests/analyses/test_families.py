"""Families of periodic orbits: complete by brute force, right to 12 digits, and faults are seen."""

import copy
import json
import math
from itertools import pairwise
from time import process_time

import independent_solver as judge
import numpy as np
import pytest
from content import content_hash
from mpmath import mp, mpf

from pseudorigid import Ball, symmetric_orbits
from pseudorigid.analyses.continuation import search
from pseudorigid.analyses.continuation.asymmetric import AsymmetricOrbits
from pseudorigid.analyses.continuation.broken_symmetry import break_symmetry
from pseudorigid.analyses.continuation.curve import Point, locate, solve_at, trace
from pseudorigid.analyses.continuation.grazing import grazing
from pseudorigid.analyses.continuation.half_orbit import ENERGY, FIX_R, INERTIA
from pseudorigid.analyses.continuation.symmetric import Parameter
from pseudorigid.analyses.families import families
from pseudorigid.dynamics import periodic
from pseudorigid.kernel.arithmetic import quadrant
from pseudorigid.kernel.flight import gap
from pseudorigid.kernel.impact_law import impact_coefficients, rebound

PAPER = Ball(0.2, 0.04)


def rho(ball, energy):
    return math.sqrt(1.0 + 2.0 * ball.k * (energy / (ball.g * ball.g)))


def searched(ball, low, high, longest, levels):
    """A whole search over a range of energies."""
    ends = rho(ball, low), rho(ball, high)
    found = search.Search(Parameter(ENERGY, ball.k, *ends), longest)
    step = (ends[1] - ends[0]) / levels
    for _ in found.sweep([ends[0] + (i + 0.5) * step for i in range(levels)]):
        pass
    found.switch()
    break_symmetry(found)
    found.link()
    return found


@pytest.fixture(scope="module")
def six():
    """Periods up to 6 over the paper's whole range of energies."""
    return searched(PAPER, -0.00399, 0.0599, 6, 40)


def shown_by_finer_cells(ball, energy, family, point):
    """Whether brute force finds an orbit on cells a thousand times finer than its own."""
    _, radius = ball.section(energy)
    system = family.system
    times, on_lines = system.times(point), search.positions(system, point)
    for start, grid, defect in periodic._lines(ball, energy, family.period):
        by_q = grid[0] < 0.0  # Fix R; on Fix RP the parameter is half of the symmetric flight
        if by_q != (family.line == FIX_R):
            continue
        margin = 0.499 * (grid[1] - grid[0])
        wider = np.concatenate(([grid[0] - margin], grid, [grid[-1] + margin]))
        for place in on_lines if by_q else (times[0], times[-1]):
            i = int(np.searchsorted(wider, place))
            cells = np.linspace(wider[max(i - 2, 0)], wider[min(i + 1, wider.size - 1)], 3001)
            line = start, cells, defect
            for state in periodic._solutions(ball, line, family.period, radius):
                time = periodic._orbit_from(ball, state, family.period)[3].sum()
                if abs(time - system.time(point)) < 1e-6:
                    return True
    return False


def is_row(family, point, row):
    """Whether an orbit has a total time and a trace."""
    time, trace = row
    return abs(family.system.time(point) - time) < 1e-6 and abs(
        family.system.trace(point) - trace
    ) < 1e-3 * (1.0 + abs(trace))


def unmatched(found, ball, energy):
    """Orbits that only brute force finds, and those that only the families hold at an energy.

    Left out are orbits that brute force misses because two zeros, or a zero and a jump, share one
    of its cells: on finer cells it finds them.
    """
    p, missed, extra = rho(ball, energy), [], []
    held = {n: [] for n in range(1, found.longest + 1)}
    for family in found.families:
        if family.line >= 0:
            held[family.period] += [(family, z) for z in found.crossings(family, p)]
    for period, orbits in held.items():
        data = symmetric_orbits(ball, energy, period)
        rows = list(zip(data["total_time"].values, data["trace"].values, strict=True))
        for row in rows:
            same = [(f, z) for f, z in orbits if is_row(f, z, row)]
            if same:
                orbits.remove(same[0])
            else:
                missed.append((energy, period, *map(float, row)))
        if data.attrs["unsolved"] > len(orbits):
            missed.append((energy, period, "unsolved", data.attrs["unsolved"]))
        extra += [
            (energy, period, f.number)
            for f, z in orbits
            if any(is_row(f, z, row) for row in rows)  # held twice
            or not shown_by_finer_cells(ball, energy, f, z)
        ]
    return missed, extra


def assert_complete(found, ball, energies):
    for energy in energies:
        assert unmatched(found, ball, energy) == ([], [])


def spread(low, high, count):
    """Energies that are on no grid."""
    return [low + (high - low) * ((0.137 + 0.6180339887498949 * i) % 1.0) for i in range(count)]


def test_families_hold_what_brute_force_finds_and_nothing_else(six):
    assert_complete(six, PAPER, spread(-0.0039, 0.0598, 3))


def over_all_energies(k, g, most=math.inf):
    """All families up to period 12 up to eq. (31), or to E/g^2 = `most`, and their energies."""
    ball = Ball(k, g)
    low, high = ball.energy_bounds()
    margin = 0.002 * (high - low)
    low, high = low + margin, min(high - margin, most * g * g)
    return ball, searched(ball, low, high, 12, 240), (low + margin, high - margin)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("k", "g", "most", "energies"),
    [(0.2, 0.04, 37.5, 10), (0.1, 0.04, 6.25, 5), (1.0 / 3.0, 0.04, 10.0, 5), (0.2, 0.02, 10.0, 5)],
)
def test_families_of_longer_periods_are_complete(k, g, most, energies):
    """Two balls up to eq. (31), two up to E/g^2 = 10: `python` on this file checks all of them."""
    ball, found, ends = over_all_energies(k, g, most)
    assert [end.kind for f in found.families for end in f.ends].count("unresolved") == 0
    assert_complete(found, ball, spread(*ends, energies))


def test_every_end_has_a_name(six):
    for family in six.families:
        for end in family.ends:
            assert end.kind in {"range", "resonance", "doubling", "pitchfork", "touch", "rim"}
            if end.kind not in ("range", "touch"):
                assert end.family >= 0
            if end.kind == "resonance":
                assert family.period == end.order * six.families[end.family].period


def test_families_go_on_where_an_impact_grazes():
    """From a level below the grazing, the search finds the family that begins there."""
    found = search.Search(Parameter(ENERGY, 0.2, rho(PAPER, 0.0115), rho(PAPER, 0.0135)), 6)
    for _ in found.sweep([rho(PAPER, 0.0120)]):
        pass
    assert 5 not in {family.period for family in found.families}
    found.switch()
    found.link()
    (five,) = (family for family in found.families if family.period == 5)
    (end,) = (end for end in five.ends if end.kind == "touch")
    assert energy_of(found, end.p) == pytest.approx(0.012520264234, abs=1e-12)
    assert found.families[end.family].period == 6


# --- 60 digits ----------------------------------------------------------------------------------

K, G = mpf("0.2"), mpf("0.04")


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


def six_born_at(found, line, kind):
    """The period-six family from one line that ends in a kind of event below E = 0.01."""
    (family,) = (
        f
        for f in found.families
        if f.period == 6
        and f.line == line
        and any(e.kind == kind and found.parameter.energy(e.p) < 6.25 for e in f.ends)
    )
    return family


def energy_of(found, p):
    return found.parameter.energy(p) * PAPER.g**2


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
        (guess, *_) = family.system.times(event.point)

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


def test_a_touch_of_an_orbit_without_symmetry_is_solved_for():
    """Next to the end of a family of period 9: one flight's gap has the maximum 0."""
    energy, x, y = 0.04337870745, 0.4102763193, -0.1254932613
    along = Parameter(ENERGY, PAPER.k, rho(PAPER, 0.03), rho(PAPER, 0.05))
    radius = rho(PAPER, energy)
    scale = PAPER.g * radius * math.sqrt((1.0 + PAPER.k) / PAPER.k)
    place = (PAPER.k * x / PAPER.g - 1.0) / radius, y / scale, radius
    system = AsymmetricOrbits(9, along)
    end = grazing(system, system.point(place))
    assert end.kind == "touch"
    at_x, at_y, radius = end.point.place
    energy = along.energy(radius) * PAPER.g**2
    x = PAPER.g * (1.0 + radius * at_x) / PAPER.k
    y = PAPER.g * radius * math.sqrt((1.0 + PAPER.k) / PAPER.k) * at_y
    state = PAPER.state_xy(x, y, energy)
    for _ in range(end.impact):
        state = PAPER.impact(*state)[:3]
    x, v, w = (value / PAPER.g for value in state)
    b, c, s = rebound(v, w, PAPER.k, impact_coefficients(PAPER.k))
    heights = [gap(t, x, b, c, s, 1.0, quadrant(t))[:2] for t in np.linspace(0.05, 9.0, 100_000)]
    value, rate = np.array(heights).T
    (tops,) = np.nonzero((rate[:-1] > 0.0) & (rate[1:] <= 0.0))
    assert max(value[tops[0]], value[tops[0] + 1]) == pytest.approx(0.0, abs=1e-8)


# --- a system in closed form ---------------------------------------------------------------------


class Plane:
    """The zeros of h(q, p), given with its derivatives."""

    scale, limits = 1.0, (-5.0, 5.0)

    def __init__(self, function):
        self.function = function

    def point(self, place):
        h, h_q, h_p = self.function(*place)
        return Point(place, (h,), ((h_q, h_p),), np.array(place), (), np.empty(0))


class Space:
    """The circle q^2 + r^2 = 1 on the plane p = q/2: two equations in three unknowns."""

    scale, limits = 1.0, (-5.0, 5.0)

    def point(self, place):
        q, r, p = place
        rows = (2.0 * q, 2.0 * r, 0.0), (-0.5, 0.0, 1.0)
        defect = q * q + r * r - 1.0, p - 0.5 * q
        return Point(place, defect, rows, np.array(place), (), np.empty(0))


def turning_points(system, points):
    """The places at which the parameter turns."""

    def across(point):
        return point.gradients[0][0]

    return [
        locate(system, a, b, across).place
        for a, b in pairwise(points)
        if across(a) * across(b) < 0.0
    ]


def never(point):
    return False


def test_a_circle_closes_and_its_folds_are_exact():
    system = Plane(lambda q, p: (q * q + p * p - 1.0, 2.0 * q, 2.0 * p))
    followed = trace(system, solve_at(system, (0.9, 0.3), 1.0), 1.0, never)
    assert followed.reason == "closed"
    folds = turning_points(system, followed.points)
    assert sorted(p for _, p in folds) == pytest.approx([-1.0, 1.0], abs=1e-15)


def test_a_cubic_has_its_two_folds_and_runs_to_both_limits():
    system = Plane(lambda q, p: (q * q * q - 3.0 * q - p, 3.0 * q * q - 3.0, -1.0))
    start = solve_at(system, (0.0, 0.0), 0.1)
    ends = []
    for sign in (1.0, -1.0):
        followed = trace(system, start, sign, never)
        assert followed.reason == "range"
        ((q, p),) = turning_points(system, followed.points)
        assert (abs(q), abs(p)) == pytest.approx((1.0, 2.0), abs=1e-8)
        assert abs(p) == pytest.approx(2.0, abs=1e-15)
        ends.append(followed.points[-1].p)
    assert sorted(ends) == [-5.0, 5.0]


def test_a_curve_in_space_closes():
    system = Space()
    start = solve_at(system, (0.6, 0.8, 0.3), 0.1)
    followed = trace(system, start, 1.0, never)
    assert followed.reason == "closed"
    for point in followed.points:
        q, r, p = point.place
        assert abs(q * q + r * r - 1.0) < 1e-14
        assert abs(p - 0.5 * q) < 1e-15


def test_a_curve_does_not_jump_to_its_neighbour():
    """h = sin-like product of parallel curves 0.003 apart, far below the largest step."""
    gap = 0.003

    def function(q, p):
        u = q - 0.3 * p * p
        return (
            u * (u - gap) * (u + gap),
            3.0 * u * u - gap * gap,
            -0.6 * p * (3.0 * u * u - gap * gap),
        )

    system = Plane(function)
    followed = trace(system, solve_at(system, (0.0, 0.0), 1e-4), 1.0, never)
    for point in followed.points:
        assert abs(point.q - 0.3 * point.p**2) < 1e-12


# --- planted faults ------------------------------------------------------------------------------


def with_fold(found):
    """A family with a fold, and an energy at which it holds two orbits."""
    for family in found.families:
        for event in family.events:
            at = int(event.at)
            if event.kind == "fold" and family.line >= 0 and 3 < at < len(family.points) - 4:
                a, b = family.points[at - 3].p, family.points[at + 3].p
                p = 0.5 * (event.point.p + (min if a > event.point.p else max)(a, b))
                return family.number, at, energy_of(found, p)
    raise AssertionError("no fold")


def test_a_skipped_fold_is_found(six):
    number, at, energy = with_fold(six)
    planted = copy.copy(six)
    planted.families = [copy.copy(family) for family in six.families]
    family = planted.families[number]
    family.points = family.points[: at + 1]
    missed, extra = unmatched(planted, PAPER, energy)
    assert len(missed) == 1
    assert extra == []


def test_a_jump_to_the_neighbour_is_found(six):
    """The tail of one period-six family is replaced by that of another one."""
    planted = copy.copy(six)
    planted.families = [copy.copy(family) for family in six.families]
    first, second = (
        planted.families[six_born_at(six, 1, kind).number] for kind in ("resonance", "touch")
    )
    first.points = [point for point in second.points if 0.01 < energy_of(six, point.p) < 0.02]
    missed, extra = unmatched(planted, PAPER, 0.0123)
    assert len(missed) == 1
    assert [number for _, _, number in extra] in ([first.number], [second.number])


# --- the stage ------------------------------------------------------------------------------------

SMALL = {"parameter": "energy", "span": [0.005, 0.012], "period": 6, "levels": 45}


@pytest.mark.slow
def test_a_killed_search_continues_and_gives_the_same_dataset(tmp_path):
    whole = families(PAPER, 0.01, **SMALL)
    folder = tmp_path / "kept"
    shares = []

    def killed(share, text):
        shares.append(share)
        if share > 0.6:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        families(PAPER, 0.01, **SMALL, progress=killed, folder=folder)
    assert json.loads((folder / "families.json").read_text())["done"] == 20
    again = []
    data = families(PAPER, 0.01, **SMALL, progress=lambda s, _: again.append(s), folder=folder)
    assert len(again) == SMALL["levels"] - 20
    assert content_hash(data) == content_hash(whole)
    assert not folder.exists()


def test_families_against_k_cross_those_against_the_energy():
    """At k = 0.2 and E/g^2 = 6.25 both searches hold the three period-six orbits."""
    by_k = search.Search(Parameter(INERTIA, 6.25, 0.19, 0.21), 6)
    for _ in by_k.sweep([0.195, 0.205]):
        pass
    held = sorted(
        by_k.families[i].system.time(z)
        for i, family in enumerate(by_k.families)
        if family.period == 6
        for z in by_k.crossings(family, 0.2)
    )
    times = symmetric_orbits(PAPER, 0.01, 6)["total_time"].values
    assert held == pytest.approx(sorted(times.tolist()), abs=1e-9)


def main():
    """Compare with brute force at fifty energies up to eq. (31) for four balls."""
    for k, g in ((0.2, 0.04), (0.1, 0.04), (1.0 / 3.0, 0.04), (0.2, 0.02)):
        ball, found, ends = over_all_energies(k, g)
        unnamed = [end.kind for f in found.families for end in f.ends].count("unresolved")
        print(f"k = {k:.3f}, g = {g}: {len(found.families)} families, {unnamed} ends unnamed")
        for energy in spread(*ends, 50):
            missed, extra = unmatched(found, ball, energy)
            if missed or extra:
                print(f"  only brute force: {missed}, only families: {extra}", flush=True)
        print(f"  compared; {process_time():.0f} s so far", flush=True)


if __name__ == "__main__":
    main()
