"""./reproduce variant NAME: the figures of a variant."""

from ... import config
from ...config.checking.reading import load
from ...records.sources import ROOT
from .. import figures, running
from ..folder import UsageError, locked


def run(word, arguments, start) -> int:
    """Make one variant's figures, with the options of snakemake that follow its name."""
    running.refuse_settings(arguments)
    checked = load(ROOT / "config.yaml")
    own = [name for name in checked["variants"] if name not in config.PUBLISHED]
    if not arguments or arguments[0].startswith("-"):
        raise UsageError(f"variant needs a name: config.yaml has {', '.join(own) or 'none'}")
    name, *options = arguments
    if name not in own:
        raise UsageError(config.unknown("variant", name, own))
    with locked():
        return figures.make(checked, name, options)
