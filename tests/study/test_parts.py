"""The parts of the study, its charts, and its table of speed."""

import re

import pytest

from pipeline.config.schema import study as parts
from pipeline.records import sources
from pseudorigid.figures import study


@pytest.mark.slow
def test_the_table_of_ratios_has_every_row(monkeypatch):
    for package in ("heyoka", "pynamicalsys"):
        pytest.importorskip(package)
    from pseudorigid.study import bench

    for name, smaller in (("IMPACTS", 1000), ("CELLS", (1, 2)), ("MANY", 10.0)):
        monkeypatch.setattr(bench, name, smaller)
    lines = bench.run(repetitions=1)
    rows = [re.split(r"  +", line) for line in lines[1:13]]
    labels = [(label, bench.BASES[base]) for label, _, base, _ in bench.ROWS]
    assert [(row[0], row[3]) for row in rows] == labels
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
