"""./reproduce verify: whether everything here is as committed."""

from ...checks.verify import verify
from ...records.sources import ROOT
from ..arguments import Arguments


def run(args: Arguments) -> int:
    """Compare the tree with its committed state; 0 if all is well."""
    status = 0
    for i, findings in enumerate(verify(ROOT, args.config, args.committed)):
        heading = "\n" * (i > 0) + f"{findings.published_set.folder}/"
        print(heading, *findings.report(), sep="\n")
        status |= findings.fails(args.strict)
    return int(status)
