"""Damaged files, failing jobs, interrupts and kills."""

import contextlib
import errno
import re
import resource
import shutil
import signal
import subprocess
import types
from pathlib import Path

import netCDF4
import psutil
import pytest

from helpers.project import SHIPPED, wait_for
from helpers.runs import contents
from helpers.slowly import slowly
from pipeline.cli import publishing, running
from pipeline.cli.arguments import Arguments
from pipeline.cli.errors import UsageError
from pipeline.config import load
from pipeline.records.files import FileError
from pipeline.records.provenance import Freshness

DRAWING = "results/paper/figures/fig3.png"
# Settings in a user's shell do not reach a run; numba would refuse its ones.
HOSTILE = {
    "MPLBACKEND": "no such backend", "SNAKEMAKE_PROFILE": "none such", "NUMBA_NUM_THREADS": "0",
    "NUMBA_OPT": "none", "NUMBA_THREADING_LAYER": "none",
}  # fmt: skip


@pytest.mark.slow
def test_damaged_and_deleted_results_of_the_named_figures_are_made_again(done):
    before, paper = contents(done), done.path / "results" / "paper"
    for name in ("figures/fig3.svg", "provenance/orbits_fig8.nc.json", "figures/fig6.svg"):
        (paper / name).unlink()
    drawing, dataset, edited = (
        paper / name for name in ("figures/fig3.png", "periodic_fig4.nc", "motion_fig3.nc")
    )
    kept = {file: file.read_bytes() for file in (drawing, dataset, edited)}
    drawing.write_bytes(kept[drawing][:300])
    dataset.write_bytes(kept[dataset][:5000])
    with netCDF4.Dataset(edited, "a") as file:  # a number changed by hand
        file["strain"][:] = 0.5 * file["strain"][:]
    targets = ("fig3", "fig4", "fig8")
    plan = done.run("-n", *targets).stdout
    assert drawing.stat().st_size == 300  # -n changes nothing
    result = done.run(*targets, **HOSTILE)
    assert result.returncode == 0, result.stdout
    for text in (plan, result.stdout):
        for file in kept:
            line = f"{file.relative_to(done.path)}: changed after it was made: made again"
            assert f"reproduce: {line}" in text
        assert "orbits_fig8.nc: no record of what made it: made again" in text
    assert contents(done) == before and {file: file.read_bytes() for file in kept} == kept
    assert not (paper / "figures/fig6.svg").exists()  # whose figure is not named


def test_a_bug_in_a_stage_ends_in_one_line_that_names_the_log(edited, accepted):
    output = (edited.path / "output").read_text()
    log = "results/paper/logs/manifolds_fig5.nc.log"
    reason = f"not made: ZeroDivisionError: division by zero (traceback in {log})"
    step, *table = [line for line in output.splitlines() if re.match("fig5.*not made", line)]
    assert step.endswith(reason) and len(table) == 1 and table[0].endswith("not made")
    assert f"\npaper_figures/fig5.png, paper_figures/fig5.svg: {reason}\n" in output
    assert "Traceback" not in output and "Traceback" in (edited.path / log).read_text()
    (named,) = re.findall(r"^reproduce: snakemake's log: (.*)$", output, re.MULTILINE)
    assert (edited.path / named).is_file()
    assert "snakemake's log" not in edited.run("fig3", "--", "--nonsense").stdout  # it has none
    assert contents(edited)["fig5.png"] == contents(accepted)["fig5.png"]


def test_a_failing_publication_leaves_the_figure_as_it_was(tmp_path, monkeypatch):
    published, drawing = tmp_path / "published.png", tmp_path / "drawing.png"
    published.write_text("before")
    drawing.write_text("after")

    def write_half(path, data):
        path.write_text("half")
        raise OSError(errno.EIO, "Input/output error")

    monkeypatch.setattr(publishing, "ROOT", tmp_path)
    with monkeypatch.context() as patch:
        patch.setattr(Path, "write_bytes", write_half)
        with pytest.raises(FileError, match=r"g: cannot be written: Input/output error$"):
            publishing._publish("published.png", "drawing.png")
    assert published.read_text() == "before" and sorted(tmp_path.iterdir()) == [drawing, published]
    assert publishing._publish("published.png", "drawing.png") == "it differed from drawing.png"
    assert published.read_text() == "after"


