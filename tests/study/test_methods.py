"""The study's methods: each is as accurate as its settings."""

import numpy as np
import pytest
from project import shipped

from pipeline.config import check
from pipeline.records.sources import source_files
from study import states
from study.methods import libraries
from study.methods.counted_methods import OURS, TOLERANCES, engine_method, scan_method

BALL = states.BALL


@pytest.fixture(scope="module")
def uniform():
    """States, and their flight times by the certified march."""
    columns = states.uniform(200)
    return columns, OURS.solve(BALL, *columns)[0]


def test_the_certified_march_is_the_map(uniform):
    columns, tau = uniform
    assert np.array_equal(tau, BALL.time_to_impact(*columns))


METHODS = [
    *((scan_method(0.1, tolerance), tolerance) for tolerance in TOLERANCES),
    *((engine_method(step), 2 * step) for step in (1e-2, 1e-4)),
    (libraries.brentq_method(0.1, 1e-9), 1e-8),
    (libraries.ivp_method("DOP853", 1e-9), 1e-6),
    (libraries.ivp_method("Radau", 1e-6), 1e-3),
]


def assert_accurate(method, error, columns, truth):
    tau, count = method.solve(BALL, *columns[:, :20])
    assert np.abs(tau - truth[:20]).max() <= error
    assert count.min() > 1


@pytest.mark.parametrize(("method", "error"), METHODS, ids=lambda value: getattr(value, "name", ""))
def test_a_method_is_as_accurate_as_its_settings(uniform, method, error):
    assert_accurate(method, error, *uniform)


def test_heyoka_is_as_accurate_as_its_settings(uniform):
    pytest.importorskip("heyoka")
    for direction in ("any", "positive"):
        assert_accurate(libraries.taylor_method(1e-15, direction), 1e-13, *uniform)


@pytest.mark.parametrize("height", [1e-3, -1e-3, 1e-9, -1e-9])
def test_near_misses_have_their_height(height):
    for x, v, w in states.near_miss(height, 5).T:
        s = v + w
        b, c = v - BALL.k * 2 * s / (1 + BALL.k), w - 2 * s / (1 + BALL.k)
        t = np.linspace(0.9, 6.1, 200_001)
        gap = x + t * (b + BALL.g / 2 * t) - x * np.cos(t) + c * np.sin(t)
        top = np.flatnonzero((gap[1:-1] > gap[:-2]) & (gap[1:-1] >= gap[2:])) + 1
        assert np.abs(gap[top] - height).min() < 1e-9 + 1e-3 * abs(height)


@pytest.mark.parametrize("side", [1, -1])
def test_states_at_a_distance_from_grazing(side):
    x, v, w = states.grazing_at(7, side, 50)
    assert np.all(np.abs((v + w) / 1e-7 - 1) < 1e-8)
    assert np.all(side * (x + BALL.g) >= 0)


@pytest.mark.parametrize("solver", libraries.SOLVERS)
def test_solve_ivp_sees_short_flights(solver):
    columns = states.grazing_at(6, 1, 20)
    truth = OURS.solve(BALL, *columns)[0]
    tau, _ = libraries.ivp_method(solver, 1e-9).solve(BALL, *columns)
    assert np.abs(tau / truth - 1).max() < 0.1


def test_the_figures_of_the_paper_need_nothing_of_the_study():
    specs = check(shipped()).build_specs(["paper"])
    assert not any(
        file.startswith("src/study/") for spec in specs.values() for file in spec.sources
    )


@pytest.mark.parametrize("module", ["study.stages", "study.measured"])
def test_a_comparison_loads_no_drawing(module):
    """Otherwise seconds would be measured again after a change of a drawing."""
    assert not any("figures" in file for file in source_files(module))
