"""./reproduce compare A B [FIGURE ...]: what differs between two variants."""

from ... import config
from ...checks.freshness import Freshness
from ...config import build_specs
from ...records.sources import ROOT
from .. import figures, running
from ..session import CommandLineError, interruptible, locked, one_line


def run(args) -> int:
    """Make what is missing of two variants, and say what differs between them."""
    checked, more = args.checked, set(config.PUBLISHED) - {config.PAPER}
    variants = {name: made for name, made in checked["variants"].items() if name not in more}
    names = [name for name in (args.a, args.b) if name is not None]
    for name in names:
        if name not in variants:
            raise CommandLineError(config.unknown("variant", name, list(variants)))
    if len(set(names)) < 2:
        raise CommandLineError(f"compare needs two names of {', '.join(variants)}")

    def absent(name):
        freshness = Freshness(ROOT, build_specs.of_variants(checked["variants"]))
        return figures.known_absent(freshness, checked["variants"], name)

    with locked():
        for name in names:
            named = figures.of_scenes(checked, name, args.figure)
            status = figures.make(checked, name, args.options, named, brief=not args.all)
            if status and not (name in config.PUBLISHED and absent(name)):
                return status
        if running.is_dry_run(args.options):
            return 0
        from ...checks.compare import compare

        scenes = args.figure or list(checked["scenes"])
        print()
        with interruptible(), one_line():
            compare(ROOT, variants, names, [*map(absent, names)], scenes, args.all)
    return 0
