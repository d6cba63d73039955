"""./reproduce variant NAME [FIGURE ...] and ./reproduce families: make the scenes of one set."""

from ... import config
from .. import figures
from ..arguments import Arguments
from ..session import CommandLineError, locked


def run(args: Arguments) -> int:
    """Make all figures of a variant, or the named ones, or the pictures of families."""
    name = _variant(args) if "variant" in args else "families"
    files = figures.of_scenes(args.checked, name, getattr(args, "figure", ()))
    with locked():
        return figures.make(args.checked, name, files, args.options)


def _variant(args: Arguments) -> str:
    """Return the name of a variant of config.yaml."""
    variants = [name for name in args.checked["variants"] if name not in config.PUBLISHED]
    if args.variant is None:
        names = ", ".join(variants) or "none"
        raise CommandLineError(f"variant needs a name: config.yaml has {names}")
    figures.require_known("variant", [args.variant], variants)
    return str(args.variant)
