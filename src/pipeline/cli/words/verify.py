"""./reproduce verify: whether everything here is as committed."""

from ...config.checking.reading import load
from ...records.sources import ROOT
from ..folder import MisuseError


def run(given) -> int:
    """Compare the tree with its contracts; 0 where nothing is red."""
    against = given.against and given.start / given.against
    if against is not None and not against.is_dir():
        raise MisuseError(f"verify: no folder {against}")
    checked = load(ROOT / "config.yaml")
    from ...checks.verify import verify

    return verify(ROOT, checked, against, given.strict)
