"""./reproduce sweep and ./reproduce atlas: make the datasets of sweeps, and their pictures."""

import shutil
from typing import Any

from ...checks.freshness import Freshness
from ...config import build_specs, paths, unknown
from ...records.files import identity
from ...records.sources import ROOT
from .. import figures, running
from ..arguments import Arguments
from ..packages import add_packages
from ..session import CommandLineError, UsageError, locked


def run(args: Arguments) -> int:
    """Make the datasets of all sweeps or of the named ones; `atlas` makes pictures too."""
    sweeps = args.checked["sweeps"]
    names, options = selected(sweeps, args.sweep), args.options
    if args.slurm:
        if shutil.which("sbatch") is None:
            raise UsageError("--slurm: there is no sbatch on this machine")
        options = [f"--profile={ROOT / 'profiles' / 'slurm'}", *options]
        add_packages("slurm")
    results = build_specs.of_sweeps({name: sweeps[name] for name in names})
    files = {path: path for path in map(paths.sweep_dataset, names)}
    if args.word == "atlas":
        drawn = [file for name in names for file in paths.sweep_pictures(name, sweeps[name])]
        files |= {paths.atlas_published(drawing): drawing for drawing in drawn}
    targets = list(files.values())
    with locked():
        before = {file: identity(file) for file in targets}
        freshness = Freshness(ROOT, results)
        status = running.make(args.checked, freshness, targets, options)
        if status == 0 and not running.is_dry_run(options):
            status = figures.publish_and_report(paths.ATLAS, files, before)
    return status


def selected(sweeps: dict[str, Any], names: list[str]) -> list[str]:
    """Return the named sweeps, or all if there are no names."""
    for name in names:
        if name not in sweeps:
            raise CommandLineError(unknown("sweep", name, list(sweeps)))
    if not sweeps:
        raise UsageError("config.yaml: sweeps: missing, or empty")
    return list(dict.fromkeys(names)) or list(sweeps)
