"""./reproduce verify: whether everything here is as committed."""

import argparse
from pathlib import Path

from ...config.checking.reading import load
from ...records.sources import ROOT
from ..folder import UsageError


def run(word, arguments, start) -> int:
    """Compare the tree with its contracts; 0 where nothing is red."""
    parser = argparse.ArgumentParser(
        prog="reproduce verify",
        description="Say for each published file whether it is the committed one, or which layers "
        "differ: config, source, environment, data, drawing, file. Exit 1 for other bytes and for "
        "results that this tree did not make; other differences are notes.",
    )
    parser.add_argument(
        "--against",
        type=Path,
        metavar="PLACE",
        help="an archive: compare this tree with it, file by file; or a folder with another tree "
        "or its results: say how many ulp lie between its data and these",
    )
    parser.add_argument("--strict", action="store_true", help="exit 1 for notes too")
    given = parser.parse_args(arguments)
    against = given.against and start / given.against
    if against is not None and not against.exists():
        raise UsageError(f"verify: no archive or folder {against}")
    checked = load(ROOT / "config.yaml")
    if against is not None and not against.is_dir():
        from ...checks import archive

        try:
            return archive.verify(ROOT, checked, against)
        except archive.ArchiveError as error:
            raise UsageError(f"verify: {error}") from None
    from ...checks.verify import verify

    return verify(ROOT, checked, against, given.strict)
