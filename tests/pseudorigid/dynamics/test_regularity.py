"""The rule for regular orbits, the two ways to its numbers, and the short form of sweeps."""

import numpy as np
import pytest

import pseudorigid
from pseudorigid import Ball
from pseudorigid.dynamics import fixed_point, regularity
from pseudorigid.dynamics.lyapunov import scene_exponents
from pseudorigid.dynamics.orbits import scene_orbits
from pseudorigid.dynamics.regularity import LENGTHS, judge, judged, orbit_types
from pseudorigid.kernel import verdict

BALL = Ball(0.2, 0.04)
# The settings in which chaos is slowest, and that of Figure 2.
SETTINGS = [(0.2, 0.04, 0.001), (1 / 3, 0.05, 0.003), (0.2, 0.04, 0.01)]


def random_states(ball, energy, count, seed):
    """Return states (3, n) that are uniform over the section."""
    random = np.random.default_rng(seed)
    distance, angle = np.sqrt(random.random(count)), 2.0 * np.pi * random.random(count)
    centre, radius = ball.section(energy)
    x, y = distance * np.cos(angle), distance * np.sin(angle)
    height = radius * np.sqrt(ball.k * (1.0 + ball.k))
    return np.array(ball.state_xy(centre + radius * x, height * y, energy))


CALM = [[0.8], [0.1], [0.1], [0.1]]  # growth, winding number, and those of the halves
SEA = [[6.1], [0.1], [0.1], [0.2]]
RULE = [  # length, numbers at half of it and there, word
    (32_000, CALM, CALM, "regular"),
    (64_000, CALM, CALM, "regular"),
    (16_000, CALM, CALM, "undecided"),
    (32_000, [[1.84], [0.1], [0.1], [0.1]], [[1.4], [0.1], [0.1], [0.1]], "regular"),
    (32_000, [[1.86], [0.1], [0.1], [0.1]], [[1.4], [0.1], [0.1], [0.1]], "undecided"),
    (32_000, [[-0.14], [0.1], [0.1], [0.1]], [[0.3], [0.1], [0.1], [0.1]], "regular"),
    (32_000, [[-0.16], [0.1], [0.1], [0.1]], [[0.3], [0.1], [0.1], [0.1]], "undecided"),
    (32_000, CALM, [[1.31], [0.1], [0.1], [0.1]], "undecided"),  # its growth changes
    (32_000, CALM, [[0.29], [0.1], [0.1], [0.1]], "undecided"),
    (32_000, CALM, [[0.8], [0.1], [0.1], [0.100011]], "undecided"),  # its halves differ
    (32_000, [[0.8], [0.1], [0.100011], [0.1]], CALM, "undecided"),
    (32_000, CALM, [[0.8], [0.1], [0.1], [0.100009]], "regular"),
    (32_000, CALM, [[0.8], [6.2e-5], [6e-5], [6e-5]], "undecided"),  # less than two turns
    (32_000, CALM, [[0.8], [-6.3e-5], [-6e-5], [-6e-5]], "regular"),
    (1000, SEA, SEA, "chaotic"),
    (64_000, SEA, SEA, "chaotic"),
    (1000, SEA, [[5.9], [0.1], [0.1], [0.2]], "undecided"),
    (1000, [[5.9], [0.1], [0.1], [0.2]], SEA, "undecided"),
    (1000, SEA, [[np.nan], [0.1], [0.1], [0.1]], "undefined"),
    (500, [[np.nan]] * 4, SEA, "undecided"),
]


@pytest.mark.parametrize(("length", "before", "now", "word"), RULE)
def test_the_rule(length, before, now, word):
    assert judge(length, np.array(before), np.array(now)).tolist() == [word]


def test_each_orbit_is_judged_by_its_own_numbers():
    before, now = np.hstack([CALM, SEA, CALM]), np.hstack([CALM, SEA, SEA])
    assert judge(32_000, before, now).tolist() == ["regular", "chaotic", "undecided"]


@pytest.mark.parametrize(("k", "g", "energy"), SETTINGS)
def test_scenes_and_classify_orbits_give_the_same_words(k, g, energy):
    ball = Ball(k, g)
    states = random_states(ball, energy, 12, 5)
    found = pseudorigid.classify_orbits(ball, states)
    assert orbit_types(ball, states) == found["type"].values.tolist()
    assert {"regular", "chaotic"} <= {*found["type"].values.tolist()}


@pytest.mark.slow
@pytest.mark.parametrize(("k", "g", "energy"), SETTINGS)
def test_orbits_followed_alone_and_in_lanes_get_the_same_words(k, g, energy, monkeypatch):
    """And the same winding numbers if both count by the angle, as the lanes do."""

    def by_angle(k, orbit, centre, expected):
        p, q = orbit[0] - centre, (orbit[1] - k * orbit[2]) / np.sqrt(k * (1.0 + k))
        turns = -np.diff(np.arctan2(q, p)) / (2.0 * np.pi)
        return turns - np.floor(turns - (expected - 0.5))

    ball = Ball(k, g)
    states = random_states(ball, energy, 500, 6)
    in_lanes, alone = judged(ball, states), judged(ball, states, in_lanes=False)
    assert in_lanes[0].tolist() == alone[0].tolist()
    assert np.mean(in_lanes[2] == alone[2]) > 0.98
    monkeypatch.setattr(regularity, "_turns", by_angle)
    alone = judged(ball, states[:, 380:], in_lanes=False)
    assert np.allclose(in_lanes[1][380:], alone[1], rtol=0.0, atol=1e-11, equal_nan=True)


