"""./reproduce verify: whether everything here is as committed."""

import os

from ...records.sources import ROOT
from ..arguments import Arguments
from ..session import CommandLineError, one_line


def run(args: Arguments) -> int:
    """Compare the tree with its committed state, an archive or another tree; 0 if all is well."""
    if args.against is None:
        from ...checks.verify import verify

        status = 0
        for findings in verify(ROOT, args.checked, args.committed):
            print(*findings.report(), sep="\n")
            status |= findings.fails(args.strict)
        return int(status)
    other = args.start / args.against
    # Path.exists raises an error for a name that is too long or in a folder without access.
    if not args.against or not os.path.exists(other):
        raise CommandLineError(f"verify: no archive or folder {args.against or repr('')}")
    from ...publication import archive

    with one_line("verify: ", archive.ArchiveError):
        return int(archive.compare(ROOT, args.checked, other))
