"""./reproduce claims: every statement of the paper, checked."""

from collections import Counter

from pseudorigid.sweep import grid

from ...checks.currency import Currency
from ...config import places
from ...config.checking.reading import load
from ...records.artifacts import ArtifactError
from ...records.sources import ROOT
from .. import figures, running
from ..folder import MisuseError, UsageError, interruptible, locked
from ..telling import sweeping


def run(given) -> int:
    """Make what is missing, draw the pictures, and write CLAIMS.md; or check one claim."""
    if (given.check is None) != (given.data is None):
        raise MisuseError("claims: --check ID and --data FILE go together")
    checked = load(ROOT / "config.yaml")
    from .. import ledger

    if given.check is not None:
        name, mark, file = given.data.rpartition("=")
        try:
            print(ledger.check(checked, given.check, f"{name}{mark}{given.start / file}"))
        except ArtifactError as error:
            raise UsageError(str(error)) from None
        return 0
    with locked():
        results, needed = ledger.results(checked)
        currency = Currency(ROOT, results)
        variants, sweeps = checked["variants"], checked["sweeps"]
        outdated = currency.outdated(running.needed(results, needed))
        names = [name for name in sweeps if places.sweep_dataset(name) in outdated]
        blocks = sweeping.lacking(sweeps, names, outdated)
        with sweeping.progress(blocks, sum(grid.cells(sweeps[name]) for name in names)):
            drawings = [made[-1] for _, made in places.figures(variants, "claims").values()]
            status = running.make(currency, [*needed, *drawings], given.options)
        if status or running.only_says(given.options):
            return status
        status = figures.make(checked, "claims", given.options)
        if status:
            return status
        with interruptible():
            ledger.derive(checked)
            verdicts = ledger.write(checked)
    counts = Counter(verdict.verdict.partition(":")[0] for verdict in verdicts.values())
    print(f"\n{places.LEDGER}: " + ", ".join(f"{n} {word}" for word, n in counts.items()))
    return 0
