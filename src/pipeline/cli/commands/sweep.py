"""./reproduce sweep and ./reproduce atlas: make the datasets of sweeps, and their pictures."""

import shutil

from ...config import paths
from ...records.sources import ROOT
from .. import figures
from ..arguments import Arguments
from ..packages import add_packages
from ..session import UsageError, locked


def run(args: Arguments) -> int:
    """Make the datasets of all sweeps or of the named ones; `atlas` makes pictures too."""
    sweeps, options = args.checked["sweeps"], args.options
    figures.require_known("sweep", args.sweep, list(sweeps))
    if not sweeps:
        raise UsageError("config.yaml: sweeps: missing, or empty")
    if args.slurm:
        if shutil.which("sbatch") is None:
            raise UsageError("--slurm: there is no sbatch on this machine")
        options = [f"--profile={ROOT / 'profiles' / 'slurm'}", *options]
        add_packages("slurm")
    files = {}
    for name in args.sweep or sweeps:
        files[paths.sweep_dataset(name)] = name, [paths.sweep_dataset(name)]
        for drawing in paths.sweep_pictures(name, sweeps[name]) if args.word == "atlas" else ():
            files[paths.atlas_published(drawing)] = name, [drawing]
    with locked():
        return figures.make(args.checked, "sweep", files, options)
