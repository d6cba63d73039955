"""./reproduce sweep and ./reproduce atlas: compute grids over k and E/g^2, and draw them."""

import os
import shutil
import sys

from pipeline.cli import publishing
from pipeline.cli.arguments import Arguments
from pipeline.cli.errors import CommandLineError, UsageError, one_line, print_error
from pipeline.cli.lock import locked
from pipeline.cli.packages import add_packages
from pipeline.cli.running import INTERRUPTED, interruptible
from pipeline.config.schema.parts import SETS
from pipeline.declaration import ONLY_SET
from pipeline.records.sources import ROOT

from .finer import NAME
from .gpu import card


def run(args: Arguments) -> int:
    """Make the datasets of all sweeps or of the named ones; `atlas` makes pictures too."""
    known = args.config.variants["atlas"]
    group = NAME if args.sweep == [NAME] and NAME not in known else "atlas"
    if group not in SETS:  # begin again, in a process that loads it
        os.environ[ONLY_SET] = group
        os.execv(sys.executable, [sys.executable, *sys.orig_argv[1:]])
    sweeps = args.config.variants[group]
    publishing.require_known("sweep", args.sweep, list(sweeps))
    if not sweeps:
        raise UsageError("config.yaml: sweeps: empty")
    if args.slurm and args.gpu:
        raise CommandLineError("--gpu computes on this machine, --slurm on others: choose one")
    if args.slurm:
        if shutil.which("sbatch") is None:
            raise UsageError("--slurm: there is no sbatch on this machine")
        args.options = [f"--profile={ROOT / 'profiles' / 'slurm'}", *args.options]
        add_packages("slurm")
    names = [
        n
        for n in sweeps
        if not args.sweep or {n, sweeps[n].as_mapping().get("over")} & {*args.sweep}
    ]
    drawings = publishing.drawings_of(args.config, group, names) if args.word == "atlas" else {}
    datasets = args.config.datasets
    data = [datasets.get((group, name, "sweep")) for name in names]  # None for verdicts
    if args.gpu and not any(data):
        raise CommandLineError(f"--gpu: {', '.join(names)}: no sweep")
    if args.gpu and not args.makes_nothing:
        with one_line():
            card.require_driver()
        add_packages("gpu")
    with locked():
        if args.gpu and not args.makes_nothing and not _computed(args, [*filter(None, data)]):
            return INTERRUPTED
        files = drawings | {path: path for path in data if path}
        return publishing.make(args.config, {group: files}, args)


def _computed(args: Arguments, datasets: list[str]) -> bool:
    """Compute blocks on a card, and return False if the user stopped it."""
    from .gpu.run import make_blocks  # loads numba

    with one_line(), interruptible() as caught:
        try:
            make_blocks(args.config, datasets, args.cores)
        except KeyboardInterrupt:
            print_error("interrupted: run it again to go on")
    return not caught
