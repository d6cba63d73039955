"""./reproduce sweep and atlas."""

import shutil
from pathlib import Path

from ...checks.currency import Currency
from ...config import expected, places
from ...records.sources import ROOT
from .. import figures, running
from ..folder import UsageError, locked
from ..packages import add_packages
from ..telling import sweeping


def run(given) -> int:
    """The datasets of the sweeps, or of those named first; with `atlas` their pictures too.

    It is told how far the cells are.
    """
    sweeps = given.checked["sweeps"]
    names, options = sweeping.chosen(sweeps, given.sweep), given.options
    if given.slurm:
        if shutil.which("sbatch") is None:
            raise UsageError("--slurm: there is no sbatch on this machine")
        options = [f"--profile={ROOT / 'workflow' / 'profiles' / 'slurm'}", *options]
        if status := add_packages("slurm"):
            return status
    results = expected.of_sweeps({name: sweeps[name] for name in names})
    targets = [places.sweep_dataset(name) for name in names]
    if given.word == "atlas":
        targets += [file for name in names for file in places.sweep_pictures(name, sweeps[name])]
    with locked():
        currency = Currency(ROOT, results)
        with sweeping.progress(sweeps, currency, targets):
            status = running.make(currency, targets, options)
        if status == 0 and not running.only_says(options):
            drawn = [file for file in targets if file.startswith("results/sweep/figures/")]
            pictures = {places.atlas_published(file): file for file in drawn}
            figures.publish(pictures)
            files = [*targets[: len(names)], *pictures]
            figures.table(places.ATLAS, {path: (Path(path).stem, "made") for path in files})
    return status
