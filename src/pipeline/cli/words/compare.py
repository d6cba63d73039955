"""./reproduce compare A B: what differs between two variants."""

from ... import config
from ...config.checking.reading import load
from ...records.sources import ROOT
from .. import figures, running
from ..folder import UsageError, interruptible, locked


def run(word, arguments, start) -> int:
    """Make what is missing of two variants, and say what differs between them."""
    running.refuse_settings(arguments)
    checked = load(ROOT / "config.yaml")
    more = set(config.PUBLISHED) - {config.PAPER}
    variants = {name: made for name, made in checked["variants"].items() if name not in more}
    names, options = arguments[:2], arguments[2:]
    for name in names:
        if name not in variants and not name.startswith("-"):
            raise UsageError(config.unknown("variant", name, list(variants)))
    if len(set(names) & set(variants)) < 2:
        raise UsageError(f"compare needs two names of {', '.join(variants)}")
    with locked():
        for name in names:
            status = figures.make(checked, name, options)
            if status and not (name in config.PUBLISHED and figures.known_absent(name)):
                return status
        if running.only_says(options):
            return 0
        from ...checks.compare import compare

        with interruptible():
            print()
            try:
                compare(ROOT, variants, names, [figures.known_absent(name) for name in names])
            except ValueError as error:  # a damaged file, named
                raise UsageError(str(error).replace(f"{ROOT}/", "")) from None
    return 0
