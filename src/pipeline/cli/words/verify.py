"""./reproduce verify: whether everything here is as committed."""

from ...records.sources import ROOT
from ..folder import MisuseError, one_line

# What another tree has, or the folder of its results.
TREE = ("results", "paper_figures", "figures", "*.nc", "*.png")


def run(given) -> int:
    """Compare the tree with its contracts, or with an archive; 0 where nothing is red."""
    against = given.against and given.start / given.against
    if against is not None and not against.exists():
        raise MisuseError(f"verify: no archive or folder {against}")
    if against is not None and against.is_dir() and not any(map(list, map(against.glob, TREE))):
        raise MisuseError(f"verify: {against} is no tree of this project, and has no results")
    if against is not None and not against.is_dir():
        from ...checks import archive

        with one_line("verify: ", archive.ArchiveError):
            return archive.verify(ROOT, given.checked, against)
    from ...checks.verify import verify

    return verify(ROOT, given.checked, against, given.strict)