@pytest.mark.slow
@pytest.mark.parametrize(("k", "g", "energy"), SETTINGS)
def test_words_are_those_of_600_000_impacts(k, g, energy):
    """The truth is the growth of a tangent vector, from Jacobians of single impacts.

    Chaotic orbits whose exponent is near 5e-5, of which there is one in a thousand, may fail.
    """
    ball = Ball(k, g)
    states = random_states(ball, energy, 80, 7)
    words = np.array(orbit_types(ball, states))
    vector, size = np.array([1.0, 0.0, 0.0]) + np.zeros((80, 3)), np.zeros(80)
    for _ in range(600):
        history = ball.history(states, 1000)[..., :3]
        before = np.concatenate([states.T[:, None], history[:, :-1]], axis=1)
        jacobians = ball.jacobian(*np.moveaxis(before, -1, 0))
        for i in range(1000):
            vector = np.einsum("nij,nj->ni", jacobians[:, i], vector)
            length = np.abs(vector).sum(axis=1)
            vector, size = vector / length[:, None], size + np.log(length)
        states = history[:, -1].T
    chaotic = size > 24.0  # a regular orbit's is near ln 600,000 = 13.3
    assert not np.any((words == "regular") & chaotic)
    assert not np.any((words == "chaotic") & ~chaotic)
    assert np.sum(words == "undecided") <= 4
    assert 10 < chaotic.sum() < 75


@pytest.mark.parametrize("impacts", [1, 3000])
def test_the_word_of_an_orbit_does_not_depend_on_its_run(impacts):
    starts = np.linspace(-0.97, 0.97, 6)
    words = pseudorigid.classify_orbits(BALL, BALL.start(starts, 0.01))["type"].values
    orbits = scene_orbits(BALL, 0.01, starts.tolist(), impacts)
    assert orbits["type"].values.tolist() == words.tolist()
    exponents = scene_exponents(BALL, 0.01, starts[:3].tolist(), impacts, 1)
    assert exponents["type"].values.tolist() == words[:3].tolist()
    assert {"regular", "chaotic"} <= {*words.tolist()}


def test_a_limit_of_impacts_changes_no_word_but_leaves_orbits_undecided():
    states = random_states(BALL, 0.001, 40, 8)
    whole = pseudorigid.classify_orbits(BALL, states)
    for impacts in (100, 500, 5000, 40_000):
        some = pseudorigid.classify_orbits(BALL, states, impacts)
        expected = np.where(whole["followed"] <= impacts, whole["type"], "undecided")
        assert np.array_equal(some["type"], expected)
        assert some["followed"].max() == max([n for n in LENGTHS if n <= impacts], default=impacts)
    regular = whole["type"] == "regular"
    assert whole["followed"].values[regular].min() == 32_000
    assert np.array_equal(np.isfinite(whole["rotation_number"]), regular)


KNOWN = [  # k, g, energy, x, y or start, word: orbits that shorter rules got wrong
    (0.2, 0.04, 0.001, (0.23604103, -0.089520782), "chaotic"),
    (0.2, 0.04, 0.001, 0.894427, "chaotic"),
    (0.2, 0.04, 0.01, 0.62, "chaotic"),
    (0.2, 0.04, 0.01, 0.9999999, "chaotic"),  # along the rim, where a turn takes long
    (1e-6, 1e-9, 1e-7, -0.3, "chaotic"),
]


@pytest.mark.parametrize(("k", "g", "energy", "start", "word"), KNOWN)
def test_orbits_whose_chaos_shows_late(k, g, energy, start, word):
    ball = Ball(k, g)
    state = ball.start(start, energy) if isinstance(start, float) else ball.state_xy(*start, energy)
    start = start if isinstance(start, float) else dict(zip("xy", start, strict=True))
    assert pseudorigid.classify_orbits(ball, state)["type"].item() == word
    assert scene_orbits(ball, energy, [start], 10)["type"].item() == word


def test_an_orbit_that_makes_too_few_turns_is_undecided():
    """The least energy is -0.004, where nothing turns; nearby all is regular."""
    for above, word in ((1e-12, "undecided"), (1e-7, "regular")):
        states = np.array(BALL.start([0.3, -0.5], above - 0.004))
        assert orbit_types(BALL, states) == judged(BALL, states)[0].tolist() == [word] * 2


@pytest.mark.parametrize("start", [1.0, np.nan])
def test_an_orbit_without_a_derivative_is_undefined(start):
    states = np.array(BALL.start([start, 0.5], 0.01))
    for in_lanes in (False, True):
        types, rotation, followed = judged(BALL, states, in_lanes=in_lanes)
        assert types.tolist() == ["undefined", "chaotic"]
        assert np.isnan(rotation).all() and followed.tolist() == [500, 1000]


