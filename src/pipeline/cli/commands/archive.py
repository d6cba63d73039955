"""./reproduce archive: one file with figures, data and what they were made from."""

from ...checks import archive
from ...records.sources import ROOT
from ..session import interruptible, locked, one_line

FILE = "results/archive/pseudorigid.tar"


def run(args) -> int:
    """Write the archive of what is here, which must be complete and current."""
    path = args.start / args.file if args.file else ROOT / FILE
    with locked(), interruptible(), one_line("archive: ", archive.ArchiveError):
        digest = archive.write(ROOT, args.checked, path)
    print(f"{digest}  {args.file or FILE}  {path.stat().st_size / 1e6:.1f} MB")
    return 0
