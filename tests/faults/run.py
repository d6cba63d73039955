"""Plant each fault of faults.toml in a copy of this tree; the named test must fail.

.venv/bin/python tests/faults/run.py                  # all faults
.venv/bin/python tests/faults/run.py --sample 28      # some, chosen by the commit
.venv/bin/python tests/faults/run.py checkers/curve   # those whose file or test has this text
"""

import os
import queue
import random
import shutil
import subprocess
import sys
import tempfile
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).parents[2]
FAULTS = tomllib.loads((Path(__file__).parent / "faults.toml").read_text(encoding="utf-8"))["fault"]
SKIPPED = shutil.ignore_patterns(".venv", ".snakemake", "results")
LONGEST = 300  # seconds of a test; one that hangs has not seen its fault
RESULTS = {0: "NOT SEEN", 1: "seen"}  # by exit status of pytest


def chosen(arguments: list[str]) -> list[dict[str, str]]:
    """Return the faults that the arguments name."""
    if arguments[:1] == ["--sample"]:
        commit = subprocess.run(["git", "rev-parse", "HEAD"], cwd=ROOT, capture_output=True)
        return random.Random(commit.stdout).sample(FAULTS, int(arguments[1]))
    return [each for each in FAULTS if all(a in each["file"] + each["test"] for a in arguments)]


def plant(fault: dict[str, str], tree: Path) -> str:
    """Run the test of a fault in a tree that has this fault alone, and say what came of it."""
    file, original = tree / fault["file"], (ROOT / fault["file"]).read_text(encoding="utf-8")
    if original.count(fault["old"]) != 1:
        return f"ERROR: {original.count(fault['old'])} places have the old text"
    file.write_text(original.replace(fault["old"], fault["new"]), encoding="utf-8")
    command = [sys.executable, "-m", "pytest", "-n0", "-qx", "-m", "not emulated", fault["test"]]
    try:
        result = subprocess.run(command, cwd=tree, timeout=LONGEST, capture_output=True, text=True)
    except subprocess.TimeoutExpired:
        return "ERROR: the test does not end"
    finally:
        shutil.copy2(ROOT / fault["file"], file)
    return RESULTS.get(result.returncode, f"ERROR: {result.stdout[-500:]}")


def main() -> None:
    faults, trees, wrong = chosen(sys.argv[1:]), queue.SimpleQueue[Path](), 0
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(os.cpu_count()) as pool:
        for number in range(os.cpu_count() or 1):
            trees.put(shutil.copytree(ROOT, Path(folder, str(number)), ignore=SKIPPED))

        def tried(fault: dict[str, str]) -> str:
            tree = trees.get()
            try:
                return plant(fault, tree)
            finally:
                trees.put(tree)

        for fault, found in zip(faults, pool.map(tried, faults), strict=True):
            wrong += found != RESULTS[1]
            print(f"{fault['file']}: {fault['new'].strip()!r}: {found}", flush=True)
    print(f"{len(faults) - wrong} of {len(faults)} faults seen")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
