"""./reproduce verify: whether everything here is as committed."""

from ...checks.verify import verify
from ...records.sources import ROOT
from ..arguments import Arguments


def run(args: Arguments) -> int:
    """Compare the tree with its committed state; 0 if all is well."""
    status = 0
    for findings in verify(ROOT, args.config, args.committed):
        print(*findings.report(), sep="\n")
        status |= findings.fails(args.strict)
    return int(status)