@pytest.mark.parametrize("file", ["src/pipeline/loading.py", "src/snakemake/cli.py"])
def test_interrupting_the_start_is_no_traceback(tree, file):
    reached = tree.path / "reached"
    path = tree.path / file
    if "snakemake" in file:  # a stand-in, found first
        path.parent.mkdir()
        (path.parent / "__init__.py").touch()
    with path.open("a") as module:
        module.write(f"\nimport time\nopen({str(reached)!r}, 'w').close()\ntime.sleep(60)\n")
    run = tree.start(
        *(["-n"] if "pipeline" in file else []),  # which does without snakemake
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        # A job in the background of a shell would ignore it.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    wait_for(reached.exists)
    run.send_signal(signal.SIGINT)
    output, _ = run.communicate(timeout=30)
    assert run.returncode != 0 and "Traceback" not in output


def test_a_signal_to_the_run_alone_ends_its_jobs(done):
    """Snakemake itself would let them finish."""
    begun = done.path / "begun"
    body = f"open({str(begun)!r}, 'w').write(str(os.getpid())), time.sleep(60)"
    motion = f"\n\ndef scene_motion(*_, **__):\n    import os, time\n    {body}\n"
    done.append("pseudorigid/dynamics/motion.py", motion)
    run = done.start("paper_figures/fig3.png", stderr=subprocess.PIPE, text=True)
    wait_for(lambda: begun.exists() and begun.read_text())
    run.terminate()
    _, output = run.communicate(timeout=30)
    assert run.returncode == 130
    assert output.splitlines()[-1] == "reproduce: interrupted: run it again to go on"
    # Until somebody asks for its end a killed process is a zombie.
    with contextlib.suppress(psutil.NoSuchProcess):
        job = psutil.Process(int(begun.read_text()))
        assert job.status() == psutil.STATUS_ZOMBIE


@pytest.fixture
def start(tmp_path, monkeypatch):
    """Return a function that starts a run in an empty folder."""
    monkeypatch.setattr(running, "ROOT", tmp_path)
    freshness = Freshness(tmp_path, load(SHIPPED).build_specs())
    return lambda: running.make(freshness, [DRAWING], Arguments(options=[]))


def test_a_run_on_a_full_disk_says_so_before_it_starts(start, monkeypatch):
    free = types.SimpleNamespace(total=10**9, free=300_000)
    monkeypatch.setattr("shutil.disk_usage", lambda path: free)
    with pytest.raises(UsageError, match=r"^the disk is full, 0\.3 MB are left$"):
        start()


def test_short_memory_is_one_line(tree):
    """Python's traceback and three sentences of a library would not say so."""
    how = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
    limit = (300_000_000, 300_000_000)
    run = tree.start(**how, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, limit))
    output, _ = run.communicate(timeout=60)
    line = "reproduce: memory is short: the limit is 300 MB (ulimit -v)\n"
    assert (run.returncode, output) == (1, line)


NO_LOCKS = """
#include <errno.h>
int flock(int file, int how) { errno = ENOLCK; return -1; }
"""


@pytest.mark.slow
@pytest.mark.skipif(not shutil.which("cc"), reason="needs a C compiler")
def test_a_run_goes_on_without_locks(done, tmp_path):
    """Neither ./reproduce nor HDF5 needs them."""
    library = tmp_path / "no_locks.so"
    command = ["cc", "-shared", "-fPIC", "-xc", "-", "-o", library]
    subprocess.run(command, input=NO_LOCKS, text=True, check=True)
    (done.path / "results/paper/motion_fig3.nc").unlink()
    result = done.run("paper_figures/fig3.png", LD_PRELOAD=str(library))
    assert result.returncode == 0, result.stdout
    line = "reproduce: no locks here (No locks available): run one command at a time\n"
    assert result.stdout.count("no locks") == 1 and result.stdout.startswith(line)


# File of src/ -> text with a mistake, or None for no file; and the line about it.
BROKEN = {
    "paper/figures/portrait.py": (None, "no module paper.figures.portrait"),
    "paper/figures/motion.py": (b"\ndef draw(:\n", "invalid syntax (motion.py, line 2)"),
    "study/scenes.yaml": (
        b"x: {\n",
        "line 2, column 1: not valid YAML: expected the node content, but found '<stream end>'",
    ),
}
SELDOM_BROKEN = {
    "pseudorigid/dynamics/orbits.py": (None, "no module pseudorigid.dynamics.orbits"),
    "paper/kinds.py": (b"\n\nx\n", "line 3: name 'x' is not defined"),
    "pipeline/cli/commands/list.py": (None, "No module named 'pipeline.cli.commands.list'"),
    "extensions/atlas/part.py": (b"", "module 'extensions.atlas.part' has no attribute 'PART'"),
    "extensions/atlas/kinds.py": (
        b"x = '\xe4'\n",
        "(unicode error) 'utf-8' codec can't decode byte 0xe4 in position 0: unexpected end of "
        "data (kinds.py, line 1)",
    ),
    "extensions/atlas/scenes.yaml": (b"sweeps: [1]\n", "'list' object is not a mapping"),
}


@pytest.mark.parametrize("broken", [BROKEN, *slowly(SELDOM_BROKEN)])
def test_a_broken_source_is_a_line_that_names_it(tree, broken):
    for name, (text, line) in broken.items():
        file = tree.path / "src" / name
        if not file.parent.is_dir():
            continue  # an extension that is not there
        kept = file.read_bytes()
        file.unlink()
        if text is not None:
            file.write_bytes(text)
        result = tree.run("list")
        assert (result.returncode, result.stdout) == (1, f"reproduce: src/{name}: {line}\n")
        file.write_bytes(kept)


@pytest.mark.slow
def test_broken_captions_of_a_part_are_named(done):
    with (done.path / "src/extensions/atlas/captions.toml").open("a") as file:
        file.write("broken:\n")
    result = done.run("accept")
    assert result.returncode == 1 and "Traceback" not in result.stdout
    assert "src/extensions/atlas/captions.toml: " in result.stdout


def test_a_reader_that_has_seen_enough_ends_a_plan(tree):
    run = tree.start("-n", stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert run.stdout.readline()
    run.stdout.close()
    assert "Traceback" not in run.stderr.read()
    run.wait()
