"""./reproduce claims: every statement of the paper, checked."""

import argparse
from collections import Counter

from ...config.checking.reading import load
from ...records.sources import ROOT
from .. import figures, running
from ..folder import UsageError, interruptible, locked, say


def run(word, arguments, start) -> int:
    """Make what is missing, draw the pictures, and write CLAIMS.md; or check one claim."""
    parser = argparse.ArgumentParser(
        prog="reproduce claims",
        description="Check the paper's statements and write CLAIMS.md. What is missing is made "
        "first, the sweeps too.",
    )
    parser.add_argument("--check", type=int, metavar="ID", help="judge one claim alone")
    parser.add_argument(
        "--data",
        metavar="[NAME=]FILE",
        help="a dataset to judge it by, in the place of that name (as in fig2/orbits)",
    )
    given = parser.parse_args(arguments)
    if (given.check is None) != (given.data is None):
        raise UsageError("claims: --check ID and --data FILE go together")
    checked = load(ROOT / "config.yaml")
    from .. import ledger

    if given.check is not None:
        name, mark, file = given.data.rpartition("=")
        print(ledger.check(checked, given.check, f"{name}{mark}{start / file}"))
        return 0
    with locked():
        results, needed = ledger.results(checked)
        since = running.now()
        status = running.make(results, needed, [])
        for line in running.last_words(since) if status else ():
            say(line.removeprefix("pseudorigid: "))
        status = status or figures.make(checked, "claims", [])
        if status:
            return status
        with interruptible():
            ledger.derive(checked)
            verdicts = ledger.write(checked)
    counts = Counter(verdict.verdict.partition(":")[0] for verdict in verdicts.values())
    print(f"\n{ledger.LEDGER}: " + ", ".join(f"{n} {word}" for word, n in counts.items()))
    return 0
