"""The job server: each job ends as a program of its own would, also when many start at once."""

import subprocess
import sys

import pytest
from project import ROOT, fresh_tree

from pipeline.checks.freshness import Freshness
from pipeline.jobs import server

PROGRAMS = {
    "good": "open('count', 'a').write('x'); open(spec.result, 'w').write(spec.scene)",
    "bad": "raise ValueError('bad input')",
    "bug": "1 / 0",
    "short": "raise MemoryError",
    "killed": "import os, signal; os.kill(os.getpid(), signal.SIGKILL)",
    "modules": "import sys; print(*[name in sys.modules for name in ('xarray', 'numba')])",
}
MAIN = """
import os, subprocess, sys
from concurrent.futures import ThreadPoolExecutor

from pipeline.checks.freshness import Freshness
from pipeline.jobs import server
from pipeline.records.build_spec import BuildSpec
from pipeline.records.sources import ROOT

def spec(i, program, suffix):
    return BuildSpec(f"results/paper/{i}.{suffix}", "fig", "step", {}, program, None, [], [])

def status(path):
    return subprocess.call([sys.executable, "-S", "workflow/scripts/make.py", path])

if __name__ == "__main__":
    count, suffix, *programs = sys.argv[1:]
    specs = [spec(i, name, suffix) for i, name in enumerate(programs * int(count))]
    specs = {each.result: each for each in specs}
    with server.job_server(Freshness(ROOT, specs), specs) as variables:
        os.environ |= variables
        with ThreadPoolExecutor(8) as pool:
            print(*pool.map(status, specs))
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


def test_many_jobs_at_once_end_as_they_should(tree):
    programs = ("good", "bad", "bug", "killed", "modules", "short")
    result = tree.python("main.py", "2", "nc", *programs)
    assert (result.returncode, result.stderr) == (0, "")
    words = result.stdout.split()
    assert words[:4] == ["True", "True"] * 2  # jobs of a run that computes data find numba loaded
    assert words[4:] == ["0", "1", "1", "1", "0", "1"] * 2
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


def test_jobs_start_as_usual_without_a_server(monkeypatch):
    def refuse():
        raise OSError("AF_UNIX path too long")

    monkeypatch.setattr(server.forkserver, "ensure_running", refuse)
    with server.job_server(Freshness(ROOT, {}), []) as variables:
        assert variables == {}


@pytest.fixture
def asked(monkeypatch):
    """Return a function that asks the server of these results for x: the exit status of the job."""

    def ask(specs, current, **environment):
        monkeypatch.setattr(Freshness, "is_current_now", lambda self, path: current)
        command = [sys.executable, "-S", ROOT / "workflow/scripts/make.py", "x"]
        with server.job_server(Freshness(ROOT, specs), []) as variables:
            return subprocess.call(command, env=variables | environment)

    return ask


def test_a_result_that_is_current_when_its_job_begins_is_not_made(asked):
    assert asked({}, current=True) == 0


def test_a_job_whose_server_or_forking_process_has_ended_fails(asked, monkeypatch, capfd):
    def end(context, spec):
        raise EOFError("unexpected EOF")

    monkeypatch.setattr(server, "run", end)
    assert asked({"x": None}, current=False) == 1
    assert asked({}, current=True, **{server.ADDRESS: "/nowhere"}) == 1
    assert capfd.readouterr().err == ""
