"""Periodic orbits: closed forms, high precision, closure, prime periods, symmetry, completeness."""

import mpmath
import numpy as np
import pytest
from mpmath import mpf

from pseudorigid import Ball, orbit, symmetric_orbits
from pseudorigid.dynamics.variables import of_type

BALL = Ball(0.2, 0.04)
NAMES = ("x", "xdot", "udot", "tau")
TYPES = {"elliptic", "hyperbolic", "inverse hyperbolic"}

# (k, g, energy), the last four with strongly stretched orbits
SETTINGS = [
    (0.2, 0.04, 0.01),
    (0.2, 0.04, 0.001),
    (0.2, 0.04, -0.00399),
    (0.2, 0.04, 0.0599),
    (0.05, 0.004, 0.003),
    (0.01, 0.001, 0.0039),
    (0.02, 0.009, -0.001),
    (1 / 3, 0.03, 0.02),
    (1.0, 0.3, -0.03),
    (0.33, 0.1, 0.06),
    (1.0, 0.1, 0.05),
    (0.2, 0.02, 0.03),
    (0.7, 0.2, 0.1),
]
PERIODS = range(1, 13)


def points_of(orbits, i):
    return np.stack([orbits[name].values[i] for name in NAMES])


def tolerance(multiplier):
    return 1e-14 * max(1.0, abs(multiplier) / 50.0)


def multiplier_of(trace):
    half = abs(trace) / 2.0
    return 1.0 if half <= 1.0 else np.copysign(half + np.sqrt(half * half - 1.0), trace)


def fixed_points(k, g, energy):
    """(theta, x, v, w) of all fixed points, by the closed form of tau = 2 theta, in 40 digits.

    v = g theta, w = g theta/k, x = (g theta/k) cot theta and
    E = (g^2/2k) ((1 + k) theta^2 + (1 - theta cot theta)^2 - 1); beyond pi, those that do not touch
    the floor earlier.
    """
    big = mpf(energy) * 2 * mpf(k) / mpf(g) ** 2 + 1

    def excess(theta):
        return (1 + mpf(k)) * theta**2 + (1 - theta * mpmath.cot(theta)) ** 2 - big

    found = []
    last = float(mpmath.sqrt(big / (1 + k)))
    # nodes crowd towards both ends, where cot is infinite
    share = (1 - np.cos(np.pi * (np.arange(4000) + 1 / 3) / 4000)) / 2
    for branch in range(int(last / np.pi) + 1):
        theta = np.pi * (branch + share)
        q = theta / np.tan(np.pi * share)
        values = (1 + k) * theta**2 + (1 - q) ** 2 - float(big)
        for j in np.nonzero(values[:-1] * values[1:] <= 0)[0]:
            theta0 = mpmath.findroot(
                excess, theta[j : j + 2].tolist(), solver="anderson", tol=1e-50
            )
            v, w = g * theta0, g * theta0 / mpf(k)
            x = w * mpmath.cot(theta0)
            t = np.linspace(0, 2 * float(theta0), 20_001)[1:-1]
            gap = float(x) * (1 - np.cos(t)) - float(v) * t + 0.5 * g * t * t - float(w) * np.sin(t)
            if np.all(gap < 0):
                found.append((theta0, x, v, w))
    return found


FIXED = [
    *SETTINGS,
    (0.2, 0.004, 0.05),
    (0.2, 0.001, 0.09),
    (0.5, 0.01, 0.2),
    (1.0, 0.02, 0.4),
    (0.03, 0.0005, 0.01),
    (0.2, 0.04, -0.004 + 1e-9),
]


@pytest.mark.parametrize(("k", "g", "energy"), FIXED)
def test_fixed_points_are_those_of_the_closed_form(k, g, energy):
    ball = Ball(k, g)
    lowest, _ = ball.energy_bounds()
    radius = ball.section(energy)[1]
    # how much a rounding of the terms of E moves the points
    limit = 1e-15 * (1 + abs(lowest) / (energy - lowest))
    with mpmath.workdps(40):
        expected = sorted(fixed_points(k, g, energy))
        found = symmetric_orbits(ball, energy, 1)
        assert found.sizes["orbit"] == len(expected)
        order = np.argsort(found["tau"].values[:, 0])
        for i, (theta, *state) in zip(order, expected, strict=True):
            stretch = max(1.0, abs(float(found["multiplier"][i])))
            assert abs(float(found["tau"][i, 0]) / 2 - theta) < limit * stretch * theta
            for name, value in zip(NAMES[:3], state, strict=True):
                assert abs(float(found[name][i, 0]) - value) < limit * stretch * radius


