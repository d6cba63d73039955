"""./reproduce sweep and atlas."""

import shutil
import sys
import time

from pseudorigid.sweep import grid

from .. import config
from . import sweep_run as run
from .packages import add_packages
from .runner import BUSY, ROOT, hold_lock, last_words, run_snakemake


def sweep(arguments: list[str]) -> int:
    """The datasets of the sweeps, or of those named first."""
    return swept(arguments, lambda names: [grid.dataset(name) for name in names])


def atlas(arguments: list[str]) -> int:
    """The pictures of the sweeps, and whatever they still need."""
    sweeps = config.load(ROOT / "config.yaml")["sweeps"]
    return swept(
        arguments,
        lambda names: [
            file
            for name in names
            for file in (grid.dataset(name), *grid.pictures(name, sweeps[name]))
        ],
    )


def swept(arguments: list[str], targets) -> int:
    """Snakemake for sweeps: damaged files go before, and it is told how far the cells are."""
    sweeps = config.load(ROOT / "config.yaml")["sweeps"]
    names, options = run.chosen(sweeps, arguments)
    if "--slurm" in options:
        if shutil.which("sbatch") is None:
            print("reproduce: --slurm: there is no sbatch on this machine", file=sys.stderr)
            return 1
        options[options.index("--slurm")] = f"--profile={ROOT / 'workflow' / 'profiles' / 'slurm'}"
        if status := add_packages("slurm"):
            return status
    lock = hold_lock()
    if lock is None:
        print(BUSY, file=sys.stderr)
        return 1
    dry = {"-n", "--dry-run", "--dryrun"} & set(options)
    for line in run.discard(sweeps, names) if not dry else ():
        print(f"reproduce: {line}", file=sys.stderr)
    start = time.time() - 1
    blocks, cells = run.lacking(sweeps, names)
    if line := run.shortage(blocks, cells):
        print(f"reproduce: {line}", file=sys.stderr)
        return 1
    if not any(option.startswith(("-q", "--quiet")) for option in options):
        options += ["--quiet", "rules", "host", "reason", "progress"]
    # Snakemake would not miss a block that a dataset has already been joined from.
    with run.progress(blocks, cells):
        status = run_snakemake([*targets(names), *blocks, *options], [])
    for line in last_words(start) if status else ():
        print(line, file=sys.stderr)
    return status
