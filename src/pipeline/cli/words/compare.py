"""./reproduce compare A B [FIGURE ...]: what differs between two variants."""

from ... import config
from ...checks.currency import Currency
from ...config import expected
from ...records.sources import ROOT
from .. import figures, running
from ..folder import MisuseError, interruptible, locked, one_line


def run(given) -> int:
    """Make what is missing of two variants, and say what differs between them."""
    checked, more = given.checked, set(config.PUBLISHED) - {config.PAPER}
    variants = {name: made for name, made in checked["variants"].items() if name not in more}
    names = [name for name in (given.a, given.b) if name is not None]
    for name in names:
        if name not in variants:
            raise MisuseError(config.unknown("variant", name, list(variants)))
    if len(set(names)) < 2:
        raise MisuseError(f"compare needs two names of {', '.join(variants)}")

    def absent(name):
        currency = Currency(ROOT, expected.of_variants(checked["variants"]))
        return figures.known_absent(currency, checked["variants"], name)

    with locked():
        for name in names:
            named = figures.of_scenes(checked, name, given.figure)
            status = figures.make(checked, name, given.options, named, brief=not given.all)
            if status and not (name in config.PUBLISHED and absent(name)):
                return status
        if running.only_says(given.options):
            return 0
        from ...checks.compare import compare

        scenes = given.figure or list(checked["scenes"])
        print()
        with interruptible(), one_line():
            compare(ROOT, variants, names, [*map(absent, names)], scenes, given.all)
    return 0
