"""./reproduce accept: make the published files as they are now the committed ones."""

from ...checks.accept import accept
from ...records.sources import ROOT
from ..arguments import Arguments
from ..session import interruptible, locked


def run(args: Arguments) -> int:
    """Renew the manifests, and print what changed."""
    with locked(), interruptible():
        return accept(ROOT, args.config)
