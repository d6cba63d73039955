"""./reproduce report: one HTML page with the paper's figures, by snakemake's own --report."""

import os
import subprocess
import sys

from ... import config
from ...config.checking.reading import load
from ...records.sources import ROOT
from .. import figures, running
from ..folder import interruptible, locked

PAGE = "results/report/report.html"
LABELS = "results/report/labels.json"
PYTHON = sys.executable  # the rules quote that name for the shell


def run(given) -> int:
    """Make what is missing, with the options given, and then the page."""
    checked = load(ROOT / "config.yaml")
    with locked():
        status = figures.make(checked, config.PAPER, given.options)
        if status or running.only_says(given.options):
            return status
        return running.run(["report"], [LABELS], given.options) or _page()


def _page() -> int:
    part = ROOT / "results" / "report" / "part.html"  # snakemake wants a name that ends so
    command = [PYTHON, "-P", "-m", "snakemake", "report", "--report", str(part)]
    command += ["--nolock", "--cores", "1"]  # a number of cores, though no job runs
    with interruptible():
        made = subprocess.run(
            command,
            cwd=ROOT,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
        )
        if made.returncode:
            part.unlink(missing_ok=True)
            print(made.stdout, file=sys.stderr)
            return made.returncode
        os.replace(part, ROOT / PAGE)
    print(f"\n{PAGE}  {(ROOT / PAGE).stat().st_size / 1e6:.1f} MB: open it in a browser")
    return 0
