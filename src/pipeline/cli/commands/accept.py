"""./reproduce accept: what is here becomes the committed state."""

from ...checks.accept import accept
from ...records.sources import ROOT
from ..session import interruptible, locked


def run(args) -> int:
    """Renew the contracts, and say what changed."""
    with locked(), interruptible():
        return accept(ROOT, args.checked)
