"""./reproduce claims: every statement of the paper, checked."""

from collections import Counter

from ...checks.currency import Currency
from ...config.checking.reading import load
from ...records.sources import ROOT
from .. import figures, running
from ..folder import MisuseError, interruptible, locked


def run(given) -> int:
    """Make what is missing, draw the pictures, and write CLAIMS.md; or check one claim."""
    if (given.check is None) != (given.data is None):
        raise MisuseError("claims: --check ID and --data FILE go together")
    checked = load(ROOT / "config.yaml")
    from .. import ledger

    if given.check is not None:
        name, mark, file = given.data.rpartition("=")
        print(ledger.check(checked, given.check, f"{name}{mark}{given.start / file}"))
        return 0
    with locked():
        results, needed = ledger.results(checked)
        status = running.make(Currency(ROOT, results), needed, given.options)
        status = status or figures.make(checked, "claims", given.options)
        if status or running.only_says(given.options):
            return status
        with interruptible():
            ledger.derive(checked)
            verdicts = ledger.write(checked)
    counts = Counter(verdict.verdict.partition(":")[0] for verdict in verdicts.values())
    print(f"\n{ledger.LEDGER}: " + ", ".join(f"{n} {word}" for word, n in counts.items()))
    return 0
