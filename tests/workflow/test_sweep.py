"""Runs of sweeps: progress, mistakes, and faults that are repaired to the same bytes."""

import hashlib
import os
import shutil
import signal

import pytest
from project import fresh_tree, of_scenes, wait_for
from runs import rows

from pipeline.cli.arguments import Arguments
from pipeline.cli.commands import figures
from pipeline.cli.session import UsageError
from pipeline.config import build_specs, paths
from pipeline.records.artifacts import load
from pipeline.records.build_spec import BuildSpec
from pseudorigid.sweep import cell
from snakemake_logger_plugin_reproduce import cells

SMALL = {"k": [0.1, 0.2], "energy": [0.3, 2.0, 6.25], "starts": 12, "impacts": 200, "block": 2}


def specs():
    """Build specifications of a sweep of six cells."""
    return build_specs.of_sweeps({"plane": SMALL})


@pytest.mark.parametrize(
    ("name", "sweeps", "line"),
    [
        ("lime", {"plane": SMALL, "line": SMALL}, "no sweep lime: did you mean line"),
        (None, {}, "sweeps: missing, or empty"),
    ],
)
def test_a_sweep_that_is_not_in_the_config_is_one_line(name, sweeps, line):
    names = [name] if name else []
    args = Arguments(word="sweep", sweep=names, slurm=False, options=[])
    args.config = {"sweeps": sweeps}
    with pytest.raises(UsageError, match=line):
        figures.run(args)


def test_progress_shows_rate_and_time_to_finish(monkeypatch):
    begin = "sweep: 4 of 10 cells"
    assert cells.line(10, (6, 600), 1.5) == begin
    assert cells.line(10, (6, 600), 1.5, (0.0, 9, 900)) == f"{begin}, 2 cells/s, 0 min 3 s to go"
    done = cells.line(10, (0, 0), 2.0, (0.0, 4, 400))
    assert done == "sweep: 10 of 10 cells, 2 cells/s"
    assert cells.line(10, (9, 999_900), 1.0, (0.0, 10, 10**6)).endswith("2 h 46 min to go")
    # Before the first block the jobs may compile: speed is not measured from that.
    first, second, third = paths.block_files("plane", SMALL)
    other = BuildSpec("results/claims/x.nc", "x", "x", {"cells": 24}, "stage", None, [], [])
    progress = cells.Cells(specs() | {other.result: other}, {second, third, other.result})
    assert progress.done(second) == "sweep: 4 of 6 cells"
    assert progress.done(third).startswith("sweep: 6 of 6 cells, ")
    monkeypatch.setattr(cells, "PAUSE", 1000.0)
    progress = cells.Cells(specs(), {first, second, third})
    lines = [progress.done(path) for path in (first, second, third)]
    assert [line and line.split(",")[0] for line in lines] == [
        "sweep: 2 of 6 cells",
        None,
        "sweep: 6 of 6 cells",
    ]


@pytest.fixture
def tree(tmp_path):
    """A copy of the project with one small sweep."""
    return fresh_tree(tmp_path / "a fresh clone", of_scenes("fig3", sweeps={"small": SMALL}))


def set_sweep(tree, block):
    tree.write(tree.document() | {"sweeps": {"small": block}})


def hashes(tree):
    """File -> sha256 of the sweep's data."""
    files = (tree.path / "results" / "sweep").rglob("*.nc")
    return {file.name: hashlib.sha256(file.read_bytes()).hexdigest() for file in files}


def times(tree):
    """File -> its time of change, of the sweep's data."""
    files = (tree.path / "results" / "sweep").rglob("*.nc")
    return {file.name: file.stat().st_mtime_ns for file in files}


def test_damaged_files_alone_are_made_again(tree):
    tree.make_here("results/sweep/small.nc")
    before, content = times(tree), hashes(tree)
    assert len(before) == 4
    assert rows(tree.succeed("sweep", "small")) == {"results/sweep/small.nc": "current"}
    assert times(tree) == before
    folder = tree.path / "results" / "sweep"
    damaged = ["small.nc", sorted(folder.glob("small_*.nc"))[1].name]
    for name in damaged:
        (folder / name).write_bytes((folder / name).read_bytes()[:3000])
    out = tree.succeed("sweep")
    for name in damaged:
        assert f"results/sweep/{name}: changed after it was made: made again" in out
    assert "sweep: 6 of 6 cells" in out
    assert rows(out) == {"results/sweep/small.nc": "recomputed"}
    assert hashes(tree) == content
    assert {name for name in before if times(tree)[name] != before[name]} == set(damaged)


@pytest.mark.slow
def test_blocks_of_another_size_or_grid_are_never_mixed_in(tree):
    tree.succeed("sweep", "-c", "1")
    before = hashes(tree)["small.nc"]
    set_sweep(tree, SMALL | {"block": 4})
    tree.succeed("sweep", "-c", "1")
    assert hashes(tree)["small.nc"] == before
    set_sweep(tree, SMALL | {"energy": [0.3, 2.0, 7.0]})
    shutil.rmtree(tree.path / ".snakemake")  # its memory of parameters
    tree.succeed("sweep", "-c", "1")
    data = load(tree.path / "results" / "sweep" / "small.nc")
    assert data["energy"].values.tolist() == [0.3, 2.0, 7.0]
    one = cell.cell(0.1, 7.0, SMALL["starts"], SMALL["impacts"])
    assert data.sel(k=0.1, energy=7.0)["exponent"] == one["exponent"]


@pytest.mark.slow
def test_a_killed_sweep_goes_on_to_the_same_bytes(tree):
    tree.succeed("sweep", "-c", "1")
    wanted = hashes(tree)
    folder = tree.path / "results" / "sweep"
    shutil.rmtree(folder)
    process = tree.start("sweep", "-c", "1", start_new_session=True)
    wait_for(lambda: list(folder.glob("small_*.nc")))
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    present = hashes(tree)
    assert 0 < len(present) < 4
    assert present.items() <= wanted.items()
    tree.succeed("sweep", "-c", "1")
    assert hashes(tree) == wanted


def test_slurm_needs_sbatch(monkeypatch):
    monkeypatch.setenv("PATH", "/nowhere")
    args = Arguments(word="sweep", sweep=[], slurm=True, options=[])
    args.config = {"sweeps": {"small": SMALL}}
    with pytest.raises(UsageError, match="--slurm: there is no sbatch on this machine"):
        figures.run(args)


@pytest.mark.slow
def test_the_atlas_is_drawn_and_published(tree):
    line = SMALL | {"k": [0.2], "g": 0.04, "block": 3}
    chained = SMALL | {"k": [0.19, 0.21], "chains": [6]}
    tree.write(tree.document() | {"sweeps": {"small": chained, "one": line}})
    tree.succeed("atlas", "-c", "1")
    # Vectors of a plane would be heavy.
    for name in ("small.png", "small_chains.png", "one.png", "one.svg"):
        drawn = (tree.path / "results/sweep/figures" / name).read_bytes()
        assert (tree.path / "more_figures" / "atlas" / name).read_bytes() == drawn
        assert drawn.startswith((b"\x89PNG", b"<?xml"))
    before = times(tree)
    tree.succeed("atlas", "-c", "1")
    assert times(tree) == before
