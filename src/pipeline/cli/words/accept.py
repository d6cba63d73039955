"""./reproduce accept: what is here becomes the committed state."""

from ...config.checking.reading import load
from ...records.sources import ROOT
from ..folder import interruptible, locked


def run(given) -> int:
    """Renew the contracts, and say what changed."""
    checked = load(ROOT / "config.yaml")
    from ...checks.accept import accept

    with locked(), interruptible():
        return accept(ROOT, checked)
