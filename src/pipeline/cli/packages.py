"""Packages that only some words of ./reproduce need."""

import os
import subprocess
import sys

from ..records.sources import ROOT
from .folder import interruptible, locked, say


def add_packages(name: str) -> int:
    """Install requirements/<name>.txt on top of the lock if that is not done; the exit status."""
    wanted = (ROOT / "requirements" / f"{name}.txt").read_bytes()
    stamp = ROOT / ".venv" / f"{name}-stamp"  # goes with .venv when that is made anew
    if stamp.is_file() and stamp.read_bytes() == wanted:
        return 0
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "--no-input", "install"]
    pip += ["--quiet", "--require-hashes", "-r", str(ROOT / "requirements" / f"{name}.txt")]
    with locked(), interruptible():
        say(f"installing requirements/{name}.txt into .venv (once)")
        status = subprocess.call(pip, env=os.environ | {"PIP_USER": "0"})
        if status == 0:
            stamp.write_bytes(wanted)
    return status
