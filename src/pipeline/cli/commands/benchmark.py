"""./reproduce benchmark: measure speeds and print their ratios."""

import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from ...records.sources import ROOT
from ..arguments import Arguments
from ..packages import add_packages
from ..session import UsageError, interruptible

REPETITIONS = 5
# The parts of the project that a run needs.
PARTS = ("Snakefile", "config.yaml", "paper_figures", "profiles", "src", "workflow")


def run(args: Arguments) -> int:
    """Print a table of the map's speed, and one of whole runs."""
    add_packages("study")
    if status := subprocess.call([sys.executable, "-P", "-m", "pseudorigid.study.bench"]):
        return status
    with interruptible(), tempfile.TemporaryDirectory() as folder:
        print("", *_runs(Path(folder)), sep="\n")
    return 0


def _runs(folder: Path) -> Iterator[str]:
    """Time whole runs in a copy of the project, interleaved, and yield the lines of a table."""
    from pseudorigid.study.timing import interleaved

    for part in PARTS:
        if (ROOT / part).is_dir():
            shutil.copytree(ROOT / part, folder / part)
        else:
            shutil.copy2(ROOT / part, folder / part)
    environment = os.environ | {"PYTHONPATH": str(folder / "src")}
    pipeline, snakemake = ["pipeline"], ["snakemake", "--cores", "all"]

    def run(words: list[str], *removed: str) -> None:
        for name in removed:
            shutil.rmtree(folder / name, ignore_errors=True)
        command = [sys.executable, "-P", "-m", *words]
        result = subprocess.run(
            command, env=environment, cwd=folder, text=True, capture_output=True, check=False
        )
        if result.returncode:
            raise UsageError(f"a run of the benchmark failed: {result.stdout}{result.stderr}")

    calls = {
        "all figures, warm code": lambda: run(pipeline, "results", ".snakemake"),
        "the same, a Python for each job": lambda: run(snakemake, "results", ".snakemake"),
        "nothing to do": lambda: run(pipeline),
        "nothing to do, snakemake alone": lambda: run(snakemake),
    }
    seconds = interleaved(calls, REPETITIONS, time.perf_counter)
    reference = seconds["the same, a Python for each job"][0]
    yield f"{'whole runs':34}{'s':>24}  {'ratio':>9}"
    for name, (median, low, high) in seconds.items():
        spread = f"{median:.3g} ({low:.3g}-{high:.3g})"
        yield f"{name:34}{spread:>24}  {median / reference:9.2f}"
