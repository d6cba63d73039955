"""./reproduce benchmark: ratios of speed, measured now."""

import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from ...records.sources import ROOT
from ..packages import add_packages
from ..session import UsageError, interruptible

REPETITIONS = 5
# What a run needs of this folder.
PARTS = ("Snakefile", "config.yaml", "paper_figures", "profiles", "src", "workflow")


def run(args) -> int:
    """Print one table of ratios of speed, and one of whole runs."""
    bench = [sys.executable, "-P", "-m", "pseudorigid.study.bench"]
    add_packages("study")
    if status := subprocess.call(bench):
        return status
    with interruptible(), tempfile.TemporaryDirectory() as folder:
        print("", *_runs(Path(folder)), sep="\n")
    return 0


def _runs(folder):
    """Seconds of whole runs in a copy of this folder, in turn, as lines."""
    from pseudorigid.study.timing import interleaved

    for part in PARTS:
        copy = shutil.copytree if (ROOT / part).is_dir() else shutil.copy2
        copy(ROOT / part, folder / part)
    how = {"env": os.environ | {"PYTHONPATH": str(folder / "src")}, "cwd": folder, "text": True}
    ours, bare = ["pipeline"], ["snakemake", "--cores", "all"]

    def run(words, *gone):
        for name in gone:
            shutil.rmtree(folder / name, ignore_errors=True)
        command = [sys.executable, "-P", "-m", *words]
        made = subprocess.run(command, **how, capture_output=True, check=False)
        if made.returncode:
            raise UsageError(f"a run of the benchmark failed: {made.stdout}{made.stderr}")

    calls = {
        "all figures, warm code": lambda: run(ours, "results", ".snakemake"),
        "the same, a Python for each job": lambda: run(bare, "results", ".snakemake"),
        "nothing to do": lambda: run(ours),
        "nothing to do, snakemake alone": lambda: run(bare),
    }
    found = interleaved(calls, REPETITIONS, time.perf_counter)
    usual = found["the same, a Python for each job"][0]
    yield f"{'whole runs':34}{'s':>24}  {'ratio':>9}"
    for name, (middle, low, high) in found.items():
        spread = f"{middle:.3g} ({low:.3g}-{high:.3g})"
        yield f"{name:34}{spread:>24}  {middle / usual:9.2f}"
