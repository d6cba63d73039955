"""./reproduce variant NAME [FIGURE ...]: make the figures of a variant."""

from ... import config
from .. import figures
from ..arguments import Arguments
from ..session import CommandLineError, locked


def run(args: Arguments) -> int:
    """Make all figures of the variant, or the named ones."""
    variants = [name for name in args.checked["variants"] if name not in config.PUBLISHED]
    if args.variant is None:
        names = ", ".join(variants) or "none"
        raise CommandLineError(f"variant needs a name: config.yaml has {names}")
    if args.variant not in variants:
        raise CommandLineError(config.unknown("variant", args.variant, variants))
    files = figures.of_scenes(args.checked, args.variant, args.figure)
    with locked():
        return figures.make(args.checked, args.variant, files, args.options)
