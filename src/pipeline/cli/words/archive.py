"""./reproduce archive: one file with figures, data and what they were made from."""

import argparse
from pathlib import Path

from ...config.checking.reading import load
from ...records.sources import ROOT
from ..folder import UsageError, interruptible, locked

FILE = "results/archive/pseudorigid.tar"


def run(word, arguments, start) -> int:
    """Write the archive of what is here, which must be complete and current."""
    parser = argparse.ArgumentParser(
        prog="reproduce archive",
        description="Write one tar, the same to the byte wherever its files are, with figures, "
        "data, config, contracts, provenance, claims and certificates. Everything must be made.",
    )
    parser.add_argument("file", nargs="?", type=Path, metavar="FILE", help=f"by default {FILE}")
    given = parser.parse_args(arguments).file
    path = start / given if given else ROOT / FILE
    checked = load(ROOT / "config.yaml")
    from ...checks import archive

    with locked(), interruptible():
        try:
            digest = archive.write(ROOT, checked, path)
        except archive.ArchiveError as error:
            raise UsageError(f"archive: {error}") from None
    print(f"{digest}  {given or FILE}  {path.stat().st_size / 1e6:.1f} MB")
    return 0
