"""./reproduce compare A B [FIGURE ...]: show the differences between two variants."""

from pipeline.cli import publishing, running
from pipeline.cli.arguments import Arguments
from pipeline.cli.errors import CommandLineError, one_line
from pipeline.cli.lock import locked
from pipeline.cli.running import interruptible
from pipeline.config import MAIN
from pipeline.records.sources import ROOT


def run(args: Arguments) -> int:
    """Make the missing results of two variants and print what differs."""
    config, status = args.config, 0
    known = [MAIN, *config.own_variants]
    names = [name for name in (args.a, args.b) if name is not None]
    publishing.require_known("variant", names, known)
    if len(set(names)) < 2:
        raise CommandLineError(f"compare needs two names of {', '.join(known)}")
    scenes = args.figure or list(config.scenes)
    with locked():
        for name in names:
            drawings = publishing.drawings_of(config, name, scenes)
            made = publishing.make(config, name, drawings, args, brief=True)
            status = made or status
            if status == running.INTERRUPTED:
                return status
        if not args.makes_nothing:
            from . import compare

            print()
            with interruptible(), one_line():
                compare(ROOT, config, names, scenes)
    return status
