"""./reproduce verify: whether everything here is as committed."""

import os

from ...records.sources import ROOT
from ..session import CommandLineError, one_line


def run(args) -> int:
    """Compare the tree with its contracts, or with an archive or another tree; 0 if all is well."""
    if args.against is None:
        from ...checks.verify import verify

        return verify(ROOT, args.checked, args.strict)
    place = args.start / args.against
    if not args.against or not os.path.exists(place):
        raise CommandLineError(
            f"verify: no archive or folder {place if args.against else repr('')}"
        )
    from ...checks import archive

    with one_line("verify: ", archive.ArchiveError):
        return archive.verify(ROOT, args.checked, place)
