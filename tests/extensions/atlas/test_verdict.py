"""Verdicts on orbits, and the study of their errors and costs."""

import numpy as np
import pytest

import pseudorigid
from extensions.atlas import cell, starts, verdicts
from extensions.atlas.symmetry_line import regular, winding
from pseudorigid import Ball
from pseudorigid.dynamics import fixed_point, verdict

K, E = 0.2, 6.25


def classify(states, impacts):
    """Verdicts on states, with turns around the fixed point."""
    x, _, rotation = fixed_point.numbers(K, E)
    count = len(states[0])
    return verdict.classify_orbits(K, states, np.full(count, x), np.full(count, rotation), impacts)


def test_an_early_verdict_is_that_of_a_longer_run():
    states = starts.sunflower_points(K, E, 300)
    short, long = classify(states, 2000), classify(states, 8000)
    early = short.followed < 2000
    assert 0.8 < early.mean() < 1.0
    for name in ("regular", "strict", "lenient", "winding", "growth", "exponent", "followed"):
        assert np.array_equal(getattr(short, name)[early], getattr(long, name)[early])
    assert np.array_equal(short.strict[early], short.lenient[early])
    assert np.all(long.followed[~early] > 1000)


def test_growth_is_that_of_a_product_of_jacobians():
    impacts = 400
    states = np.array(starts.sunflower_points(K, E, 6))
    found = classify(states, impacts)
    ball = Ball.dimensionless(K)
    for i, start in enumerate(states.T):
        state = start
        vector, logs = np.array([0.0, K * state[2], -state[1]]), []
        for _ in range(impacts):
            vector = ball.jacobian(*state) @ vector
            state = ball.impact(*state)[:3]
            logs.append(np.log(np.abs(vector).sum()))
        growth = np.mean(logs[300:]) - np.mean(logs[100:200])
        assert found.growth[i] == pytest.approx(growth, abs=1e-4)
        assert found.exponent[i] == pytest.approx((logs[399] - logs[99]) / 300, abs=1e-4)


def test_frozen_verdicts():
    """Counts of 2,000 short orbits, of which some lie on either side of each threshold."""
    shares = cell.cell(0.2, 9.0, 2000, 500)
    counts = {name: round(2000 * float(shares[name])) for name in shares if "regular" in name}
    expected = {"regular_strict": 333, "regular": 367, "regular_lenient": 379}
    assert expected.items() <= counts.items()


def test_the_best_threshold_makes_fewest_verdicts_wrong():
    rng = np.random.default_rng(3)
    for shift in (-3.0, 0.0, 1.0, 3.0):
        truth = rng.random(60) < 0.5
        values = rng.normal(0.0, 1.0, 60) + shift * ~truth
        wrong = [np.sum((values < t) != truth) for t in values]
        found = verdicts._best_threshold(values, truth)
        assert found in values and np.sum((values < found) != truth) == min(wrong)


def test_alignment_is_that_of_two_vectors_of_the_energy_surface(monkeypatch):
    lengths = (3, 20, 60)
    monkeypatch.setattr(verdicts, "LENGTHS", lengths)
    states = np.array(starts.sunflower_points(K, E, 5))
    x, _, rotation = fixed_point.numbers(K, E)
    found = verdicts._alignment(K, states, np.full(5, x), np.full(5, rotation))
    ball = Ball.dimensionless(K)
    for i, start in enumerate(states.T):
        position, v, w = start
        slope = (1.0 - K * position) / (v * v + (K * w) * (K * w))
        pair = np.array([[0.0, K * w, -v], [1.0, slope * v, slope * w * K]])
        normal = np.array([K * position - 1.0, v, K * w])  # of the energy surface
        assert pair @ normal == pytest.approx([0.0, 0.0], abs=1e-12)
        for row, length in enumerate(lengths):
            product = ball.jacobian(*start, impacts=length)
            a, b = (product @ vector / np.linalg.norm(product @ vector) for vector in pair)
            least = min(np.linalg.norm(a - b), np.linalg.norm(a + b))
            assert -found[row, i] == pytest.approx(least, abs=1e-6)


