"""Work and precision: the dataset's numbers against those of an independent solver."""

import numpy as np
import pytest

from helpers.independent_solver import judge
from study import bench, stages, states
from study.methods.counted_methods import METHODS

COUNT = 60
SETS = (states.uniform, states.grazing)


@pytest.fixture(scope="module")
def truths():
    """Flight times of both sets, by mpmath to 60 digits."""
    k, g = states.BALL.k, states.BALL.g
    return [
        [judge(k, g, *state).tau for state in zip(*states_of(COUNT), strict=True)]
        for states_of in SETS
    ]


@pytest.fixture(scope="module")
def table():
    return stages.accuracy(METHODS, COUNT)


@pytest.mark.parametrize("which", range(2))
def test_each_number_is_that_of_an_independent_solver(table, truths, which):
    columns, truth = SETS[which](COUNT), truths[which]
    for i, method in enumerate(METHODS):
        tau, count = method.solve(states.BALL, *columns)
        pairs = list(zip(tau.tolist(), truth, strict=True))
        error = np.array([float(abs(a - b) / b) for a, b in pairs])
        wrong = np.array([not abs(a - b) <= min(b, 1) / 10 for a, b in pairs])
        row = table.isel(method=i, set=which)
        assert row["name"] == method.name
        close = {"rel": 1e-9, "abs": 2e-16}  # the table's truths are rounded to doubles
        assert float(row["median"]) == pytest.approx(np.median(error), **close)
        assert float(row["worst"]) == pytest.approx(max(error[~wrong], default=0), **close)
        assert float(row["wrong"]) == wrong.mean()
        for limit in (6, 12):
            above = wrong | (error > float(f"1e-{limit}"))
            assert float(row[f"above_1e{limit}"]) == pytest.approx(above.mean(), abs=1.5 / COUNT)
        assert float(row["evaluations"]) == count.mean()


def test_calls_of_the_benchmark_take_turns(monkeypatch):
    seconds = iter(range(1000))
    monkeypatch.setattr(bench.time, "process_time", lambda: float(next(seconds)))
    done = []
    timed = {
        "slow": bench.Call(lambda: done.append("slow"), 1),
        "quick": bench.Call(lambda: done.append("quick"), 4),
    }
    assert bench._interleaved(timed) == {"slow": (1.0, 1.0, 1.0), "quick": (0.25, 0.25, 0.25)}
    assert done == ["slow", "quick"] * 10  # the first call of each compiles
