"""Outdated results are made again, whatever times and traces of runs say."""

import base64
import os
import random
import re
import shutil
import signal
import time
from contextlib import suppress

import psutil
import pytest

from helpers.project import fresh_tree, of_scenes
from helpers.runs import FIG3, contents, rows
from helpers.verdicts import verified

PAPER = "results/paper"


def mark_incomplete(tree, *results):
    """Create the marker that a run leaves which is killed while snakemake runs a job."""
    folder = tree.path / ".snakemake" / "incomplete"
    folder.mkdir(parents=True, exist_ok=True)
    for path in results:
        (folder / base64.b64encode(path.encode()).decode()).touch()


def remove(tree, *results):
    """Remove results and their records."""
    for path in results:
        file = tree.path / path
        file.unlink()
        (tree.path / PAPER / "provenance" / f"{file.name}.json").unlink()


def test_an_edit_and_a_missing_drawing_are_noticed_whatever_the_times(done):
    """The data of the missing drawing, and a current drawing, are marked as incomplete.

    Everything else stays as it is, and records are not touched.
    """
    for i, file in enumerate(sorted((done.path / PAPER).rglob("*.*"), reverse=True)):
        os.utime(file, (i, i))
    shutil.rmtree(done.path / ".snakemake", ignore_errors=True)
    missing = f"{PAPER}/figures/fig8.png"
    before = (done.path / missing).read_bytes()
    remove(done, missing)
    mark_incomplete(done, f"{PAPER}/orbits_fig8.nc", f"{PAPER}/figures/fig4.png")
    done.edit("fig3", duration=12)
    outdated = {path.replace("periodic", "motion") for path in FIG3}
    outdated |= {f"{PAPER}/figures/fig3.svg", missing}
    assert done.planned() == outdated
    others = {
        file: file.stat().st_ino  # files are replaced as a whole
        for file in (done.path / PAPER).rglob("*.*")
        if not re.search("fig3|fig8", file.name)
        if file.suffix != ".log"  # of jobs that found their results current
    }
    states = rows(done.succeed())
    again = {path for path, state in states.items() if state == "recomputed"}
    assert again == {f"paper_figures/{name}" for name in ("fig3.png", "fig3.svg", "fig8.png")}
    assert done.planned() == set() and (done.path / missing).read_bytes() == before
    assert {file: file.stat().st_ino for file in others} == others


@pytest.fixture
def snakemake(tmp_path):
    """Return a small tree, and a function that runs a plain snakemake and returns its rules."""
    tree = fresh_tree(tmp_path / "tree", of_scenes("fig3"))

    def run(*arguments):
        result = tree.python("-m", "snakemake", "--cores", "2", *arguments)
        assert result.returncode == 0, result.stderr
        said = re.findall(r"^(?:local)?rule (\w+):", result.stdout + result.stderr, re.M)
        return {*said} - {"all"}

    return tree, run


@pytest.mark.slow
def test_a_plain_snakemake_makes_what_an_edit_outdates_and_nothing_else(snakemake):
    tree, run = snakemake
    results, whole = tree.path / "results", {"periodic", "motion", "draw_motion"}
    assert run() == whole and run() == set()
    tree.edit("fig3", duration=12)
    assert run("-n") == whole - {"periodic"}
    tree.edit("fig3", duration=16)
    assert run("-n") == run() == set()  # the edit is undone
    tree.edit("fig3", duration=12)
    run("--touch")
    assert run() == whole - {"periodic"}
    shutil.copytree(results, tree.path / "old")
    tree.edit("fig3", duration=16)
    assert run() == whole - {"periodic"}  # undone after a run
    for kept in (True, False):  # results of another commit, over the present .snakemake or without
        shutil.rmtree(results)
        shutil.copytree(tree.path / "old", results, copy_function=shutil.copy2)
        assert run() == whole - {"periodic"}
        if kept:
            shutil.rmtree(tree.path / ".snakemake")
        assert run("-n") == set()
    assert run("--forceall") == whole
    run("--delete-all-output")
    assert not [*results.glob("paper/*.nc"), *results.glob("paper/provenance/*")]
    assert run("--until", "periodic") == {"periodic"} and run() == whole - {"periodic"}


def kill(run, how):
    """Kill a run with SIGKILL: all its processes, its process group, or its first process alone."""
    processes = psutil.Process(run.pid).children(recursive=True)
    if how == "group":
        os.killpg(run.pid, signal.SIGKILL)
    run.kill()
    for process in processes if how == "all" else ():
        with suppress(psutil.NoSuchProcess):
            process.kill()
    run.wait()


@pytest.mark.slow
@pytest.mark.parametrize("number", range(3))
def test_a_run_after_a_kill_makes_every_figure(accepted, tmp_path, number):
    """Kill a run of missing and outdated results at a random moment."""
    tree, chance = accepted.copy(tmp_path / "tree"), random.Random(number)
    before = contents(tree)
    files = sorted((tree.path / PAPER).rglob("*.*"))
    for file in chance.sample(files, chance.randint(1, len(files) // 2)):
        file.unlink()
    run = tree.start(start_new_session=True)
    time.sleep(chance.uniform(0.5, 8))
    kill(run, ["all", "group", "first"][number])
    tree.succeed()
    assert verified(tree)[:3] == (0, {}, []) and contents(tree) == before
    assert tree.planned() == set()
