"""./reproduce accept: what is here becomes the committed state."""

import argparse

from ...config.checking.reading import load
from ...records.sources import ROOT
from ..folder import interruptible, locked


def run(word, arguments, start) -> int:
    """Renew the contracts, and say what changed."""
    argparse.ArgumentParser(
        prog="reproduce accept",
        description="Make the figures, and the study's charts where they were made, as they are "
        "now the committed ones, and say what changed.",
    ).parse_args(arguments)
    checked = load(ROOT / "config.yaml")
    from ...checks.accept import accept

    with locked(), interruptible():
        return accept(ROOT, checked)
