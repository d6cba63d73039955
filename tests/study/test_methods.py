"""The study: its methods, its judge, its sets of states and its charts.

What needs the packages of requirements/study.txt is skipped where they are not installed.
"""

import os
import re
import subprocess
import sys

import numpy as np
import pytest
import xarray as xr
from conftest import ROOT

from pipeline.config.declared import study as parts
from pipeline.records import sources
from pseudorigid import Ball, lyapunov_spectrum
from pseudorigid.figures import study
from pseudorigid.figures.axes import panel
from pseudorigid.study import failures, states
from pseudorigid.study.methods import counted, scipy_events
from pseudorigid.study.methods.counted import OURS, engine_method, scan_method
from pseudorigid.study.work import is_wrong

BALL = states.BALL


def test_ours_is_the_map_itself():
    columns = states.uniform(200)
    tau, looks = OURS.solve(BALL, *columns)
    assert np.array_equal(tau, BALL.time_to_impact(*columns))
    assert looks.min() >= 1


@pytest.mark.parametrize("tolerance", counted.TOLERANCES)
def test_a_scan_is_as_accurate_as_its_tolerance(tolerance):
    columns = states.uniform(300)
    tau, count = scan_method(0.1, tolerance).solve(BALL, *columns)
    assert np.abs(tau - OURS.solve(BALL, *columns)[0]).max() <= tolerance
    assert count.min() > 1


def test_an_engine_is_as_accurate_as_its_time_step():
    columns = states.uniform(100)
    truth = OURS.solve(BALL, *columns)[0]
    coarse, fine = (
        np.median(np.abs(engine_method(step).solve(BALL, *columns)[0] - truth))
        for step in (1e-2, 1e-3)
    )
    assert fine < 1e-3 < coarse < 1e-2


def test_a_scan_flies_through_the_floor_where_the_ball_just_touches_it():
    columns = states.near_miss(1e-8, 30)
    truth = OURS.solve(BALL, *columns)[0]
    tau, _ = scan_method(0.1, 1e-12).solve(BALL, *columns)
    assert np.mean(tau > truth + 0.1) > 0.9


def test_the_energy_does_not_see_that_impacts_were_missed():
    scan, start = scan_method(0.5, 1e-12), states.chaotic()
    columns, truth = failures.certified_orbit(BALL, start, 50_000)
    assert is_wrong(scan.solve(BALL, *columns)[0], truth).sum() > 5
    track, _ = scan.orbit(BALL, start, 50_000)
    assert failures.energy_drift(BALL, start, track)[-1] < 1e-9
    assert not is_wrong(OURS.solve(BALL, *columns)[0], truth).any()


def test_near_misses_have_their_height():
    for depth in (1e-3, -1e-3, 1e-9, -1e-9):
        for x, v, w in states.near_miss(depth, 5).T:
            s = v + w
            b, c = v - BALL.k * 2 * s / (1 + BALL.k), w - 2 * s / (1 + BALL.k)
            t = np.linspace(0.9, 6.1, 200_001)
            gap = x + t * (b + BALL.g / 2 * t) - x * np.cos(t) + c * np.sin(t)
            top = np.flatnonzero((gap[1:-1] > gap[:-2]) & (gap[1:-1] >= gap[2:])) + 1
            assert np.abs(gap[top] - depth).min() < 1e-9 + 1e-3 * abs(depth)


@pytest.mark.parametrize("side", [1, -1])
def test_states_at_a_distance_from_grazing(side):
    x, v, w = states.grazing_at(7, side, 50)
    assert np.all(np.abs((v + w) / 1e-7 - 1) < 1e-8)
    assert np.all(side * (x + BALL.g) >= 0)


def test_brentq_and_solve_ivp_find_easy_roots():
    columns = states.uniform(20)
    truth = OURS.solve(BALL, *columns)[0]
    for method, error in (
        (scipy_events.brentq_method(0.1, 1e-9), 1e-8),
        (scipy_events.ivp_method("DOP853", 1e-9), 1e-6),
        (scipy_events.ivp_method("Radau", 1e-6), 1e-3),
    ):
        tau, count = method.solve(BALL, *columns)
        assert np.abs(tau - truth).max() < error
        assert count.min() > 5


@pytest.mark.parametrize("solver", scipy_events.SOLVERS)
def test_solve_ivp_sees_short_flights(solver):
    columns = states.grazing_at(6, 1, 20)
    truth = OURS.solve(BALL, *columns)[0]
    tau, _ = scipy_events.ivp_method(solver, 1e-9).solve(BALL, *columns)
    assert np.abs(tau / truth - 1).max() < 0.1


def test_heyoka_finds_easy_roots():
    pytest.importorskip("heyoka")
    from pseudorigid.study.methods import taylor

    columns = states.uniform(20)
    truth = OURS.solve(BALL, *columns)[0]
    for direction in taylor.DIRECTIONS:
        tau, _ = taylor.taylor_method(1e-15, direction).solve(BALL, *columns)
        assert np.abs(tau - truth).max() < 1e-13


def test_pynamicalsys_finds_the_exponents_of_the_same_orbit():
    pytest.importorskip("pynamicalsys")
    from pseudorigid.study.methods import toolkit

    start, impacts = states.chaotic(), 20_000
    found = np.sort(toolkit.spectrum(BALL, start, impacts))[::-1]
    ours = lyapunov_spectrum(BALL, start, impacts, records=1)["exponent"].values[-1]
    assert np.abs(found - ours).max() < 1e-3  # it starts from other tangent vectors


