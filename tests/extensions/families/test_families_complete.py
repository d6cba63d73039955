"""Families hold what brute force finds and nothing else."""

import math

import pytest
from mpmath import mp, mpf

from extensions.families.continuation.half_orbit import FIX_R
from helpers import independent_solver as judge
from helpers.exact_orbits import state_at
from helpers.parts.family_search import PAPER, crossings, rho, searched, up_to_period_six
from helpers.slowly import slowly
from pseudorigid import Ball, symmetric_orbits


def is_orbit_in_60_digits(ball, energy, family, point):
    """Whether an orbit of the family's period, symmetry and total time exists in 60 digits.

    Newton's method solves for half of the orbit, which is less sensitive than all of it.
    """
    (x, y, _), (centre, radius) = family.system.first_place(point), ball.section(energy)
    guess = centre + radius * x, radius * math.sqrt(ball.k * (1.0 + ball.k)) * y
    k, g, half = mpf(ball.k), mpf(ball.g), (family.period + 1) // 2

    def points(x, y, impacts):
        """(x, y) of a point of the section and of those after it, with the times of flight."""
        state, rows = state_at(k, g, mpf(energy), x, y), [(x, y, 0)]
        for _ in range(impacts):
            *state, tau = judge.exact_map(k, g, *state)
            rows.append((state[0], state[1] - k * state[2], tau))
        return rows

    def asymmetry(x, y):
        """How far the point is from its line, and the half orbit's end from being mirrored."""
        later = points(x, y, half)
        start = y if family.line == FIX_R else points(x, -y, 1)[1][1] - y
        return start, later[half][1] + later[family.period - half - family.line][1]

    with mp.workdps(60):
        try:
            orbit = points(*mp.findroot(asymmetry, guess), family.period)
        except (TypeError, ValueError):  # beyond the section, or without a solution
            return False
        missing = max(abs(a - b) for a, b in zip(orbit[0][:2], orbit[-1][:2], strict=True))
        time = sum(tau for *_, tau in orbit)
        return missing < mpf("1e-30") and abs(time - point.data.time) < 1e-6


def is_row(family, point, row):
    """Whether an orbit has a total time and a trace."""
    time, trace = row
    return abs(point.data.time - time) < 1e-6 and abs(family.system.trace(point) - trace) < 1e-3 * (
        1.0 + abs(trace)
    )


def unmatched(found, ball, energy):
    """Orbits that only brute force finds, and those that only the families hold at an energy.

    Brute force misses an orbit if two zeros, or a zero and a jump, share one of its cells. Such an
    orbit is left out if it exists in 60 digits.
    """
    p, missed, extra = rho(ball, energy), [], []
    held = {n: [] for n in range(1, found.longest + 1)}
    for family in found.families:
        if family.line >= 0:
            held[family.period] += [(family, z) for z in crossings(family, p)]
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
            if any(is_row(f, z, row) for row in rows)  # held twice, as in the next line
            or sum(is_row(f, z, (y.data.time, h.system.trace(y))) for h, y in orbits) > 1
            or not is_orbit_in_60_digits(ball, energy, f, z)
        ]
    return missed, extra


def spread(low, high, count):
    """Energies that are on no grid."""
    return [low + (high - low) * ((0.137 + 0.6180339887498949 * i) % 1.0) for i in range(count)]


ENERGIES = spread(-0.0039, 0.0398, 3)


@pytest.mark.parametrize("energy", [ENERGIES[1], *slowly(ENERGIES[0], ENERGIES[2])])
def test_families_hold_what_brute_force_finds_and_nothing_else(energy):
    assert unmatched(up_to_period_six(), PAPER, energy) == ([], [])


def over_all_energies(k, g, most, levels=240):
    """All families up to period 12 up to eq. (31), or to E/g^2 = `most`, and their energies."""
    ball = Ball(k, g)
    low, high = ball.energy_bounds()
    margin = 0.002 * (high - low)
    low, high = low + margin, min(high - margin, most * g * g)
    return ball, searched(ball, low, high, 12, levels), (low + margin, high - margin)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("k", "g", "most", "energies"),
    [(0.2, 0.04, 37.5, 5), (0.1, 0.04, 6.25, 3), (1.0 / 3.0, 0.04, 10.0, 3)],
)
def test_families_of_longer_periods_are_complete(k, g, most, energies):
    """Two balls up to eq. (31), one up to E/g^2 = 10."""
    ball, found, ends = over_all_energies(k, g, most)
    assert [end.kind for f in found.families for end in f.ends].count("unresolved") == 0
    for energy in spread(*ends, energies):
        assert unmatched(found, ball, energy) == ([], [])