def test_one_fixed_point_on_zero_to_pi_whatever_the_ball():
    random = np.random.default_rng(2)
    for _ in range(40):
        k = 10 ** random.uniform(-2, 0)
        g = 10 ** random.uniform(-4, 0)
        ball = Ball(k, g)
        lowest, _ = ball.energy_bounds()
        energy = lowest * (1 - 10 ** random.uniform(-3, 1.5))
        found = symmetric_orbits(ball, energy, 1)
        theta = found["tau"].values[:, 0] / 2
        assert np.sum(theta < np.pi) == 1, (k, g, energy)
        x, v, w = (found[name].values[:, 0] for name in NAMES[:3])
        scale = ball.section(energy)[1]
        assert np.max(np.abs(v - g * theta)) < 1e-13 * scale
        assert np.max(np.abs(k * w - g * theta)) < 1e-13 * scale
        assert np.max(np.abs(x * np.sin(theta) - w * np.cos(theta))) < 1e-12 * scale


def check(ball, energy, period, orbits):
    """What holds for every answer."""
    k = ball.k
    radius = ball.section(energy)[1]
    count = orbits.sizes["orbit"]
    assert orbits.sizes["point"] == period
    assert orbits.attrs["energy"] == energy
    assert orbits.attrs["period"] == period
    assert orbits.attrs["resolution"] >= 1000
    for name in NAMES:
        assert orbits[name].dims == ("orbit", "point")
        assert orbits[name].dtype == float
        assert orbits[name].attrs["units"] == "1"
    for name in ("multiplier", "trace", "rotation_number", "total_time"):
        assert orbits[name].dims == ("orbit",)
        assert orbits[name].dtype == float
    assert orbits["type"].dims == ("orbit",)
    assert set(orbits["type"].values.tolist()) <= TYPES
    worst = 0.0
    seen = []
    for i in range(count):
        points = points_of(orbits, i)
        trace = float(orbits["trace"][i])
        multiplier = float(orbits["multiplier"][i])
        limit = tolerance(multiplier)
        # closes from the first point, by the map applied one by one
        state = points[:3, 0]
        for j in range(period):
            assert np.array_equal(state, points[:3, j])
            *state, tau = ball.impact(*state)
            state = np.array(state)
            assert tau == points[3, j]
        gap = np.max(np.abs(state - points[:3, 0]))
        assert gap <= limit, (period, trace, gap)
        worst = max(worst, gap / limit)
        # and from the stored points, each followed by the next
        after = np.stack(ball.impact(*points[:3]))
        assert np.max(np.abs(after[:3] - np.roll(points[:3], -1, axis=1))) <= limit
        assert np.array_equal(after[3], points[3])
        assert np.max(np.abs(ball.energy(*points[:3]) - energy)) < 1e-14 * (1 + radius) + 2 * limit
        # prime period, no orbit twice
        x, y = points[0], points[1] - k * points[2]
        apart = np.hypot(x[:, None] - x, y[:, None] - y) + np.eye(period)
        assert period == 1 or np.min(apart) > 1e-8 * radius
        for other_x, other_y in seen:
            assert np.min(np.hypot(x[:, None] - other_x, y[:, None] - other_y)) > 1e-8 * radius
        seen.append((x, y))
        # symmetric under (x, y) -> (x, -y)
        mirrored = np.min(np.hypot(x[:, None] - x, y[:, None] + y), axis=1)
        assert np.max(mirrored) < 1e-9 * radius
        # stability
        product = np.eye(3)
        for state in points[:3].T:
            product = ball.jacobian(*state) @ product
        size = 1.0 + np.max(np.abs(product))
        assert abs(np.trace(product) - 1.0 - trace) < 1e-12 * size * size
        assert abs(np.linalg.det(product) - 1.0) < 1e-12 * size * size
        kind = "elliptic" if abs(trace) < 2 else "hyperbolic" if trace > 0 else "inverse hyperbolic"
        assert str(orbits["type"].values[i]) == kind
        assert multiplier == pytest.approx(multiplier_of(trace), rel=1e-14)
        rotation = np.arccos(np.clip(trace / 2, -1, 1)) / (2 * np.pi)
        assert float(orbits["rotation_number"][i]) == pytest.approx(rotation, abs=1e-9)
        assert float(orbits["total_time"][i]) == pytest.approx(np.sum(points[3]), rel=1e-15)
    return worst


