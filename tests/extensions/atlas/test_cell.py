"""A cell of a sweep, the closed forms of the fixed point, and blocks, which change no data."""

import math
from itertools import product

import numpy as np
import pytest

from extensions.atlas import cell, kinds, starts
from extensions.atlas.sweep import dataset_of_a_sweep
from helpers.dataset_hash import content_hash
from pseudorigid import Ball, lyapunov_spectrum
from pseudorigid.dynamics import fixed_point
from pseudorigid.kernel import tangents

SMALL = {"k": [0.1, 0.2], "energy": [0.3, 2.0, 6.25], "starts": 40, "impacts": 1000, "block": 2}


@pytest.mark.parametrize("k", [0.02, 0.2, 1 / 3, 1.0])
@pytest.mark.parametrize("e", [-0.4, 0.01, 0.625, 6.25, 40.0])
def test_the_closed_forms_are_those_of_the_map(k, e):
    theta = fixed_point.half_time(k, e)
    assert fixed_point.energy(k, theta) == pytest.approx(e, rel=1e-12, abs=1e-12)
    state = (fixed_point.place(k, theta), theta, theta / k)
    ball = Ball.dimensionless(k)
    assert ball.impact(*state) == pytest.approx((*state, 2 * theta), rel=1e-9, abs=1e-9)
    (a, _), (_, d) = ball.chart_jacobian(*state)
    assert fixed_point.trace_at(k, theta) == pytest.approx(a + d, rel=1e-8, abs=1e-8)


def test_the_rotation_number_and_its_resonances():
    assert fixed_point.rotation(0.0) == pytest.approx(0.25, abs=1e-15)
    assert fixed_point.rotation(-1.0) == pytest.approx(1 / 3, abs=1e-15)
    assert math.isnan(fixed_point.rotation(-2.1))
    for k, q in ((0.05, 8), (0.2, 6), (0.3, 3)):
        theta = fixed_point.half_time(k, fixed_point.resonance(k, 1, q))
        assert fixed_point.rotation(fixed_point.trace_at(k, theta)) == pytest.approx(
            1 / q, rel=1e-9
        )


