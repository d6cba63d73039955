"""Forked jobs: each ends as a program of its own would, also when many start at once."""

import errno
import multiprocessing
import os
import signal
import sys
from contextlib import nullcontext
from types import SimpleNamespace

import pytest

import snakemake_executor_plugin_reproduce as plugin
from helpers.project import ROOT, fresh_tree, run
from pipeline.jobs import forks
from pipeline.records.provenance import BuildSpec, failure
from pseudorigid.dynamics import ensemble

PROGRAMS = {
    "good": "open('count', 'a').write('x'); open(spec.result, 'w').write(spec.scene)",
    "bad": "raise ValueError('bad input')", "bug": "1 / 0", "short": "raise MemoryError",
    "killed": "import os, signal; os.kill(os.getpid(), signal.SIGKILL)",
    "modules": "import sys; print(*[name in sys.modules for name in ('xarray', 'numba')])",
}  # fmt: skip
MAIN = """
import sys
from concurrent.futures import ThreadPoolExecutor
from functools import partial

from pipeline.jobs.forks import forking, run
from pipeline.records.provenance import BuildSpec

def spec(i, program):
    return BuildSpec(f"results/paper/{i}.nc", "fig", "step", {}, program, "", {}, [])

if __name__ == "__main__":
    count, *programs = sys.argv[1:]
    specs = [spec(i, name) for i, name in enumerate(programs * int(count))]
    with ThreadPoolExecutor(8) as pool:
        print(*pool.map(partial(run, forking()), specs))
"""


@pytest.fixture
def tree(tmp_path):
    """A copy of the project with PROGRAMS and MAIN."""
    tree = fresh_tree(tmp_path / "tree")
    for name, text in PROGRAMS.items():
        file = tree.path / "src/pipeline/jobs" / f"{name}.py"
        file.write_text(f"def make(spec):\n    {text}\n")
    (tree.path / "main.py").write_text(MAIN)
    (tree.path / "results/paper").mkdir(parents=True)
    return tree


@pytest.mark.slow
def test_many_jobs_at_once_end_as_they_should(tree):
    programs = ("good", "bad", "bug", "killed", "modules", "short")
    result = tree.python("main.py", "2", *programs)
    assert (result.returncode, result.stderr) == (0, "")
    words = result.stdout.split()
    assert words[:4] == ["True", "True"] * 2  # jobs of a run that computes data find numba loaded
    made = {"good": "True", "modules": "True"}
    assert words[4:] == [made.get(name, "False") for name in programs] * 2
    assert (tree.path / "count").read_text() == "x" * 2
    folder = tree.path / "results/paper"
    logs = [folder / f"logs/{i}.nc.log" for i in (0, 1, 2, 3, 5)]
    assert not logs[0].exists()
    last = [log.read_text().splitlines()[-1] for log in logs[1:]]
    assert last[0] == "pseudorigid: fig: bad input"
    assert last[1].startswith("pseudorigid: fig: ZeroDivisionError: division by zero (traceback in")
    assert last[2] == "pseudorigid: fig: the job was killed (SIGKILL): memory may be short"
    assert last[3].startswith("pseudorigid: fig: memory is short")
    assert {file.name for file in folder.glob("*.nc")} == {"0.nc", "6.nc"}


def test_jobs_are_new_pythons_where_no_process_can_fork_them(monkeypatch):
    def refuse():
        raise OSError("AF_UNIX path too long")

    monkeypatch.setattr(forks.forkserver, "ensure_running", refuse)
    assert forks.forking().get_start_method() == "spawn"


def test_lines_about_its_progress_leave_the_stderr_of_a_job(monkeypatch, capsys):
    def make(spec, known):
        os.write(2, f"fig: 60%, {known}\na warning\n".encode())

    monkeypatch.setattr(forks.job, "make", make)
    spec = BuildSpec("results/paper/1.nc", "fig", "step", {}, "", "", {}, [])
    assert forks.run(multiprocessing.get_context("fork"), spec, "halving")
    assert forks.PROGRESS.pop(spec.result) == "60%, halving"
    assert capsys.readouterr().err == "a warning\n"


def test_a_job_starts_as_many_threads_as_its_rule_says(monkeypatch):
    made = []

    def make(spec):
        os.write(2, f"fig: {ensemble.threads()}\n".encode())

    monkeypatch.setattr(forks.job, "make", make)
    spec = BuildSpec("results/paper/1.nc", "fig", "step", {}, "", "", {}, [])
    for how in ({}, {"threads": 3}):
        assert forks.run(multiprocessing.get_context("fork"), spec, **how)
        made.append(forks.PROGRESS.pop(spec.result))
    assert made == ["1", "3"]


def test_the_executor_gives_a_job_the_threads_of_its_rule(monkeypatch):
    given = []
    monkeypatch.setattr(plugin, "read_spec", lambda path: path)
    monkeypatch.setattr(plugin, "run", lambda *_, threads: given.append(threads) or True)
    executor = object.__new__(plugin.Executor)
    executor.context = None
    executor.workflow = SimpleNamespace(async_run=lambda _: None)
    executor.pool = SimpleNamespace(submit=lambda work, *arguments: work(*arguments))
    inputs = SimpleNamespace(items=lambda: [("specification", "1.json")])
    executor.run_single_job(SimpleNamespace(input=inputs, prepare=lambda: None, threads=5))
    assert given == [5]