def test_the_judge_agrees_with_the_map():
    from pseudorigid.proofs import judge

    sets = [states.uniform(100), states.grazing(100), states.near_miss(-1e-9, 20)]
    sets += [states.grazing_at(e, side, 10) for e in (0, 6, 12) for side in (1, -1)]
    for columns in sets:
        truth = np.array(judge.flight_times(BALL, *columns))
        assert np.abs(OURS.solve(BALL, *columns)[0] / truth - 1).max() < 1e-14


@pytest.mark.parametrize(("k", "g"), [(1.0, 1.0), (0.01, 1e-4), (1 / 3, 0.3), (0.2, 1e-3)])
def test_the_judge_agrees_for_other_balls_and_long_flights(k, g):
    from pseudorigid.proofs import judge

    random = np.random.default_rng(7)
    ball = Ball(k=k, g=g)
    x, v, w = random.uniform(-0.5, 0.5, (3, 40))
    w = np.maximum(w, 1e-3 - v)
    truth = np.array(judge.flight_times(ball, x, v, w))
    tau = ball.time_to_impact(x, v, w)
    # where two roots all but meet, tau is defined to the root of a rounding
    assert np.median(np.abs(tau / truth - 1)) < 1e-15
    assert np.abs(tau / truth - 1).max() < 1e-7


def test_the_judge_knows_a_ball_at_rest():
    from pseudorigid.proofs import judge

    assert judge.first_root(0.2, 0.04, 0.1, 0.05, -0.05) == 0


def test_decades_are_placed_by_our_own_logarithm():
    assert panel.log10([1e-12, 1.0, 1e3]) == pytest.approx([-12, 0, 3], abs=1e-14)
    assert np.isnan(panel.log10([0.0, -1.0])).all()
    axis = panel.Axis((-4, 0), (-4, 0), decades=True)
    assert axis.fraction([1e-2]) == pytest.approx([0.5])


def named(count):
    return {
        "name": ("method", np.array([f"m{i}" for i in range(count)], dtype=object)),
        "family": ("method", np.array(["certified march"] * count, dtype=object)),
    }


def test_the_table_of_ratios_has_every_row(monkeypatch):
    for package in ("heyoka", "pynamicalsys"):
        pytest.importorskip(package)
    from pseudorigid.study import bench

    monkeypatch.setattr(bench, "IMPACTS", 1000)
    lines = bench.run(repetitions=1)
    rows = [re.split(r"  +", line) for line in lines[1:8]]
    assert [(row[0], row[3]) for row in rows] == [
        ("one orbit, an impact", "three dependent sincos"),
        ("scan 0.1 and bisection to 1e-12", "one orbit"),
        ("heyoka, default tolerance", "one orbit"),
        ("solve_ivp DOP853, rtol 1e-9", "one orbit"),
        ("spectrum by pynamicalsys", "spectrum here"),
        ("ensemble, the end only", "one dependent sincos"),
        ("ensemble, every impact stored", "one dependent sincos"),
    ]
    assert all(float(row[2]) > 0 for row in rows)
    assert "numba" in lines[-1] and "processor" in lines[-1]


def test_charts_can_be_drawn():
    table = np.full((3, 2), 0.5)
    names = ("median", "worst", "wrong", "evaluations", "seconds", "seconds_low", "seconds_high")
    data = xr.Dataset(named(3) | {name: (("method", "set"), table) for name in names})
    for cost in ("evaluations", "seconds"):
        assert study.work(data, 1, cost).get_size_inches()[0] == 3.5
    data = xr.Dataset(
        named(2)
        | {
            "near": (("method", "side", "distance"), np.zeros((2, 2, 3))),
            "touch": (("method", "side", "depth"), np.ones((2, 2, 3))),
            "distance": ("distance", [0, 6, 12]),
            "depth": ("depth", [2, 8, 14]),
        }
    )
    assert study.edges(data).get_size_inches()[0] == 3.5


def test_every_chart_has_data_and_a_function():
    for data, function, _ in parts.CHARTS.values():
        assert data in (*parts.FIXED, *parts.MEASURED)
        assert callable(getattr(study, function))


def test_the_figures_of_the_paper_need_nothing_of_the_study():
    for script in (ROOT / "workflow" / "scripts").glob("*.py"):
        if script.name not in ("study.py", "chart.py", "job.py"):
            assert not any("/study" in file for file in sources.code(script.name))
    code = "import sys, pseudorigid.config; sys.exit('pseudorigid.study' in sys.modules)"
    environment = os.environ | {"PYTHONPATH": str(ROOT / "src")}
    result = subprocess.run([sys.executable, "-c", code], check=False, env=environment)
    assert result.returncode == 0


def test_the_studys_packages_are_pinned_hashed_and_those_of_the_lock():
    text = (ROOT / "requirements" / "study.txt").read_text()
    assert "://" not in text
    pins = dict(re.findall(r"^([\w.-]+)==([^\s;\\]+)", text, re.MULTILINE))
    lock = (ROOT / "requirements" / "lock.txt").read_text()
    locked = dict(re.findall(r"^([\w.-]+)==([^\s;\\]+)", lock, re.MULTILINE))
    assert {"heyoka", "pynamicalsys"} <= set(pins)
    assert all(version == locked.get(name, version) for name, version in pins.items())
    for entry in re.split(r"^(?=[a-z0-9])", text, flags=re.MULTILINE)[1:]:
        assert "--hash=sha256:" in entry