def test_the_angle_is_that_of_atan2():
    rng = np.random.default_rng(3)
    for a, b in [*rng.normal(size=(2000, 2)), (1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (-1, -1)]:
        angle = tangents.angle(float(a), float(b))
        assert angle == pytest.approx(math.atan2(b, a), abs=1e-14)
    assert tangents.angle(0.0, 0.0) == 0.0


def test_a_turn_is_within_half_a_turn_of_the_expected_one():
    for expected in (-0.4, 0.0, 0.3, 0.5):
        for turn in np.linspace(expected - 0.499, expected + 0.499, 23):
            p, q, angle = 0.3, -0.7, -2.0 * math.pi * turn
            r = p * math.cos(angle) - q * math.sin(angle)
            s = p * math.sin(angle) + q * math.cos(angle)
            found = tangents.turn_between(p, q, r, s, expected)
            assert found == pytest.approx(turn, abs=1e-14)


def test_starts_are_even_in_area_and_have_the_energy():
    k, e, count = 0.2, 6.25, 4000
    x, v, w = starts.sunflower_points(k, e, count)
    assert Ball.dimensionless(k).energy(x, v, w) == pytest.approx(np.full(count, e))
    y = (v - k * w) / math.sqrt((1 + k) * (2 * e + 1 / k))
    x = (x - 1 / k) / math.sqrt((2 * e + 1 / k) / k)
    assert y.min() >= 0
    for left, width in ((-0.5, 0.5), (0.1, 0.3), (0.6, 0.2)):
        part = np.mean((x > left) & (x < left + width) & (y < 0.4))
        assert part == pytest.approx(width * 0.4 / (math.pi / 2), abs=6 / math.sqrt(count) / 10)


def test_fractions_are_the_simplest_nearby():
    winding = np.array([1 / 6, 1 / 6 + 2e-5, 2 / 12, 3 / 23, 0.0, 0.41421356])
    turns, periods = cell.nearest_fractions(winding)
    assert periods.tolist() == [6, 0, 6, 23, 1, 0]
    assert turns.tolist() == [1, 0, 1, 3, 0, 0]


def test_an_interval_is_where_the_share_is_within_its_normal_error():
    for count, total in ((0, 20), (1, 20), (7, 20), (19, 20), (20, 20), (300, 1000)):
        low, high = cell.wilson(count, total)
        for end in {low, high} - {0.0, 1.0}:
            error = 1.96 * math.sqrt(end * (1.0 - end) / total)
            assert abs(end - count / total) == pytest.approx(error, rel=1e-3)
        assert 0.0 <= low <= count / total <= high <= 1.0
        assert (low == 0.0) == (count == 0) and (high == 1.0) == (count == total)


def test_the_numbers_of_a_cell_are_those_of_its_orbits():
    """Made up: seven regular orbits, two of them in 1/4 and one in 2/5, and five others."""
    regular = np.array([True] * 7 + [False] * 5)
    strict = np.append([False] * 2, regular[2:])
    lenient = np.append(regular[:9], [True, False, False])
    winding = np.array([0.21, 0.22, 0.2000001, 0.25, 0.25 + 9e-6, 0.4, 0.23, *[0.25] * 5])
    exponent = np.array([*[0.001] * 7, 0.4, 0.1, 0.3, 0.2, np.nan])
    orbits = np.rec.fromarrays(
        [regular, strict, lenient, winding, exponent, np.arange(12)],
        names="regular,strict,lenient,winding,exponent,followed",
    )
    found = cell._summary(orbits, 0.2)
    shares = {"regular": 7, "regular_strict": 5, "regular_lenient": 8, "chain_share": 2}
    assert {name: found[name] * 12 for name in shares} == pytest.approx(shares)
    assert found["regular_low"] == cell.wilson(5, 12)[0]
    assert found["regular_high"] == cell.wilson(8, 12)[1]
    assert (found["chain_turns"], found["chain_period"]) == (1, 4)  # 1/5 is the fixed point's own
    assert found["exponent"] == pytest.approx(0.25) and found["followed"] == 5.5
    assert (found["exponent_low"], found["exponent_high"]) == (0.1, 0.3)
    assert found["exponent_error"] == pytest.approx(np.std([0.4, 0.1, 0.3, 0.2], ddof=1) / 2)
    assert found["chains"].tolist() == [0, 0, 0, 2, 1] + [0] * 19


def test_the_energy_of_figure_2_has_six_islands_and_a_sea():
    numbers = cell.cell(0.2, 6.25, 300, 4000)
    assert (numbers["chain_turns"], numbers["chain_period"]) == (1, 6)
    assert 0.14 < numbers["regular"] < 0.20
    assert numbers["regular_low"] < 0.17 < numbers["regular_high"]
    assert numbers["regular_lenient"] - numbers["regular_strict"] < 0.01
    assert numbers["trace"] == pytest.approx(0.8632851929828689, rel=1e-12)
    assert 1 / numbers["rotation"] == pytest.approx(5.5876195834, rel=1e-9)


def test_near_rest_no_orbit_is_chaotic_and_rotation_numbers_near_zero_make_no_chain():
    numbers = cell.cell(0.2, -1.4, 40, 1000)
    assert numbers["regular"] == 1.0 and math.isnan(numbers["exponent"])
    numbers = cell.cell(0.2, -2.49999999, 20, 400)
    assert numbers["rotation"] < 1e-4 and numbers["chain_period"] == 0


def test_the_exponent_is_that_of_long_orbits():
    numbers = cell.cell(0.2, 6.25, 1500, 500)
    # 64 orbits of 1e7 impacts give 0.23171 +- 0.00007
    assert numbers["exponent"] == pytest.approx(0.23171, abs=4 * numbers["exponent_error"])
    assert 0.001 < numbers["exponent_error"] < 0.003
    assert numbers["exponent_low"] < numbers["exponent"] < numbers["exponent_high"]


@pytest.mark.slow
def test_intervals_hold_the_shares_and_exponents_of_random_orbits():
    """The random orbits have other starts and longer runs, and exponents of the spectrum."""
    random = np.random.default_rng(2024)
    inside, off = 0, []
    for _ in range(6):
        k, e = float(random.uniform(0.012, 0.332)), float(10 ** random.uniform(-0.5, 1.6))
        numbers, ball = cell.cell(k, e, 200, 8000), Ball.dimensionless(k)
        centre, radius = ball.section(e)
        angle, share = 2 * math.pi * random.random(600), np.sqrt(random.random(600))
        y = radius * math.sqrt(k * (1 + k)) * share * np.sin(angle)
        states = ball.state_xy(centre + radius * share * np.cos(angle), y, e)
        half, whole = lyapunov_spectrum(ball, states, 20_000, 2)["exponent"].values[:, :, 0]
        chaotic = 20_000 * whole - 10_000 * half > 5  # ln 2 = 0.69 on regular orbits
        inside += numbers["regular_low"] <= 1 - chaotic.mean() <= numbers["regular_high"]
        error = math.hypot(numbers["exponent_error"], np.std(whole[chaotic]) / chaotic.sum() ** 0.5)
        off.append((numbers["exponent"] - whole[chaotic].mean()) / error)
    assert inside >= 5
    assert np.max(np.abs(off)) < 4 and abs(np.mean(off)) < 1


def joined(size):
    """The dataset of the small sweep, computed in blocks of this size."""
    sweep = SMALL | {"block": size}
    parts = [cell.block_of_cells_of_a_sweep(**part) for part in kinds.blocks(sweep)]
    return dataset_of_a_sweep(*parts, k=sweep["k"], energy=sweep["energy"])


@pytest.mark.slow
def test_the_size_of_blocks_does_not_change_the_bytes():
    assert len({content_hash(joined(size)) for size in (1, 4, 5, 100)}) == 1


def test_the_dataset_has_each_cell_at_its_coordinates_with_the_bits_that_it_has_alone():
    data = joined(4)
    at, order = data["resonance_k"].values[700], data["order"].values.tolist()
    assert data["resonance_energy"].values[:, 700].tolist() == [
        fixed_point.resonance(float(at), 1, q) for q in order
    ]
    assert np.array_equal(data["exponent_95"], cell.NORMAL_95 * data["exponent_error"], True)
    data = data.drop_dims(["order", "resonance"]).drop_vars("exponent_95")
    assert dict(data.sizes) == {"k": 2, "energy": 3, "period": cell.MAX_ISLANDS}
    assert set(data.data_vars) == set(cell.VARIABLES)
    for k, energy in product(SMALL["k"], SMALL["energy"]):
        here = data.sel(k=k, energy=energy)
        for name, value in cell.cell(k, energy, SMALL["starts"], SMALL["impacts"]).items():
            assert np.array_equal(here[name].values, value, equal_nan=True)
