"""Jobs from the server: each ends as a program of its own, also when many start at once."""

import os
import subprocess
import sys

import pytest

from pipeline.cli.running import server

PROGRAM = """
import subprocess, sys
from concurrent.futures import ThreadPoolExecutor
from types import SimpleNamespace

from snakemake.script import PythonScript

from pipeline.cli.running import server

usual = PythonScript.execute_script


def script(**about):
    names = ("conda_env", "container_img", "env_modules", "shadow_dir")
    return SimpleNamespace(**dict.fromkeys(names), threads=1, **about)


def status(name):
    try:
        PythonScript.execute_script(script(), name)
    except subprocess.CalledProcessError as error:
        return 1 if error.returncode in (1, -9, 255) else error.returncode
    except ImportError as error:
        return str(error).split()[-1]
    return 0


if __name__ == "__main__":
    scripts = sys.argv[1:]
    server.begin(True)
    with server.serving(), ThreadPoolExecutor(8) as pool:
        print(*pool.map(status, scripts * 40))
    assert PythonScript.execute_script is usual
"""


def test_many_jobs_at_once_end_as_they_should(tmp_path):
    programs = {
        "good.py": f"open({str(tmp_path / 'count')!r}, 'a').write('x')",
        "bad.py": "import sys; sys.exit(1)",
        "killed.py": "import os, signal; os.kill(os.getpid(), signal.SIGKILL)",
        "damaged.py": "import nothing",
    }
    (tmp_path / "main.py").write_text(PROGRAM)
    for name, text in programs.items():
        (tmp_path / name).write_text(text)
    result = subprocess.run(
        [sys.executable, "main.py", *(str(tmp_path / name) for name in programs)],
        capture_output=True,
        text=True,
        check=False,
        cwd=tmp_path,
    )
    assert (result.returncode, result.stderr) == (0, "")
    assert result.stdout.split() == ["0", "1", "1", "'nothing'"] * 40
    assert (tmp_path / "count").read_text() == "x" * 40


def test_where_no_server_can_be_jobs_start_as_usual(monkeypatch):
    def refuse():
        raise OSError("AF_UNIX path too long")

    before = dict(os.environ)
    monkeypatch.setattr(server.forkserver, "ensure_running", refuse)
    assert server.begin(True) is False
    assert dict(os.environ) == before


LOADED = """
import sys
from pipeline.cli.running import server

if __name__ == "__main__":
    server.begin(sys.argv[2] == "computes")
    done, answer = server.JOBS.Pipe(duplex=False)
    job = server.JOBS.Process(target=server.run, args=(sys.argv[1], answer))
    job.start()
    job.join()
"""


@pytest.mark.parametrize("what", ["draws", "computes"])
def test_what_compiles_is_loaded_where_something_is_computed(tmp_path, what):
    (tmp_path / "main.py").write_text(LOADED)
    (tmp_path / "job.py").write_text(
        "import sys; print('numba' in sys.modules, 'xarray' in sys.modules)"
    )
    result = subprocess.run(
        [sys.executable, tmp_path / "main.py", tmp_path / "job.py", what],
        capture_output=True,
        text=True,
        check=False,
        cwd=tmp_path,
    )
    assert result.stdout.split() == [str(what == "computes"), "True"], result.stderr
