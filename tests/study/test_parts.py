"""The parts of the study, its charts, and its table of speed."""

import re
from importlib import import_module

import pytest
from project import shipped

from pipeline.config import check
from pipeline.config.build_specs import build_specs
from pipeline.declaration import extensions


@pytest.mark.slow
def test_the_table_of_ratios_has_every_row(monkeypatch):
    for package in ("heyoka", "pynamicalsys"):
        pytest.importorskip(package)
    from study import bench

    for name, smaller in (("IMPACTS", 1000), ("MANY", 10.0)):
        monkeypatch.setattr(bench, name, smaller)
    more = tuple(import_module(e.benchmark) for e in extensions().values() if e.benchmark)
    for module in more:
        monkeypatch.setattr(module, "CELLS", (1, 2))
    lines = bench.run(1, more)
    labels = [
        (label, module.BASES.get(base) or bench.BASES[base])
        for module in (bench, *more)
        for label, _, base, _ in module.ROWS
    ]
    rows = [re.split(r"  +", line) for line in lines[1 : len(labels) + 1]]
    assert [(row[0], row[3]) for row in rows] == labels
    assert all(float(row[2]) > 0 for row in rows)
    assert "numba" in lines[-1] and "processor" in lines[-1]


def test_the_figures_of_the_paper_need_nothing_of_the_study():
    specs = build_specs(check(shipped()), ["paper"])
    assert not any(
        file.startswith("src/study/") for spec in specs.values() for file in spec.sources
    )
