"""./reproduce variant NAME [FIGURE ...]: the figures of a variant."""

from ... import config
from ...config.checking.reading import load
from ...records.sources import ROOT
from .. import figures
from ..folder import MisuseError, locked


def run(given) -> int:
    """Make one variant's figures, or those that are named."""
    checked = load(ROOT / "config.yaml")
    own = [name for name in checked["variants"] if name not in config.PUBLISHED]
    if given.name is None:
        raise MisuseError(f"variant needs a name: config.yaml has {', '.join(own) or 'none'}")
    if given.name not in own:
        raise MisuseError(config.unknown("variant", given.name, own))
    named = figures.of_scenes(checked, given.name, given.figure)
    with locked():
        return figures.make(checked, given.name, given.options, named)
