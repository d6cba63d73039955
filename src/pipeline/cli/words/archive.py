"""./reproduce archive: one file with figures, data and what they were made from."""

from ...config.checking.reading import load
from ...records.sources import ROOT
from ..folder import UsageError, interruptible, locked

FILE = "results/archive/pseudorigid.tar"


def run(given) -> int:
    """Write the archive of what is here, which must be complete and current."""
    path = given.start / given.file if given.file else ROOT / FILE
    checked = load(ROOT / "config.yaml")
    from ...checks import archive

    with locked(), interruptible():
        try:
            digest = archive.write(ROOT, checked, path)
        except archive.ArchiveError as error:
            raise UsageError(f"archive: {error}") from None
    print(f"{digest}  {given.file or FILE}  {path.stat().st_size / 1e6:.1f} MB")
    return 0
