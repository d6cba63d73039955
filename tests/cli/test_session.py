"""The lock of a folder outlives a killed run for as long as the snakemake that it started."""

import os
import signal
import subprocess
import sys

import pytest
from project import ROOT

from pipeline.cli import session

RUN = """
import sys
from pathlib import Path

from pipeline.cli import running, session

session.ROOT = Path(sys.argv[1])
with session.locked():
    running._wait(["sh", "-c", "echo $$; exec sleep 60"], None, False)
"""


def test_the_lock_is_held_until_the_snakemake_of_a_killed_run_ends(tmp_path, monkeypatch):
    monkeypatch.setattr(session, "ROOT", tmp_path)
    monkeypatch.setattr(session, "LOCK_SECONDS", 0.2)
    run = subprocess.Popen(
        [sys.executable, "-c", RUN, str(tmp_path)],
        stdout=subprocess.PIPE,
        text=True,
        env=os.environ | {"PYTHONPATH": str(ROOT / "src")},
        cwd=ROOT,
    )
    with run:
        snakemake = int(run.stdout.readline())
        run.kill()
        run.wait()
        with pytest.raises(session.UsageError, match="another"), session.locked():
            pass
        os.kill(snakemake, signal.SIGKILL)
    with session.locked():
        pass


def started(folder, *words, **how):
    """Return the exit status and the lines on stderr of a command that starts in `folder`."""
    command = [sys.executable, "-P", "-m", "pipeline", *words]
    environment = os.environ | {"PYTHONPATH": str(ROOT / "src"), "PYTHONUTF8": "1"}
    how = {"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE, "text": True} | how
    result = subprocess.run(command, cwd=folder, env=environment, check=False, **how)
    return result.returncode, result.stderr.splitlines()


@pytest.mark.parametrize("words", [["-n"], ["--version"]])
def test_output_that_cannot_be_written_is_one_line(words):
    with open("/dev/full", "w") as full:
        lines = ["reproduce: cannot write to stdout: No space left on device"]
        assert started(ROOT, *words, stdout=full) == (1, lines)


def test_a_deleted_working_folder_is_one_line(tmp_path):
    gone = tmp_path / "gone"
    gone.mkdir()
    line = "reproduce: the current folder was deleted: go to another one"
    assert started(gone, "list", preexec_fn=gone.rmdir) == (1, [line])


INTERRUPTED = """
import signal
import warnings
from contextlib import suppress

from pipeline.cli import session

signal.signal(signal.SIGHUP, signal.SIG_DFL)  # nohup ignores it
with suppress(KeyboardInterrupt), session.interruptible() as caught:
    signal.raise_signal(signal.SIGHUP)
warnings.warn("forkserver: process died unexpectedly")
print(caught)
"""


def test_no_warning_about_killed_processes_follows_an_interrupt():
    run = subprocess.run(
        [sys.executable, "-c", INTERRUPTED], check=False, capture_output=True, text=True
    )
    assert (run.stdout, run.stderr) == ("[1]\n", "")
