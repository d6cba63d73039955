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
