"""./reproduce claims: every statement of the paper, checked."""

from collections import Counter

from ...checks.currency import Currency
from ...config import expected, places
from ...records.artifacts import ArtifactError
from ...records.files import identity
from ...records.sources import ROOT
from .. import figures, running
from ..folder import MisuseError, interruptible, locked, one_line


def run(given) -> int:
    """Make what is missing, draw the pictures, and write CLAIMS.md; or check one claim."""
    if (given.check is None) != (given.data is None):
        raise MisuseError("claims: --check ID and --data FILE go together")
    from .. import ledger

    checked = given.checked

    if given.check is not None:
        name, mark, file = given.data.rpartition("=")
        with one_line(kind=ArtifactError):
            print(ledger.check(checked, given.check, f"{name}{mark}{given.start / file}"))
        return 0
    with locked():
        targets = [*ledger.paths(checked).values()]
        drawings = places.figures(checked["variants"], "claims").values()
        # They are made together with the data, before `figures.make` looks at them.
        before = {behind[-1]: identity(behind[-1]) for _, behind in drawings}
        targets += before
        currency = Currency(ROOT, expected.of_all(checked))
        status = running.make(checked, currency, targets, given.options)
        if status or running.only_says(given.options):
            return status
        if status := figures.make(checked, "claims", given.options, before=before):
            return status
        with interruptible():
            verdicts = ledger.write(checked)
    counts = Counter(verdict.verdict for verdict in verdicts.values())
    print(f"\n{places.LEDGER}: " + ", ".join(f"{n} {word}" for word, n in counts.items()))
    return 0
