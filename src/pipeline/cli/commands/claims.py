"""./reproduce claims: every statement of the paper, checked."""

from collections import Counter

from ...checks.freshness import Freshness
from ...config import build_specs, paths
from ...records.artifacts import ArtifactError
from ...records.files import identity
from ...records.sources import ROOT
from .. import figures, running
from ..arguments import Arguments
from ..session import CommandLineError, interruptible, locked, one_line


def run(args: Arguments) -> int:
    """Compute missing data, draw the pictures and write the verdicts; or judge one claim."""
    if (args.check is None) != (args.data is None):
        raise CommandLineError("claims: --check ID and --data FILE go together")
    from .. import claim_verdicts

    checked = args.checked
    if args.check is not None:
        name, named, file = args.data.rpartition("=")
        with one_line(kind=ArtifactError):
            print(claim_verdicts.check(checked, args.check, f"{name}{named}{args.start / file}"))
        return 0
    with locked():
        targets = [*claim_verdicts.dataset_paths(checked).values()]
        drawings = paths.figures(checked["variants"], "claims").values()
        # The drawings are made together with the data, before `figures.make` looks at them.
        before = {results[-1]: identity(results[-1]) for _, results in drawings}
        targets += before
        freshness = Freshness(ROOT, build_specs.of_all(checked))
        status = running.make(checked, freshness, targets, args.options)
        if status or running.is_dry_run(args.options):
            return status
        if status := figures.make(checked, "claims", args.options, before=before):
            return status
        with interruptible():
            verdicts = claim_verdicts.write(checked)
    counts = Counter(verdict.verdict for verdict in verdicts)
    print(f"\n{paths.LEDGER}: " + ", ".join(f"{n} {word}" for word, n in counts.items()))
    return 0
