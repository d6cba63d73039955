"""Runs of sweeps: progress, mistakes, and faults that are repaired to the same bytes."""

import hashlib
import os
import shutil
import signal

import pytest

from extensions.atlas import cell, command
from helpers.project import fresh_tree, of_scenes, wait_for
from pipeline import config
from pipeline.cli.arguments import Arguments
from pipeline.cli.errors import UsageError
from pipeline.records.artifacts import load

SMALL = {"k": [0.1, 0.2], "energy": [0.3, 2.0, 6.25], "starts": 12, "impacts": 200, "block": 2}
BOTH = ["png", "svg"]


def checked(**sweeps):
    return config.check(of_scenes("fig3", sweeps=sweeps))


@pytest.mark.parametrize(("name", "sweeps", "options", "line"), [
    (["lime"], {"plane": SMALL, "line": SMALL}, "", "no sweep lime: did you mean line"),
    ([], {}, "", "sweeps: empty"),
    ([], {"small": SMALL}, "slurm", "--slurm: there is no sbatch on this machine"),
    ([], {"small": SMALL}, "slurm gpu", "--slurm on others: choose one"),
])  # fmt: skip
def test_a_sweep_that_cannot_run_is_refused_in_one_line(monkeypatch, name, sweeps, options, line):
    monkeypatch.setenv("PATH", "/nowhere")
    given = {option: option in options for option in ("slurm", "gpu")}
    args = Arguments(word="sweep", sweep=name, options=[], **given)
    args.config = checked(**sweeps)
    with pytest.raises(UsageError, match=line):
        command.run(args)


@pytest.fixture
def tree(tmp_path):
    """A copy of the project with one small sweep."""
    return fresh_tree(tmp_path / "a fresh clone", of_scenes("fig3", sweeps={"small": SMALL}))


def set_sweep(tree, block):
    tree.write(tree.document() | {"sweeps": {"small": block}})


def hashes(tree):
    files = (tree.path / "results" / "atlas").rglob("*.nc")
    return {file.name: hashlib.sha256(file.read_bytes()).hexdigest() for file in files}


def times(tree):
    files = (tree.path / "results" / "atlas").rglob("*.nc")
    return {file.name: file.stat().st_mtime_ns for file in files}


@pytest.mark.slow
def test_no_other_command_sees_the_finer_atlas(tree):
    assert tree.succeed("atlas", "finer", "-n") == "finer: not made yet: block, data, drawing\n"
    assert "finer" not in tree.succeed("list") + tree.succeed("atlas", "-n")


@pytest.mark.slow
def test_blocks_of_another_size_or_grid_are_never_mixed_in(tree):
    tree.succeed("sweep", "-c", "1")
    before = hashes(tree)["sweep_small.nc"]
    set_sweep(tree, SMALL | {"block": 4})
    tree.succeed("sweep", "-c", "1")
    assert hashes(tree)["sweep_small.nc"] == before
    set_sweep(tree, SMALL | {"energy": [0.3, 2.0, 7.0]})
    shutil.rmtree(tree.path / ".snakemake")  # its memory of parameters
    tree.succeed("sweep", "-c", "1")
    dataset = load(tree.path / "results" / "atlas" / "sweep_small.nc")
    assert dataset["energy"].values.tolist() == [0.3, 2.0, 7.0]
    one = cell.cell(0.1, 7.0, SMALL["starts"], SMALL["impacts"])
    assert dataset.sel(k=0.1, energy=7.0)["exponent"] == one["exponent"]


@pytest.mark.slow
def test_a_killed_sweep_goes_on_to_the_same_bytes(tree):
    tree.succeed("sweep", "-c", "1")
    wanted = hashes(tree)
    folder = tree.path / "results" / "atlas"
    shutil.rmtree(folder)
    process = tree.start("sweep", "-c", "1", start_new_session=True)
    wait_for(lambda: list(folder.glob("sweep_small.*.nc")))
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    present = hashes(tree)
    assert 0 < len(present) < 4
    assert present.items() <= wanted.items()
    tree.succeed("sweep", "-c", "1")
    assert hashes(tree) == wanted


@pytest.mark.slow
def test_the_atlas_is_drawn_and_published(tree):
    line = SMALL | {"k": [0.2], "g": 0.04, "block": 3}
    chains = {"picture": "chains", "over": "small", "chains": [6]}
    sweeps = {"small": SMALL | {"k": [0.19, 0.21]}, "one": line | {"formats": BOTH}}
    tree.write(tree.document() | {"sweeps": sweeps | {"over_it": chains}})
    tree.succeed("atlas", "-c", "1")
    for name in ("small.png", "one.png", "one.svg", "over_it.png"):
        drawn = (tree.path / "results/atlas/figures" / name).read_bytes()
        assert (tree.path / "more_figures" / "atlas" / name).read_bytes() == drawn
        assert drawn.startswith((b"\x89PNG", b"<?xml"))
    before = times(tree)
    tree.succeed("atlas", "-c", "1")
    assert times(tree) == before
