"""./reproduce archive: write the figures and what they were made from into one file."""

from ...checks import archive
from ...records.sources import ROOT
from ..arguments import Arguments
from ..session import interruptible, locked, one_line

FILE = "results/archive/pseudorigid.tar"


def run(args: Arguments) -> int:
    """Write the archive; all results must be present and current."""
    path = args.start / args.file if args.file else ROOT / FILE
    with locked(), interruptible(), one_line("archive: ", archive.ArchiveError):
        digest = archive.write(ROOT, args.checked, path)
    print(f"{digest}  {args.file or FILE}  {path.stat().st_size / 1e6:.1f} MB")
    return 0
