"""Plant each fault of faults.toml in a copy of this tree; the named test must fail.

.venv/bin/python tests/faults/run.py                  # all faults
.venv/bin/python tests/faults/run.py --sample 28      # some, chosen by the commit
.venv/bin/python tests/faults/run.py checkers/curve   # those whose file or test has this text
"""

import os
import random
import shutil
import subprocess
import sys
import tempfile
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from queue import SimpleQueue

ROOT = Path(__file__).parents[2]
FAULTS = tomllib.loads((ROOT / "tests/faults/faults.toml").read_text(encoding="utf-8"))["fault"]
SKIPPED = shutil.ignore_patterns(".venv", ".snakemake", "results")
LONGEST = 300  # seconds of a test; one that hangs has not seen its fault
TREES = SimpleQueue[Path]()  # copies in which no test runs


def chosen(arguments: list[str]) -> list[dict[str, str]]:
    """Return the faults that the arguments name."""
    if arguments[:1] == ["--sample"]:
        commit = subprocess.check_output(["git", "rev-parse", "HEAD"], cwd=ROOT)
        return random.Random(commit).sample(FAULTS, int(arguments[1]))
    return [each for each in FAULTS if all(a in each["file"] + each["test"] for a in arguments)]


def plant(fault: dict[str, str]) -> str:
    """Return what the test of a fault finds in a tree that has this fault alone."""
    original = (ROOT / fault["file"]).read_text(encoding="utf-8")
    if original.count(fault["old"]) != 1:
        return "ERROR: the old text is not there once"
    tree = TREES.get()
    (tree / fault["file"]).write_text(original.replace(fault["old"], fault["new"]), "utf-8")
    command = [sys.executable, "-m", "pytest", "-n0", "-qx", "-m", "not emulated", fault["test"]]
    try:
        run = subprocess.run(command, cwd=tree, timeout=LONGEST, capture_output=True, check=False)
    except subprocess.TimeoutExpired:
        return "ERROR: the test does not end"
    finally:
        shutil.copy2(ROOT / fault["file"], tree / fault["file"])
        TREES.put(tree)
    return {0: "NOT SEEN", 1: "seen"}.get(run.returncode, f"ERROR: {run.stdout[-500:]!r}")


if __name__ == "__main__":
    faults, seen, workers = chosen(sys.argv[1:]), 0, os.cpu_count() or 1
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(workers) as pool:
        for number in range(workers):
            TREES.put(shutil.copytree(ROOT, Path(folder, str(number)), ignore=SKIPPED))
        for fault, found in zip(faults, pool.map(plant, faults), strict=True):
            seen += found == "seen"
            print(f"{fault['file']}: {fault['new'].strip()!r}: {found}", flush=True)
    sys.exit(f"only {seen} of {len(faults)} faults are seen" if seen < len(faults) else None)
