"""What the study consists of, and its table of speed."""

import re

import pytest

from pipeline.config.schema import study as parts
from pipeline.records import sources
from pseudorigid.figures import study


def test_the_table_of_ratios_has_every_row(monkeypatch):
    for package in ("heyoka", "pynamicalsys"):
        pytest.importorskip(package)
    from pseudorigid.study import bench

    for name, smaller in (("IMPACTS", 1000), ("CELLS", (1, 2)), ("MANY", 10.0)):
        monkeypatch.setattr(bench, name, smaller)
    lines = bench.run(repetitions=1)
    rows = [re.split(r"  +", line) for line in lines[1:13]]
    assert [(row[0], row[3]) for row in rows] == [
        ("one orbit, an impact", "three dependent sincos"),
        ("scan 0.1 and bisection to 1e-12", "one orbit"),
        ("heyoka, default tolerance", "one orbit"),
        ("solve_ivp DOP853, rtol 1e-9", "one orbit"),
        ("spectrum by pynamicalsys, an impact", "spectrum here"),
        ("ensemble, the end only, an impact", "one dependent sincos"),
        ("ensemble, every impact stored", "one dependent sincos"),
        ("ensemble with a tangent vector each", "one dependent sincos"),
        ("spectra of an ensemble, an impact", "spectrum here"),
        ("a cell, each orbit alone and to its end", "a cell here"),
        ("weak branch, each image from the segment", "that branch here"),
        ("period 12 at E/g^2 = 1e5: 2,006 orbits", "a search finding none"),
    ]
    assert all(float(row[2]) > 0 for row in rows)
    assert "numba" in lines[-1] and "processor" in lines[-1]


def test_every_chart_has_data_and_a_function():
    for data, function, _ in parts.CHARTS.values():
        assert data in (*parts.FIXED, *parts.MEASURED)
        assert callable(getattr(study, function))


def test_the_figures_of_the_paper_need_nothing_of_the_study():
    for program in ("stage", "draw", "sweep"):
        assert not any(
            "/study" in file for file in sources.source_files(f"pipeline.jobs.{program}")
        )