@pytest.mark.parametrize("log", ["kept", "not written"])
def test_a_job_that_cannot_start_for_want_of_file_handles_says_so(
    tmp_path, monkeypatch, capsys, log
):
    def refuse(duplex):
        raise OSError(errno.EMFILE, os.strerror(errno.EMFILE))

    monkeypatch.chdir(tmp_path)
    (tmp_path / "results").write_text("") if log == "not written" else None
    spec = BuildSpec("results/paper/0.nc", "fig", "step", {}, "", "", {}, [])
    assert not forks.run(SimpleNamespace(Pipe=refuse), spec)
    said = failure(spec.result) if log == "kept" else capsys.readouterr().err.rstrip()
    assert said.endswith("the job could not start: Too many open files (limits: ulimit -a)")


def test_a_job_whose_forking_process_has_ended_says_so(tmp_path, monkeypatch):
    def end():
        raise EOFError

    monkeypatch.chdir(tmp_path)
    context = multiprocessing.get_context("fork")
    process = SimpleNamespace(start=end)
    context = SimpleNamespace(Pipe=context.Pipe, Process=lambda target, args: process)
    spec = BuildSpec("results/paper/0.nc", "fig", "step", {}, "", "", {}, [])
    assert not forks.run(context, spec)
    words = "memory or file handles may be short (limits: ulimit -a)"
    assert failure(spec.result) == f"the job could not start: {words}"


def test_a_job_without_a_log_says_if_the_disk_is_full(tmp_path, monkeypatch):
    """It could not write one, which does not mean that memory was short."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(forks.job, "make", lambda spec: sys.exit(1))
    spec = BuildSpec("results/paper/0.nc", "fig", "step", {}, "", "", {}, [])
    context = multiprocessing.get_context("fork")
    assert not forks.run(context, spec)
    assert failure(spec.result) == "the job was killed (exit status 1): memory may be short"
    (tmp_path / "results/paper/logs/0.nc.log").unlink()
    monkeypatch.setattr("shutil.disk_usage", lambda path: SimpleNamespace(total=10**9, free=30_000))
    assert not forks.run(context, spec)
    assert failure(spec.result) == "the disk is full, 0.0 MB are left"
    assert not forks.run(context, spec)  # also with a log of its own


def test_the_libraries_of_jobs_start_no_threads_and_the_run_keeps_its_settings(monkeypatch):
    seen = {}
    monkeypatch.setenv("OMP_NUM_THREADS", "7")
    monkeypatch.delenv("OPENBLAS_NUM_THREADS", raising=False)
    before = dict(os.environ)
    monkeypatch.setattr(forks.forkserver, "ensure_running", lambda: seen.update(os.environ))
    assert forks.forking().get_start_method() == "forkserver"
    assert (seen["OMP_NUM_THREADS"], seen["OPENBLAS_NUM_THREADS"]) == ("1", "1")
    assert dict(os.environ) == before


def test_a_broken_specification_is_one_line(tmp_path):
    (tmp_path / "broken.json").write_text("{")
    for name, words in (("broken", "Expecting property name"), ("missing", "No such file")):
        command = [sys.executable, "-P", "-m", "pipeline.jobs.job", f"{name}.json"]
        result = run(*command, cwd=tmp_path, env=os.environ | {"PYTHONPATH": str(ROOT / "src")})
        assert (result.returncode, result.stdout, result.stderr.count("\n")) == (1, "", 1)
        assert result.stderr.startswith("pseudorigid: ") and words in result.stderr


@pytest.mark.parametrize(("error", "words"), [
    (ValueError("bad\ninput"), "bad input"),
    (ZeroDivisionError("by zero"), "ZeroDivisionError: by zero (traceback in LOG)"),
    (MemoryError(), "memory is short (traceback in LOG)"),
])  # fmt: skip
def test_an_error_a_bug_and_short_memory_are_a_line_of_the_log(tmp_path, monkeypatch, error, words):
    monkeypatch.chdir(tmp_path)

    def make(spec):
        raise error

    monkeypatch.setitem(sys.modules, "pipeline.jobs.made_up", SimpleNamespace(make=make))
    monkeypatch.setattr(forks.job, "recorded", lambda spec: nullcontext({}))
    spec = BuildSpec("results/paper/0.nc", "fig", "step", {}, "made_up", "", {}, [])
    log = "results/paper/logs/0.nc.log"
    with pytest.raises(SystemExit) as ended:
        forks.job.make(spec)
    assert ended.value.code == f"pseudorigid: fig: {words.replace('LOG', log)}"
    text = (tmp_path / log).read_text()
    assert text.startswith("Traceback") and text.endswith(f"\n{ended.value.code}\n")
    monkeypatch.setattr(sys.modules["pipeline.jobs.made_up"], "make", lambda spec: None)
    forks.job.make(spec)
    assert not (tmp_path / log).exists()  # it was of an earlier run


def test_a_job_that_a_signal_killed_names_it(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(forks.job, "make", lambda spec: os.kill(os.getpid(), signal.SIGKILL))
    spec = BuildSpec("results/paper/0.nc", "fig", "step", {}, "", "", {}, [])
    assert not forks.run(multiprocessing.get_context("fork"), spec)
    assert failure(spec.result) == "the job was killed (SIGKILL): memory may be short"
