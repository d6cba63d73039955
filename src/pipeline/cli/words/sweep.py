"""./reproduce sweep and atlas."""

import shutil

from pseudorigid.sweep import grid

from ...checks.currency import Currency
from ...config import expected, places
from ...config.checking.reading import load
from ...records.sources import ROOT
from .. import figures, running, sweeping
from ..folder import UsageError, locked, say
from ..packages import add_packages


def run(word, arguments, start) -> int:
    """The datasets of the sweeps, or of those named first; with `atlas` their pictures too.

    It is told how far the cells are.
    """
    sweeps = load(ROOT / "config.yaml")["sweeps"]
    names, options = sweeping.chosen(sweeps, arguments)
    if "--slurm" in options:
        if shutil.which("sbatch") is None:
            raise UsageError("--slurm: there is no sbatch on this machine")
        options[options.index("--slurm")] = f"--profile={ROOT / 'workflow' / 'profiles' / 'slurm'}"
        if status := add_packages("slurm"):
            return status
    results = expected.of_sweeps({name: sweeps[name] for name in names})
    targets = [places.sweep_dataset(name) for name in names]
    if word == "atlas":
        targets += [file for name in names for file in places.sweep_pictures(name, sweeps[name])]
    with locked():
        outdated = Currency(ROOT, results).outdated(running.needed(results, targets))
        blocks = sweeping.lacking(sweeps, names, outdated)
        cells = sum(grid.cells(sweeps[name]) for name in names)
        if line := sweeping.shortage(blocks, cells):
            raise UsageError(line)
        if not any(option.startswith(("-q", "--quiet")) for option in options):
            options += ["--quiet", "rules", "host", "reason", "progress"]
        since = running.now()
        with sweeping.progress(blocks, cells):
            status = running.make(results, targets, options)
        for line in running.last_words(since) if status else ():
            say(line.removeprefix("pseudorigid: "))
        if status == 0 and word == "atlas" and not running.only_says(options):
            drawn = [file for file in targets if file.startswith("results/sweep/figures/")]
            figures.publish({places.atlas_published(file): file for file in drawn})
    return status
