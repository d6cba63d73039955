"""./reproduce archive: one file with figures, data and what they were made from."""

from ...checks import archive
from ...records.sources import ROOT
from ..folder import interruptible, locked, one_line

FILE = "results/archive/pseudorigid.tar"


def run(given) -> int:
    """Write the archive of what is here, which must be complete and current."""
    path = given.start / given.file if given.file else ROOT / FILE
    with locked(), interruptible(), one_line("archive: ", archive.ArchiveError):
        digest = archive.write(ROOT, given.checked, path)
    print(f"{digest}  {given.file or FILE}  {path.stat().st_size / 1e6:.1f} MB")
    return 0
