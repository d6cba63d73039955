"""./reproduce claims: every statement of the paper, checked."""

from collections import Counter

from ...config import paths
from ...records.artifacts import ArtifactError
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
        files = figures.of_scenes(checked, "claims")
        data = claim_verdicts.dataset_paths(checked).values()
        status = figures.make(checked, "claims", files, args.options, data)
        if status or running.is_dry_run(args.options):
            return status
        with interruptible():
            verdicts = claim_verdicts.write(checked)
    counts = Counter(verdict.verdict for verdict in verdicts)
    print(f"\n{paths.LEDGER}: " + ", ".join(f"{n} {word}" for word, n in counts.items()))
    return 0
