"""What the study's stages load, and its table of speed."""

import re
from importlib import import_module

import pytest
from project import shipped

from pipeline.config import check
from pipeline.config.build_specs import build_specs
from pipeline.declaration import extensions
from pipeline.records.sources import source_files


@pytest.mark.slow
def test_the_table_of_ratios_has_every_row(monkeypatch):
    for package in ("heyoka", "pynamicalsys"):
        pytest.importorskip(package)
    from study import bench

    monkeypatch.setattr(bench, "IMPACTS", 1000)
    monkeypatch.setattr(bench, "MANY", 10.0)
    more = tuple(import_module(e.benchmark) for e in extensions().values() if e.benchmark)
    for module in more:
        monkeypatch.setattr(module, "CELLS", (1, 2))
    calls = {name: call for module in (bench, *more) for name, call in module.calls().items()}
    lines = bench.run(1, more)
    compared = [(name, call.base) for name, call in calls.items() if call.base]
    rows = [re.split(r"  +", line) for line in lines[1 : len(compared) + 1]]
    assert [(row[0], row[3]) for row in rows] == compared
    assert all(float(row[2]) > 0 for row in rows)
    assert "numba" in lines[-1] and "processor" in lines[-1]


def test_the_figures_of_the_paper_need_nothing_of_the_study():
    specs = build_specs(check(shipped()), ["paper"])
    assert not any(
        file.startswith("src/study/") for spec in specs.values() for file in spec.sources
    )


@pytest.mark.parametrize("module", ["study.stages", "study.measured"])
def test_a_comparison_loads_no_drawing(module):
    """Otherwise seconds would be measured again after a change of a drawing."""
    assert not any("figures" in file for file in source_files(module))
