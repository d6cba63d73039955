"""./reproduce variant NAME [FIGURE ...]: the figures of a variant."""

from ... import config
from .. import figures
from ..folder import MisuseError, locked


def run(given) -> int:
    """Make one variant's figures, or those that are named."""
    own = [name for name in given.checked["variants"] if name not in config.PUBLISHED]
    if given.variant is None:
        raise MisuseError(f"variant needs a name: config.yaml has {', '.join(own) or 'none'}")
    if given.variant not in own:
        raise MisuseError(config.unknown("variant", given.variant, own))
    named = figures.of_scenes(given.checked, given.variant, given.figure)
    with locked():
        return figures.make(given.checked, given.variant, given.options, named)
