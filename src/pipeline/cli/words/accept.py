"""./reproduce accept: what is here becomes the committed state."""

from ...checks.accept import accept
from ...records.sources import ROOT
from ..folder import interruptible, locked


def run(given) -> int:
    """Renew the contracts, and say what changed."""
    with locked(), interruptible():
        return accept(ROOT, given.checked)