@pytest.mark.parametrize(("k", "g", "energy"), SETTINGS)
def test_orbits_of_periods_to_twelve_are_what_they_say(k, g, energy):
    ball = Ball(k, g)
    for period in PERIODS:
        orbits = symmetric_orbits(ball, energy, period)
        check(ball, energy, period, orbits)
        assert orbits.attrs["unsolved"] == 0, period  # none that was seen is left out


@pytest.mark.parametrize(
    ("k", "g", "energy", "period", "trace"),
    [
        (0.33, 0.1, 0.06, 5, -204.586359),
        (1.0, 0.1, 0.05, 9, 2.496474),
        (1.0, 0.1, 0.05, 9, -80.8446),
        (1.0, 0.1, 0.05, 4, -3181.3),
        (0.2, 0.02, 0.03, 12, -2529.7),
        (0.8381357920683287, 0.1085487373774775, 0.024725646514105436, 7, -54.6626),
    ],
)
def test_orbits_that_are_hard_to_close_are_found(k, g, energy, period, trace):
    orbits = symmetric_orbits(Ball(k, g), energy, period)
    assert np.min(np.abs(orbits["trace"].values / trace - 1)) < 1e-4


def high_precision(ball, state, taus):
    """P^n and its 3 x 3 Jacobian in 40 digits, from a state; `taus` are guesses of the flights."""
    k, g = mpf(ball.k), mpf(ball.g)
    x, v, w = state
    product = mpmath.eye(3)
    for guess in taus:
        b = ((1 - k) * v - 2 * k * w) / (1 + k)
        c = (-2 * v - (1 - k) * w) / (1 + k)
        t = mpf(guess)
        for _ in range(7):
            cosine, sine = mpmath.cos_sin(t)
            f = x + b * t + g * t * t / 2 - x * cosine + c * sine
            slope = b + g * t + x * sine + c * cosine
            t -= f / slope
        cosine, sine = mpmath.cos_sin(t)
        slope = b + g * t + x * sine + c * cosine
        gradient = [(1 - cosine), t, sine]  # of f by x, b, c
        dt = [-a / slope for a in gradient]
        q = x * sine + c * cosine
        p = x * cosine - c * sine
        flight = mpmath.matrix(
            [
                [cosine - q * dt[0], -q * dt[1], -sine - q * dt[2]],
                [g * dt[0], 1 + g * dt[1], g * dt[2]],
                [sine + p * dt[0], p * dt[1], cosine + p * dt[2]],
            ]
        )
        impact = mpmath.matrix(
            [
                [1, 0, 0],
                [0, (1 - k) / (1 + k), -2 * k / (1 + k)],
                [0, -2 / (1 + k), -(1 - k) / (1 + k)],
            ]
        )
        product = flight * impact * product
        x, v, w = p, b + g * t, q
    return (x, v, w), product


@pytest.mark.parametrize(
    ("k", "g", "energy", "period"),
    [
        (0.2, 0.04, 0.01, 1),
        (0.2, 0.04, 0.01, 6),
        (0.2, 0.04, 0.01, 9),
        (0.2, 0.04, 0.001, 10),
        (0.2, 0.04, 0.001, 12),
        (0.05, 0.004, 0.003, 5),
        (1.0, 0.1, 0.05, 3),
        (0.33, 0.1, 0.06, 11),
    ],
)
def test_trace_and_points_in_forty_digits(k, g, energy, period):
    """Newton's method in 40 digits moves a point by roundings only, and the trace there is the
    same.
    """
    ball = Ball(k, g)
    orbits = symmetric_orbits(ball, energy, period)
    assert orbits.sizes["orbit"] > 0
    with mpmath.workdps(40):
        for i in range(orbits.sizes["orbit"]):
            points = points_of(orbits, i)
            z = mpmath.matrix([mpf(a) for a in points[:3, 0]])
            for _ in range(4):
                after, product = high_precision(ball, z, points[3])
                x, v, w = z
                # the orbit is one of a family: keep to this energy
                missing = v * v / 2 + ball.k * w * w / 2 - ball.g * x + ball.k * x * x / 2
                system = mpmath.matrix(4, 3)
                system[:3, :] = product - mpmath.eye(3)
                system[3, :] = mpmath.matrix([[mpf(ball.k) * x - ball.g, v, mpf(ball.k) * w]])
                right = mpmath.matrix([*(a - b for a, b in zip(z, after, strict=True)), 0])
                right[3] = mpf(energy) - missing
                z += mpmath.lu_solve(system, right)
            moved = max(abs(float(a - b)) for a, b in zip(z, points[:3, 0], strict=True))
            trace = float(product[0, 0] + product[1, 1] + product[2, 2] - 1)
            size = max(1.0, *(abs(float(a)) for a in product))
            assert moved < 2e-15 * max(1.0, size / 50)
            assert abs(trace - float(orbits["trace"][i])) < 2e-13 * size * size


