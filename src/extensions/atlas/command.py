"""./reproduce sweep and ./reproduce atlas: compute grids over k and E/g^2, and draw them."""

import shutil

from pipeline.cli import figures
from pipeline.cli.arguments import Arguments
from pipeline.cli.packages import add_packages
from pipeline.cli.session import UsageError, locked
from pipeline.records.sources import ROOT


def run(args: Arguments) -> int:
    """Make the datasets of all sweeps or of the named ones; `atlas` makes pictures too."""
    sweeps = args.config.variants["atlas"]
    figures.require_known("sweep", args.sweep, list(sweeps))
    if not sweeps:
        raise UsageError("config.yaml: sweeps: empty")
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
    drawings = figures.drawings_of(args.config, "atlas", names) if args.word == "atlas" else {}
    datasets = args.config.datasets
    data = [datasets.get(("atlas", name, "sweep")) for name in names]  # None for verdicts
    with locked():
        files = drawings | {path: path for path in data if path}
        return figures.make(args.config, "atlas", files, args)
