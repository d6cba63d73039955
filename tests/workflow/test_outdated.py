"""What snakemake is told of outdated results: by content, whatever times and traces of runs say."""

import base64
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time
from contextlib import suppress

import psutil
import pytest
from project import ROOT, Tree, fresh_tree, shipped
from runs import FIG3, rows
from slowly import slowly

from pipeline.cli import running

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


def plain(tree, *arguments):
    """Run a plain snakemake that must succeed, and return what it prints."""
    result = tree.python("-m", "snakemake", "--cores", "2", *arguments)
    assert result.returncode == 0, result.stderr
    return result.stdout + result.stderr


@pytest.mark.parametrize("times", ["reversed", *slowly("future")])
@pytest.mark.parametrize("how", ["reproduce", *slowly("plain")])
def test_an_edit_and_a_missing_drawing_are_noticed_whatever_the_times(done, how, times):
    """The data of the missing drawing, and a current drawing, are marked as incomplete.

    Everything else stays as it is, and records are not touched.
    """
    for i, file in enumerate(sorted((done.path / PAPER).rglob("*.*"), reverse=True)):
        os.utime(file, (i, i) if times == "reversed" else (4e9, 4e9))
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
    if how == "reproduce":
        states = rows(done.succeed())
        again = {path for path, state in states.items() if state == "recomputed"}
        assert again == {f"paper_figures/{name}" for name in ("fig3.png", "fig3.svg", "fig8.png")}
    else:
        plain(done, "-n")
        assert done.planned() == outdated
        plain(done)
    assert done.planned() == set()
    assert (done.path / missing).read_bytes() == before
    assert {file: file.stat().st_ino for file in others} == others
    why = (done.path / PAPER / "why" / "motion_fig3.nc.txt").read_text()
    assert why.startswith("made from another config: duration 16 -> 12\n")


@pytest.mark.slow
def test_dry_runs_change_no_record(done):
    done.edit("fig3", duration=12)
    (done.path / PAPER / "orbits_fig2.nc").write_bytes(b"damaged")
    files = sorted((done.path / PAPER / "provenance").iterdir())
    before = {file: (file.read_bytes(), file.stat().st_mtime_ns) for file in files}
    for option in ("-n", "--lint"):
        done.python("-m", "snakemake", "--cores", "1", option)
        done.run("--", option)
    assert {file: (file.read_bytes(), file.stat().st_mtime_ns) for file in before} == before


@pytest.mark.slow
def test_a_run_that_leaves_a_figure_out_is_no_success(done):
    """A snakemake that makes nothing and reports success stands for any such cause."""
    remove(done, f"{PAPER}/figures/fig3.png")
    package = done.path / "src" / "snakemake"
    package.mkdir()
    (package / "__init__.py").touch()
    (package / "__main__.py").touch()
    result = done.run()
    assert result.returncode == 1
    assert "reproduce: 1 of 14 results not made, or not current: fig3.png\n" in result.stdout
    found = done.run("verify")
    line = "fig3.png: not computed here: run ./reproduce, or verify --committed for committed files"
    assert found.returncode == 1 and f"{line} alone\n" in found.stdout
    assert done.run("report").returncode == 1


def test_the_options_of_a_run_are_those_of_the_profile():
    text = (ROOT / "profiles/default/config.yaml").read_text()
    lines = [line.partition("#")[0].split(":") for line in text.splitlines()]
    profile = {name: value.strip(" []") for name, value in (line for line in lines if line[1:])}
    words = running.OPTIONS[3:]  # without the profile and the lock of snakemake
    given = [f"--{name} {'' if value == 'true' else value}" for name, value in profile.items()]
    assert sorted(" ".join(given).split()) == sorted(words)


# Claims whose data are the scenes' of `small`, and two theorems.
FEW_CLAIMS = {"21", "24", "29"}


def few_claims(folder):
    """Make a tree with little work in which the figures are accepted and few claims are judged."""
    tree = fresh_tree(folder)
    text = tree.path / "src/extensions/claims/ledger/claims.toml"
    tables = re.split(r"(?m)^(?=\[claims\.)", text.read_text(encoding="utf-8"))
    kept = [each for each in tables[1:] if re.match(r"\[claims\.(\d+)", each)[1] in FEW_CLAIMS]
    text.write_text("".join([tables[0], *kept]), encoding="utf-8")
    jumps = shipped()["claims"]["jumps"] | {"sides": 100}
    tree.write(tree.document() | {"claims": {"jumps": jumps}})
    for command in ((), ("accept",), ("claims",)):
        tree.succeed(*command)


@pytest.fixture(scope="session")
def killable(shared):
    """A read-only tree with results for the figures and for claims."""
    pytest.importorskip("extensions.claims")
    return Tree(shared("kills", few_claims))


def kill(run, chance):
    """Kill a run with SIGKILL: all its processes, its process group, or its first process alone."""
    processes = psutil.Process(run.pid).children(recursive=True)
    if (how := chance.choice(["all", "group", "first"])) == "group":
        os.killpg(run.pid, signal.SIGKILL)
    run.kill()
    for process in processes if how == "all" else ():
        with suppress(psutil.NoSuchProcess):
            process.kill()
    run.wait()


@pytest.mark.slow
@pytest.mark.parametrize("number", range(2))
@pytest.mark.parametrize("how", ["reproduce", "plain", "claims"])
def test_a_run_after_a_kill_makes_every_figure_or_fails(killable, tmp_path, how, number):
    """Kill a run of missing and outdated results at a random moment."""
    tree, chance = killable.copy(tmp_path / "tree"), random.Random(f"{how} {number}")
    before = {file: (tree.path / file).read_bytes() for file in verdicts_and_figures(tree)}
    groups = ("paper", "claims") if how == "claims" else ("paper",)
    files = [f for group in groups for f in sorted((tree.path / "results" / group).rglob("*.*"))]
    for file in chance.sample(files, chance.randint(1, len(files) // 2)):
        file.unlink()
    words = ["claims"] if how == "claims" else []
    plain_command = [sys.executable, "-m", "snakemake", "--cores", "2"]
    command = plain_command if how == "plain" else tree.command(*words)
    silent = dict.fromkeys(("stdin", "stdout", "stderr"), subprocess.DEVNULL)
    place = {"env": tree.environment(), "cwd": tree.path}
    run = subprocess.Popen(command, **place, **silent, start_new_session=True)
    time.sleep(chance.uniform(0.5, 8))
    kill(run, chance)
    tree.succeed(*words)
    if words:
        tree.succeed()  # some results of figures may be missing
    tree.succeed("verify")
    after = {file: (tree.path / file).read_bytes() for file in verdicts_and_figures(tree)}
    assert after == before
    assert tree.planned() == set()


def verdicts_and_figures(tree):
    """Return the names of the files of the paper's figures, of claims, and of their verdicts."""
    folders = (tree.path / name for name in ("paper_figures", "more_figures/claims"))
    files = [file for folder in folders for file in sorted(folder.iterdir()) if file.is_file()]
    return [file.relative_to(tree.path) for file in files] + ["CLAIMS.json", "CLAIMS.md"]
