"""./reproduce compare A B [FIGURE ...]: show the differences between two variants."""

from ... import config
from ...records.sources import ROOT
from .. import figures, running
from ..arguments import Arguments
from ..session import CommandLineError, interruptible, locked, one_line


def run(args: Arguments) -> int:
    """Make the missing results of two variants and print what differs."""
    checked, hidden = args.checked, set(config.PUBLISHED) - {config.PAPER}
    variants = {name: block for name, block in checked["variants"].items() if name not in hidden}
    names = [name for name in (args.a, args.b) if name is not None]
    for name in names:
        if name not in variants:
            raise CommandLineError(config.unknown("variant", name, list(variants)))
    if len(set(names)) < 2:
        raise CommandLineError(f"compare needs two names of {', '.join(variants)}")
    with locked():
        for name in names:
            files = figures.of_scenes(checked, name, args.figure)
            status = figures.make(checked, name, files, args.options, brief=True)
            if status and not (name in config.PUBLISHED and figures.absent(checked, name)):
                return status
        if running.is_dry_run(args.options):
            return 0
        from ...checks.compare import compare

        scenes = args.figure or list(checked["scenes"])
        print()
        with interruptible(), one_line():
            absent = [figures.absent(checked, name) for name in names]
            compare(ROOT, variants, names, absent, scenes)
    return 0
