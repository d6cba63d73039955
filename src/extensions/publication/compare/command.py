"""./reproduce compare A B, or a range: show the differences between variants."""

from pipeline.cli import publishing, running
from pipeline.cli.arguments import Arguments
from pipeline.cli.errors import CommandLineError, one_line
from pipeline.cli.lock import locked
from pipeline.cli.running import interruptible
from pipeline.config import MAIN
from pipeline.records.sources import ROOT


def run(args: Arguments) -> int:
    """Make the missing results of two variants or of a range, and print what differs."""
    config = args.config
    names, scenes = publishing.variants_and_scenes(args, MAIN)
    of = next((name for name in args.variant if name in config.ranges), "")
    sound = [name for name in names if name not in config.faulty]
    faulty, scenes = len(sound) < len(names), scenes or list(config.scenes)
    if faulty and not (of and sound):
        return 2
    if {*names} != {*config.ranges[of].members} if of else len(names) != 2:
        raise CommandLineError("compare takes two variants (paper is one), or one range")
    with locked():
        targets = {name: publishing.drawings_of(config, name, scenes) for name in sound}
        status = publishing.make(config, targets, args, brief=True)
        if status == running.INTERRUPTED:
            return status
        if not args.makes_nothing:
            from . import compare, over_range

            print()
            with interruptible(), one_line():
                if of:
                    over_range(ROOT, config, of, scenes)
                else:
                    compare(ROOT, config, names, scenes)
    return 2 if faulty else status
