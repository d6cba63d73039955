"""./reproduce verify: whether everything here is as committed."""

import os

from ...records.sources import ROOT
from ..folder import MisuseError, one_line


def run(given) -> int:
    """Compare the tree with its contracts, or with an archive or another tree; 0 if all is well."""
    if given.against is None:
        from ...checks.verify import verify

        return verify(ROOT, given.checked, given.strict)
    place = given.start / given.against
    if not given.against or not os.path.exists(place):
        raise MisuseError(f"verify: no archive or folder {place if given.against else repr('')}")
    from ...checks import archive

    with one_line("verify: ", archive.ArchiveError):
        return archive.verify(ROOT, given.checked, place)