def test_the_trace_is_that_of_differences_in_forty_digits():
    """A check of the Jacobian above itself: differences on the energy surface, no derivatives."""
    orbits = symmetric_orbits(BALL, 0.01, 6)
    k, g, energy = mpf(BALL.k), mpf(BALL.g), mpf(0.01)

    def chart_map(x, y, taus):
        s = mpmath.sqrt(((1 + k) * (2 * energy + 2 * g * x - k * x * x) - y * y) / k)
        state = (x, (y + k * s) / (1 + k), (s - y) / (1 + k))
        (x, v, w), _ = high_precision(BALL, state, taus)
        return x, v - k * w

    with mpmath.workdps(40):
        h = mpf(10) ** -13
        for i in range(3):
            points = points_of(orbits, i)
            x, y = mpf(points[0, 0]), mpf(points[1, 0]) - k * mpf(points[2, 0])
            right, left = chart_map(x + h, y, points[3]), chart_map(x - h, y, points[3])
            upper, lower = chart_map(x, y + h, points[3]), chart_map(x, y - h, points[3])
            trace = (right[0] - left[0] + upper[1] - lower[1]) / (2 * h)
            assert abs(float(trace) - float(orbits["trace"][i])) < 1e-12
            det = (right[0] - left[0]) * (upper[1] - lower[1])
            det -= (upper[0] - lower[0]) * (right[1] - left[1])
            assert abs(float(det / (4 * h * h)) - 1) < 1e-12


def test_the_paper_has_three_orbits_of_period_six():
    orbits = symmetric_orbits(BALL, 0.01, 6)
    types = orbits["type"].values.tolist()
    assert sorted(types) == ["elliptic", "hyperbolic", "inverse hyperbolic"]
    saddle = of_type(orbits, "hyperbolic")
    assert float(saddle["multiplier"]) == pytest.approx(2.0417, abs=5e-5)
    assert 1 / float(saddle["multiplier"]) == pytest.approx(0.4898, abs=5e-5)
    third = of_type(orbits, "inverse hyperbolic")
    assert np.min(np.abs(third["x"].values - 0.387)) < 5e-4


@pytest.mark.parametrize("period", [10, 12])
def test_at_the_lower_energy_each_island_chain_has_its_saddles(period):
    orbits = symmetric_orbits(BALL, 0.001, period)
    assert sorted(orbits["type"].values.tolist()) == ["elliptic", "hyperbolic"]


@pytest.mark.parametrize("energy", [0.01, -0.003])
def test_nothing_found_is_an_answer_of_length_zero(energy):
    orbits = symmetric_orbits(BALL, energy, 2)
    assert orbits.sizes == {"orbit": 0, "point": 2}
    check(BALL, energy, 2, orbits)
    with pytest.raises(ValueError, match=r"elliptic.*period 2"):
        of_type(orbits, "elliptic")


def test_of_type_gives_one_orbit_or_says_what_there_is():
    orbits = symmetric_orbits(BALL, 0.01, 7)
    assert of_type(orbits, "hyperbolic").sizes == {"point": 7}
    with pytest.raises(ValueError, match=r"no elliptic orbit of period 7.*inverse hyperbolic"):
        of_type(orbits, "elliptic")


def test_answers_do_not_depend_on_what_was_asked_before():
    first = symmetric_orbits(BALL, 0.01, 6)
    symmetric_orbits(Ball(1.0, 0.3), 0.0, 3)
    symmetric_orbits(BALL, 0.001, 12)
    again = symmetric_orbits(BALL, 0.01, 6)
    assert first.identical(again)
    modulus = np.abs(first["multiplier"].values)
    assert np.all(np.diff(modulus) >= 0)


def test_a_scaled_problem_has_the_same_orbits_scaled():
    for period in (1, 6, 7):
        plain = symmetric_orbits(BALL, 0.01, period)
        scaled = symmetric_orbits(Ball(0.2, 0.04 / 8), 0.01 / 64, period)
        for name in ("x", "xdot", "udot"):
            assert np.array_equal(scaled[name].values, plain[name].values / 8)
        for name in ("tau", "trace", "multiplier", "rotation_number", "total_time"):
            assert np.array_equal(scaled[name].values, plain[name].values)


@pytest.mark.parametrize("period", [0, -6, 1.5, True, "6"])
def test_a_period_that_is_no_count_is_refused(period):
    with pytest.raises(ValueError, match="period"):
        symmetric_orbits(BALL, 0.01, period)


