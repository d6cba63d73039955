"""./reproduce sweep and atlas."""

import shutil

from ...checks.currency import Currency
from ...config import expected, places, unknown
from ...records.files import identity
from ...records.sources import ROOT
from .. import figures, running
from ..folder import MisuseError, UsageError, locked
from ..packages import add_packages


def run(given) -> int:
    """The datasets of the sweeps, or of those named first; with `atlas` their pictures too."""
    sweeps = given.checked["sweeps"]
    names, options = chosen(sweeps, given.sweep), given.options
    if given.slurm:
        if shutil.which("sbatch") is None:
            raise UsageError("--slurm: there is no sbatch on this machine")
        options = [f"--profile={ROOT / 'profiles' / 'slurm'}", *options]
        add_packages("slurm")
    results = expected.of_sweeps({name: sweeps[name] for name in names})
    files = {path: path for path in map(places.sweep_dataset, names)}
    if given.word == "atlas":
        drawn = [file for name in names for file in places.sweep_pictures(name, sweeps[name])]
        files |= {places.atlas_published(drawing): drawing for drawing in drawn}
    targets = list(files.values())
    with locked():
        before = {file: identity(file) for file in targets}
        currency = Currency(ROOT, results)
        status = running.make(given.checked, currency, targets, options)
        if status == 0 and not running.only_says(options):
            status = figures.made(places.ATLAS, files, before)
    return status


def chosen(sweeps, names) -> list[str]:
    """The sweeps that are named, all where none is."""
    for name in names:
        if name not in sweeps:
            raise MisuseError(unknown("sweep", name, list(sweeps)))
    if not sweeps:
        raise UsageError("config.yaml: sweeps: missing, or empty")
    return list(dict.fromkeys(names)) or list(sweeps)
