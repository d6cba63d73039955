"""./reproduce variant NAME [FIGURE ...]: the figures of a variant."""

from ... import config
from .. import figures
from ..session import CommandLineError, locked


def run(args) -> int:
    """Make one variant's figures, or those that are named."""
    own = [name for name in args.checked["variants"] if name not in config.PUBLISHED]
    if args.variant is None:
        raise CommandLineError(f"variant needs a name: config.yaml has {', '.join(own) or 'none'}")
    if args.variant not in own:
        raise CommandLineError(config.unknown("variant", args.variant, own))
    named = figures.of_scenes(args.checked, args.variant, args.figure)
    with locked():
        return figures.make(args.checked, args.variant, args.options, named)
