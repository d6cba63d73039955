"""./reproduce report: one HTML page with the paper's figures, by snakemake's own --report."""

import os
import subprocess
import sys

from .interrupts import tidying_up
from .runner import BUSY, ROOT, hold_lock, only_said
from .variants import make

PAGE = "results/report/report.html"
PYTHON = sys.executable  # the rules quote that name for the shell


def report(arguments: list[str]) -> int:
    """Make what is missing, with the options given, and then the page."""
    lock = hold_lock()
    if lock is None:
        print(BUSY, file=sys.stderr)
        return 1
    status = make(["report"], arguments)
    if status or only_said(arguments):
        return status
    part = ROOT / "results" / "report" / "part.html"  # snakemake wants a name that ends so
    command = [PYTHON, "-m", "snakemake", "report", "--report", str(part)]
    command += ["--nolock", "--cores", "1"]  # a number of cores, though no job runs
    with tidying_up():
        run = subprocess.run(
            command,
            cwd=ROOT,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
        )
        if run.returncode:
            part.unlink(missing_ok=True)
            print(run.stdout, file=sys.stderr)
            return run.returncode
        os.replace(part, ROOT / PAGE)
    print(f"\n{PAGE}  {(ROOT / PAGE).stat().st_size / 1e6:.1f} MB: open it in a browser")
    return 0
