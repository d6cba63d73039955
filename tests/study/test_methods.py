"""The study's methods: each is as accurate as its settings."""

import re

import numpy as np
import pytest

from helpers.project import ROOT
from pipeline.records.sources import source_files
from study import stages, states
from study.methods import libraries
from study.methods.counted_methods import (
    BEST_METHODS,
    BEST_SCAN,
    INFLECTIONS,
    OURS,
    PARABOLA,
    ROTATED_MARCH,
    ROTATED_SCAN,
    TOLERANCES,
    careful_method,
    engine_method,
    scan_method,
)

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
    *((careful_method(step), 2e-14) for step in (1.0, 0.5, 0.25)),
    *((method, 2e-14) for method in (ROTATED_SCAN, ROTATED_MARCH, BEST_SCAN)),
    (careful_method(0.5, PARABOLA), 2e-14),
    (libraries.ivp_method("DOP853", 1e-9, False), 1e-6),
    *((libraries.ivp_method(solver, 1e-9), 1e-7) for solver in libraries.RTOLS),
]


def assert_accurate(method, error, columns, truth):
    tau, count = method.solve(BALL, *columns[:, :20])
    assert np.abs(tau - truth[:20]).max() <= error
    assert count.min() >= 1 and count.mean() > 1


@pytest.mark.parametrize(("method", "error"), METHODS, ids=lambda value: getattr(value, "name", ""))
def test_a_method_is_as_accurate_as_its_settings(uniform, method, error):
    assert_accurate(method, error, *uniform)


def test_libraries_of_the_study_are_as_accurate_as_their_settings(uniform):
    pytest.importorskip("heyoka")
    pytest.importorskip("CyRK")
    assert_accurate(libraries.taylor_method(1e-15, False), 1e-13, *uniform)
    assert_accurate(libraries.taylor_method(1e-15), 1e-14, *uniform)
    assert_accurate(libraries.cyrk_method("DOP853", 1e-9), 1e-7, *uniform)


def test_an_orbit_in_one_call_of_heyoka_is_that_of_the_map():
    pytest.importorskip("heyoka")
    start = states.chaotic()
    track = libraries.taylor_orbit(BALL, start, 40)
    assert np.abs(track - BALL.history(start, 40)[0].T).max() < 1e-9  # errors grow


TUNED = [careful_method(0.5), *(libraries.ivp_method(s, 1e-9) for s in libraries.RTOLS)]


@pytest.mark.parametrize("method", TUNED, ids=lambda method: method.name)
def test_a_tuned_method_is_wrong_at_no_grazing_state_and_no_touch(method):
    for side in (1, -1):
        for exponent in (2, 8, 12):
            columns = states.grazing_at(exponent, side, 8)
            assert not stages.wrong_roots([method], columns).any(), (side, exponent)
    assert not stages.wrong_roots([method], states.near_miss(1e-6, 8)).any()


def test_the_simple_bound_passes_first_roots_near_grazing_that_the_other_does_not():
    columns = states.grazing(800)
    wrong = stages.wrong_roots([careful_method(0.5), careful_method(0.5, PARABOLA)], columns)
    assert wrong.sum(axis=1).tolist() == [0, 8]


def test_recorded_numbers_are_those_of_the_methods():
    """A part of what was recorded is computed again, for DOP853."""
    name, count = "tuned DOP853, 1e-06", 500
    (method,) = (m for m in libraries.TUNED if m.name == name)
    row = stages.recorded("work")
    row = row.isel(method=row["name"].values.tolist().index(name), set=0)
    assert int(row["states"]) == count
    columns = states.uniform(count)[:, :40]
    tau, evaluations = method.solve(BALL, *columns)
    error = np.abs(tau / stages.proved_times(BALL, columns) - 1)
    assert error.max() <= float(row["worst"]) * 1.001
    assert evaluations.mean() == pytest.approx(float(row["evaluations"]), rel=0.2)


def test_the_page_has_the_numbers_of_the_study():
    page = " ".join((ROOT / "src/study/README.md").read_text(encoding="utf-8").split())
    flights, search = stages.recorded("flights"), stages.recorded("search")
    missed = dict(zip(flights["long_name"].values, flights["long_missed"].values, strict=True))
    assert missed[ROTATED_SCAN.name][-1] == missed[BEST_SCAN.name][-1]
    assert f"miss {missed[BEST_SCAN.name][-1]} each." in page
    assert [missed[m.name][-1] for m in (OURS, ROTATED_MARCH, INFLECTIONS)] == [0, 0, 0]
    searched = search["searched_name"].values.tolist()
    rivals = (ROTATED_SCAN, "scan by rotation"), (ROTATED_MARCH, "march by table")
    for method, name in ((OURS, "certified march"), (INFLECTIONS, "inflections"), *rivals):
        count = int(search["passed"].values[searched.index(method.name), 2])
        assert re.search(rf"\| {name} \| {count:,} \|", page)
    for method in BEST_METHODS:
        _, counts = method.counted(BALL, *states.uniform(20_000))
        numbers = " | ".join(f"{count:.2f}".removesuffix("0.00") or "" for count in counts.mean(1))
        row = f"| {method.name.removeprefix('careful ')} | {numbers} |"
        assert re.sub(r" +", " ", row) in re.sub(r" +", " ", page), row


def test_recorded_states_make_methods_fail_and_not_the_march():
    data = stages.recorded("search").isel(drawn=[0, 1])
    names = data["searched_name"].values.tolist()
    for method in (OURS, INFLECTIONS):
        assert data["failed"].values[names.index(method.name)].tolist() == [0, 0]
    for method in (BEST_SCAN, *map(careful_method, (1.0, 0.5, 0.25))):
        found = data["found"].values[names.index(method.name)].reshape(-1, 3).T
        wrong = stages.wrong_roots([method, OURS, INFLECTIONS], found)
        assert wrong.mean(axis=1).tolist() == [1.0, 0.0, 0.0]


@pytest.mark.parametrize("height", [1e-3, -1e-3, 1e-9, -1e-9])
def test_near_misses_have_their_height(height):
    for x, v, w in states.near_miss(height, 5).T:
        s = v + w
        b, c = v - BALL.k * 2 * s / (1 + BALL.k), w - 2 * s / (1 + BALL.k)
        t = np.linspace(0.9, 6.1, 200_001)
        gap = x + t * (b + BALL.g / 2 * t) - x * np.cos(t) + c * np.sin(t)
        top = np.flatnonzero((gap[1:-1] > gap[:-2]) & (gap[1:-1] >= gap[2:])) + 1
        assert np.abs(gap[top] - height).min() < 1e-9 + 1e-3 * abs(height)


def test_a_comparison_loads_no_drawing():
    assert not any("figures" in file for file in source_files("study.stages"))