@pytest.mark.parametrize("energy", [-0.003, 0.01, 0.0374, 0.055])
def test_the_elliptic_fixed_point_is_regular(energy):
    """It makes no turns, and rounding errors decide the angles around it."""
    x, _, rotation = fixed_point.numbers(BALL.k, energy / BALL.g**2)
    start = {"x": x * BALL.g, "y": 0.0}
    assert scene_orbits(BALL, energy, [start], 5)["type"].item() == "regular"
    found = pseudorigid.classify_orbits(BALL, BALL.state_xy(x * BALL.g, 0.0, energy))
    assert found["type"].item() == "regular"
    assert found["rotation_number"].item() == pytest.approx(rotation, rel=1e-14)


def test_the_numbers_of_an_orbit_are_those_of_single_jacobians():
    """G after each impact, and turns by the arcus tangent, in the weights of the average."""
    state, impacts = np.array(BALL.start([-0.2], 0.01)), 1000
    orbits, centre, expected = regularity.around_fixed_point(BALL, state)
    pieces = *orbits, centre, expected
    x, v, w = np.hstack([orbits, Ball.dimensionless(0.2).history(orbits, impacts)[0, :, :3].T])
    vector, size = np.array([1.0, 0.0, 0.0]), np.empty(impacts)
    for i in range(impacts):
        vector = Ball.dimensionless(0.2).jacobian(x[i], v[i], w[i]) @ vector
        size[i] = np.log(np.abs(vector).sum())
    growth = size[750:].mean() - size[250:500].mean()
    turns = -np.diff(np.unwrap(np.arctan2((v - 0.2 * w) / 0.24**0.5, x - centre))) / (2.0 * np.pi)
    t = (np.arange(impacts) + 0.5) / impacts
    mean = np.average(turns, weights=(t * (1.0 - t)) ** 3)
    alone = [now[:2, 0] for now in regularity._numbers_alone([500, 1000], 0.2, *pieces)][-1]
    numbers = regularity._numbers_in_lanes([500, 1000], 0.2, *pieces)
    next(numbers)
    in_lanes = numbers.send(np.array([True]))[0, 0]
    assert alone[0] == pytest.approx(growth, abs=0.1)
    assert alone[1] == pytest.approx(mean, abs=1e-8)
    assert in_lanes == pytest.approx(growth, abs=1e-9)


# The short form. Halves of the winding number, growth, log of the vector's length -> regular,
# strict, lenient, decided before the end, and the same at the end, as `dynamics.verdict` says.
SHORT_FORM = [
    ((0.1, 0.1), 1.0, 9.0, "1111", "1111"),
    ((0.1, 0.1), 1.2, 9.0, "0000", "1011"),  # above half the threshold
    ((0.1, 0.1001), 1.0, 9.0, "0000", "1111"),  # winding numbers that differ
    ((0.1001, 0.1), 1.0, 9.0, "0000", "1111"),
    ((0.1, 0.1), 2.1, 9.0, "0000", "1011"),
    ((0.1, 0.1), 2.3, 9.0, "0000", "0011"),  # above the threshold
    ((0.1, 0.1), 4.3, 20.0, "0000", "0011"),
    ((0.1, 0.1), 4.5, 20.0, "0001", "0001"),  # above twice the threshold
    ((0.1, 0.1), 4.5, 14.0, "0000", "0001"),  # a vector that may be that of a regular orbit
    ((0.1, 0.1), float("nan"), 9.0, "0001", "0001"),
]


@pytest.mark.parametrize(("halves", "growth", "size", "before", "at_end"), SHORT_FORM)
def test_the_short_form(halves, growth, size, before, at_end):
    weights, quarter = (4.0, 2.0, 2.0), 100
    turned = (0.4, 2.0 * halves[0], 2.0 * halves[1])
    for end, expected in ((False, before), (True, at_end)):
        given = turned, weights, (300.0, 300.0 + quarter * growth), quarter, size, end
        winding, found, *flags = verdict.judge(*given)
        assert (winding, found) == (0.1, pytest.approx(growth, nan_ok=True))
        assert "".join(str(int(flag)) for flag in flags) == expected


def test_each_orbit_is_judged_by_its_own_sums():
    turned = np.array([[0.4, 0.8, 0.4], [0.2, 0.4, 0.2], [0.2, 0.4, 0.21]])
    grown = np.array([[3.0, 3.0, 3.0], [103.0, 903.0, 103.0]])
    winding, growth, verdicts = np.empty(3), np.empty(3), np.empty((3, 4), bool)
    sizes, weights = np.array([9.0, 20.0, 9.0]), (4.0, 2.0, 2.0)
    verdict.judge_each(turned, weights, grown, 100, sizes, False, winding, growth, verdicts)
    assert (winding.tolist(), growth.tolist()) == ([0.1, 0.2, 0.1], [1.0, 9.0, 1.0])
    assert verdicts.tolist() == [[True] * 4, [False, False, False, True], [False] * 4]
