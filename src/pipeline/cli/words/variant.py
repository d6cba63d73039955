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
    if given.variant is None:
        raise MisuseError(f"variant needs a name: config.yaml has {', '.join(own) or 'none'}")
    if given.variant not in own:
        raise MisuseError(config.unknown("variant", given.variant, own))
    named = figures.of_scenes(checked, given.variant, given.figure)
    with locked():
        return figures.make(checked, given.variant, given.options, named)
