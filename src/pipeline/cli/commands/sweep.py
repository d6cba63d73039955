"""./reproduce sweep and atlas."""

import shutil

from ...checks.freshness import Freshness
from ...config import build_specs, paths, unknown
from ...records.files import identity
from ...records.sources import ROOT
from .. import figures, running
from ..packages import add_packages
from ..session import CommandLineError, UsageError, locked


def run(args) -> int:
    """The datasets of the sweeps, or of those named first; with `atlas` their pictures too."""
    sweeps = args.checked["sweeps"]
    names, options = chosen(sweeps, args.sweep), args.options
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
            status = figures.made(paths.ATLAS, files, before)
    return status


def chosen(sweeps, names) -> list[str]:
    """The sweeps that are named, all where none is."""
    for name in names:
        if name not in sweeps:
            raise CommandLineError(unknown("sweep", name, list(sweeps)))
    if not sweeps:
        raise UsageError("config.yaml: sweeps: missing, or empty")
    return list(dict.fromkeys(names)) or list(sweeps)