def test_megno_is_its_sum_over_impacts():
    """2/n times the sum of i times the growth of impact i, averaged over n."""
    sizes = np.cumsum(np.random.default_rng(4).uniform(0.0, 0.1, 4000))
    steps = np.diff(sizes, prepend=0.0)
    n = np.arange(1, 4001)
    megno = 2.0 * np.cumsum(n * steps) / n
    assert verdicts._megno(sizes[:, None]).item() == pytest.approx(megno.mean(), rel=2e-3)
    regular = np.log(n)[:, None] * 1.0
    assert verdicts._megno(regular).item() == pytest.approx(2.0, abs=0.02)


def test_errors_and_costs_are_counted_against_the_truth(monkeypatch):
    """Made-up quantities of four orbits in each piece."""
    truth = np.array([True, True, False, False])

    def of_piece(k, states, e):
        words = np.tile([True, False, False, True], (8, 1))
        return {
            "growth": np.tile([1.0, 4.0, 2.0, 9.0], (8, 1)),
            "alignment": np.tile(-1.0 * truth, (8, 1)),
            "megno": np.tile([2.0, 2.0, 9.0, 9.0], (8, 1)),
            "unsettled": np.tile([3.0, 1.0, 2.0, 4.0], (8, 1)), "truth": truth,
            "short form, regular": words, "short form, chaotic": ~words,
            "short form, followed": np.tile([1.0, 2.0, 3.0, 4.0], (8, 1)),
            "rule, regular": words, "rule, chaotic": np.tile([False, True, False, False], (8, 1)),
            "rule, followed": np.tile([5.0, 2.0, 3.0, 4.0], (8, 1)),
        }  # fmt: skip

    monkeypatch.setattr(verdicts, "_quantities", of_piece)
    data = verdicts.verdicts(cells=1, orbits=4, each=4)
    assert data["place"].values.tolist()[0] == "the plane of the atlas"
    shares = (data[n].values for n in ("missed", "alarms", "undecided", "cost"))
    missed, alarms, undecided, cost = shares
    wrong = missed + alarms
    assert data["orbits"].values.tolist() == [4] * 4 and (data["regular"] == 0.5).all()
    assert (missed[:, 0] == 0.25).all() and (alarms[:, 0] == 0.25).all()  # one threshold
    assert (wrong[:, [1, 2]] == 0.0).all() and (wrong[:, 3] == 0.25).all()
    assert (missed[:, [4, 5]] == 0.25).all() and (alarms[:, [4, 5]] == 0.25).all()
    assert (undecided[:, :5] == 0.0).all() and (undecided[:, 5] == 0.25).all()
    assert (cost[:, 4] == 2.5).all() and (cost[:, 5] == 3.5).all()
    assert (cost[0, 0] == verdicts.LENGTHS).all()
    assert np.allclose(data["time"].values[:, 5], 3.5 * verdicts.METHODS["rule"][2])


def test_the_truth_is_that_of_the_rule_on_a_small_piece():
    """The quantities of the sections' orbits agree with `classify_orbits`."""
    states = np.array(starts.sunflower_points(K, E, 6))
    found = verdicts._quantities(K, states, E)
    words = pseudorigid.classify_orbits(Ball.dimensionless(K), states)["type"].values
    assert np.array_equal(found["rule, regular"][-1], words == "regular")
    assert np.array_equal(found["rule, chaotic"][-1], words == "chaotic")
    assert np.array_equal(found["truth"], words == "regular")
    assert not found["rule, regular"][:-2].any()


def test_one_threshold_finds_the_same_edges_along_the_symmetry_line():
    ball, places = Ball(0.2, 0.04), np.linspace(-0.97, 0.97, 50)
    words = pseudorigid.classify_orbits(ball, ball.start(places, 0.01))["type"].values
    by_growth = regular(winding(ball, 0.01, places, 20_000)[1], 20_000)
    assert np.array_equal(by_growth, words == "regular")
    assert 3 < by_growth.sum() < 47
