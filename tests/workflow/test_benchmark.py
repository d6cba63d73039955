"""./reproduce benchmark times whole runs in a copy of the project."""

import pytest
from project import fresh_tree, of_scenes

from pipeline.cli.commands import benchmark


@pytest.mark.slow
def test_whole_runs_are_measured_in_a_copy(tmp_path, monkeypatch):
    tree = fresh_tree(tmp_path / "a fresh clone", of_scenes("fig3"))
    monkeypatch.setattr(benchmark, "ROOT", tree.path)
    monkeypatch.setattr(benchmark, "REPETITIONS", 1)
    (tmp_path / "copy").mkdir()
    header, *lines = benchmark._runs(tmp_path / "copy")
    assert header.split() == ["whole", "runs", "s", "ratio"]
    assert len(lines) == 4
    assert lines[1].startswith("the same, a Python for each job") and lines[1].endswith(" 1.00")
    drawn = (tmp_path / "copy/results/paper/figures/fig3.png").read_bytes()
    assert drawn.startswith(b"\x89PNG")
    assert not (tree.path / "results").exists()
    # The times are those of a clock: a Python starts and snakemake loads.
    assert all(0.2 < float(line.split("(")[0].split()[-1]) < 200 for line in lines)
