"""./reproduce benchmark: ratios of speed, measured now."""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from ...records.sources import ROOT
from ..folder import UsageError, interruptible
from ..packages import add_packages

REPETITIONS = 5
# What a run needs of this folder.
PARTS = ("Snakefile", "config.yaml", "paper_figures", "src", "workflow")


def run(given) -> int:
    """Print one table of ratios of speed, and one of whole runs."""
    bench = [sys.executable, "-P", "-m", "pseudorigid.study.bench"]
    if status := add_packages("study") or subprocess.call(bench):
        return status
    with interruptible(), tempfile.TemporaryDirectory() as folder:
        print("", *_runs(Path(folder)), sep="\n")
    return 0


def _runs(folder):
    """Seconds of whole runs in a copy of this folder, in turn, as lines."""
    from pseudorigid.study.bench import interleaved

    for part in PARTS:
        copy = shutil.copytree if (ROOT / part).is_dir() else shutil.copy2
        copy(ROOT / part, folder / part)
    ours = [sys.executable, "-P", "-m", "pipeline"]
    bare = [sys.executable, "-P", "-m", "snakemake", "--cores", "all"]

    def command(words, again):
        if again:
            for name in ("results", ".snakemake"):
                shutil.rmtree(folder / name, ignore_errors=True)
        environment = os.environ | {"PYTHONPATH": str(folder / "src")}
        made = subprocess.run(
            words, cwd=folder, env=environment, capture_output=True, text=True, check=False
        )
        if made.returncode:
            raise UsageError(f"a run of the benchmark failed: {made.stdout}{made.stderr}")

    calls = {
        "all figures, warm code": lambda: command(ours, True),
        "the same, a Python for each job": lambda: command(bare, True),
        "nothing to do": lambda: command(ours, False),
        "nothing to do, snakemake alone": lambda: command(bare, False),
    }
    found = interleaved(calls, REPETITIONS)
    usual = found["the same, a Python for each job"][0]
    yield f"{'whole runs':34}{'s':>24}  {'ratio':>9}"
    for name, (middle, low, high) in found.items():
        spread = f"{middle:.3g} ({low:.3g}-{high:.3g})"
        yield f"{name:34}{spread:>24}  {middle / usual:9.2f}"
