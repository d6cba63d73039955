"""./reproduce verify, which with --against PLACE compares with an archive or another tree."""

import os

from pipeline.cli.arguments import Arguments
from pipeline.cli.commands import verify
from pipeline.cli.errors import CommandLineError, one_line
from pipeline.records.sources import ROOT

from .. import archive


def run(args: Arguments) -> int:
    """Print how each file compares, and return 0 if all are the same."""
    if args.against is None:
        return verify.run(args)
    if args.json:
        raise CommandLineError("verify: --json is not used with --against")
    other = args.start / args.against
    # Path.exists raises an error for a name that is too long or in a folder without access.
    if not args.against or not os.path.exists(other):
        raise CommandLineError(f"verify: no archive or folder {args.against or repr('')}")
    with one_line("verify: ", archive.ArchiveError):
        return archive.compare(ROOT, args.config, other)
