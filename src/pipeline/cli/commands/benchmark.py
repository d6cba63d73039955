"""./reproduce benchmark: measure speeds and print their ratios."""

import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

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
        copy = shutil.copytree if (ROOT / part).is_dir() else shutil.copy2
        copy(ROOT / part, folder / part)
    options: dict[str, Any] = {"env": os.environ | {"PYTHONPATH": str(folder / "src")}}
    options |= {"cwd": folder, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}

    def run(words: str, afresh: bool = False) -> None:
        for name in ("results", ".snakemake") if afresh else ():
            shutil.rmtree(folder / name, ignore_errors=True)
        command = [sys.executable, "-P", "-m", *words.split()]
        result = subprocess.run(command, text=True, check=False, **options)
        if result.returncode:
            raise UsageError(f"a run of the benchmark failed: {result.stdout}")

    snakemake = "snakemake --cores all"
    calls = {
        "all figures, warm code": lambda: run("pipeline", afresh=True),
        "the same, a Python for each job": lambda: run(snakemake, afresh=True),
        "nothing to do": lambda: run("pipeline"),
        "nothing to do, snakemake alone": lambda: run(snakemake),
    }
    seconds = interleaved(calls, REPETITIONS, time.perf_counter)
    reference = seconds["the same, a Python for each job"][0]
    yield f"{'whole runs':34}{'s':>24}  {'ratio':>9}"
    for name, (median, low, high) in seconds.items():
        spread = f"{median:.3g} ({low:.3g}-{high:.3g})"
        yield f"{name:34}{spread:>24}  {median / reference:9.2f}"
