"""Jobs from the server: each ends as a program of its own, also when many start at once."""

import subprocess
import sys

import pytest
from project import ROOT, fresh_tree

from pipeline.jobs import server
from pipeline.records.build_spec import BuildSpec

PROGRAMS = {
    "good": "open('count', 'a').write('x'); open(spec.result, 'w').write(spec.scene)",
    "bad": "raise ValueError('bad input')",
    "bug": "1 / 0",
    "killed": "import os, signal; os.kill(os.getpid(), signal.SIGKILL)",
    "modules": "import sys; print('numba' in sys.modules, 'xarray' in sys.modules)",
}
MAIN = """
import os, subprocess, sys
from concurrent.futures import ThreadPoolExecutor

from pipeline.jobs import server
from pipeline.records.build_spec import BuildSpec

def spec(i, program, suffix):
    return BuildSpec(f"results/paper/{i}.{suffix}", "fig", "step", {}, program, None, [], [])

def status(path):
    return subprocess.call([sys.executable, "-S", "workflow/scripts/make.py", path])

if __name__ == "__main__":
    count, suffix, *programs = sys.argv[1:]
    specs = [spec(i, name, suffix) for i, name in enumerate(programs * int(count))]
    specs = {each.result: each for each in specs}
    with server.job_server(server.Plan({}, specs, set(specs))) as variables:
        os.environ |= variables
        with ThreadPoolExecutor(8) as pool:
            print(*pool.map(status, specs))
"""


def run(folder, *arguments):
    """Run MAIN in a tree that has PROGRAMS; what it prints, and the tree."""
    tree = fresh_tree(folder / "tree")
    for name, text in PROGRAMS.items():
        file = tree.path / "src/pipeline/jobs" / f"{name}.py"
        file.write_text(f"def make(spec):\n    {text}\n")
    (tree.path / "main.py").write_text(MAIN)
    (tree.path / "results/paper").mkdir(parents=True)
    result = subprocess.run(
        [sys.executable, "main.py", *arguments],
        env=tree.environment(),
        capture_output=True,
        text=True,
        check=False,
        cwd=tree.path,
    )
    assert (result.returncode, result.stderr) == (0, "")
    return result.stdout.split(), tree.path


def test_many_jobs_at_once_end_as_they_should(tmp_path):
    said, root = run(tmp_path, "8", "txt", "good", "bad", "bug", "killed")
    assert said == ["0", "1", "1", "1"] * 8
    assert (root / "count").read_text() == "x" * 8
    logs = [root / f"results/paper/logs/{i}.txt.log" for i in range(4)]
    assert not logs[0].exists()
    last = [log.read_text().splitlines()[-1] for log in logs[1:]]
    assert last[0] == "pseudorigid: fig: bad input"
    assert last[1].startswith("pseudorigid: fig: ZeroDivisionError: division by zero (traceback in")
    assert last[2].startswith("pseudorigid: fig: the job was killed")
    made = {file.name for file in (root / "results/paper").glob("*.txt")}
    assert made == {f"{i}.txt" for i in range(0, 32, 4)}


@pytest.mark.parametrize(("suffix", "computes"), [("png", "False"), ("nc", "True")])
def test_what_compiles_is_loaded_where_something_is_computed(tmp_path, suffix, computes):
    said, _ = run(tmp_path, "1", suffix, "modules")
    assert said[:2] == [computes, "True"]


def test_where_no_server_can_be_jobs_start_as_usual(monkeypatch):
    def refuse():
        raise OSError("AF_UNIX path too long")

    monkeypatch.setattr(server.forkserver, "ensure_running", refuse)
    with server.job_server(server.Plan({}, {}, set())) as variables:
        assert variables == {}


def test_a_job_whose_server_has_ended_fails(tmp_path):
    command = [sys.executable, "-S", ROOT / "workflow/scripts/make.py", "results/paper/x.nc"]
    status = subprocess.call(command, env={server.ADDRESS: str(tmp_path / "none")})
    assert status == 1


def test_what_is_current_when_its_job_begins_stays_as_it_is():
    spec = BuildSpec("results/paper/x.nc", "fig", "step", {}, "stage", None, [], [])
    plan = server.Plan({}, {spec.result: spec}, {spec.result})
    with server.job_server(plan, lambda path: path == spec.result) as variables:
        command = [sys.executable, "-S", ROOT / "workflow/scripts/make.py", spec.result]
        assert subprocess.call(command, env=variables) == 0