def test_an_energy_below_the_lowest_is_refused():
    with pytest.raises(ValueError, match="energy"):
        symmetric_orbits(BALL, -0.0041, 1)


def brute_force(ball, energy, period, cells, steps=25):
    """Symmetric orbits from Newton's method in the chart, started on a grid over the whole
    section.
    """
    k, g = ball.k, ball.g
    centre, radius = ball.section(energy)
    height = radius * np.sqrt(k * (1 + k))
    grid = np.linspace(-0.9999, 0.9999, cells)
    x, y = (a.ravel() for a in np.meshgrid(grid, grid))
    inside = x * x + y * y < 0.9999
    x, y = centre + radius * x[inside], height * y[inside]

    def gap_and_derivatives(x, y):
        state = ball.state_xy(x, y, energy)
        s = state[1] + state[2]
        s_x, s_y = (1 + k) * (g - k * x) / (k * s), -y / (k * s)
        along_x = np.stack([np.ones_like(x), k * s_x / (1 + k), s_x / (1 + k)])
        along_y = np.stack([np.zeros_like(x), (1 + k * s_y) / (1 + k), (s_y - 1) / (1 + k)])
        jacobian = ball.jacobian(*state, impacts=period)
        by_x = np.einsum("nij,jn->in", jacobian, along_x)
        by_y = np.einsum("nij,jn->in", jacobian, along_y)
        last = orbit(ball, state, period, keep="last")
        after = [last[name].values for name in NAMES[:3]]
        derivatives = (by_x[0], by_y[0], by_x[1] - k * by_x[2], by_y[1] - k * by_y[2])
        return after[0] - x, after[1] - k * after[2] - y, *derivatives

    with np.errstate(all="ignore"):
        for _ in range(steps):
            f, h, a, b, c, d = gap_and_derivatives(x, y)
            det = (a - 1) * (d - 1) - b * c
            dx, dy = ((1 - d) * f + b * h) / det, (c * f + (1 - a) * h) / det
            limit = np.minimum(1, 0.1 / np.hypot(dx / radius, dy / height))
            x, y = x + limit * dx, y + limit * dy
            good = ((x - centre) / radius) ** 2 + (y / height) ** 2 < 1
            x, y = x[good], y[good]
        f, h, a, _, _, d = gap_and_derivatives(x, y)
    solved = np.maximum(np.abs(f), np.abs(h)) < 1e-12
    found = []
    for x0, y0, trace in zip(x[solved], y[solved], (a + d)[solved], strict=True):
        if any(np.min(np.hypot(u - x0, v - y0)) < 1e-7 * radius for u, v, _ in found):
            continue
        points = orbit(ball, ball.state_xy(x0, y0, energy), period)
        u, v = points["x"].values, (points["xdot"] - k * points["udot"]).values
        if period > 1 and np.min(np.hypot(u[:-1] - x0, v[:-1] - y0)) < 1e-7 * radius:
            continue
        if np.min(np.hypot(u - x0, v + y0)) < 1e-7 * radius:
            found.append((u, v, trace))
    return found


def compare_with_brute_force(ball, energy, period, cells):
    """Every orbit that brute force finds with |trace| < 500 is in the answer."""
    radius = ball.section(energy)[1]
    orbits = symmetric_orbits(ball, energy, period)
    starts = orbits["x"].values[:, 0], (orbits["xdot"] - ball.k * orbits["udot"]).values[:, 0]
    expected = brute_force(ball, energy, period, cells)
    for u, v, trace in expected:
        near = [
            np.min(np.hypot(u - x, v - y)) < 1e-6 * radius for x, y in zip(*starts, strict=True)
        ]
        assert any(near) or abs(trace) > 500, (period, trace, u[0], v[0])
    return len(expected)


@pytest.mark.parametrize(
    ("k", "g", "energy", "periods"),
    [
        (0.2, 0.04, 0.01, (1, 2, 6)),
        (1.0, 0.1, 0.05, (3, 9)),
        (0.05, 0.004, 0.003, (5, 7)),
        (0.33, 0.1, 0.06, (5,)),
    ],
)
def test_brute_force_finds_no_orbit_that_the_search_misses(k, g, energy, periods):
    found = [compare_with_brute_force(Ball(k, g), energy, period, 70) for period in periods]
    assert sum(found) > 0


@pytest.mark.slow
@pytest.mark.parametrize(("k", "g", "energy"), SETTINGS)
def test_brute_force_on_a_fine_grid_to_period_twelve(k, g, energy):
    for period in PERIODS:
        compare_with_brute_force(Ball(k, g), energy, period, 200)
