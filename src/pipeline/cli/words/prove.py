"""./reproduce prove: the theorems, each checked from its certificate."""

import argparse
import sys

from ...config.checking.reading import load
from ...records.files import replacing
from ...records.sources import ROOT, SRC
from .. import figures
from ..folder import UsageError, interruptible, locked, say


def run(word, arguments, start) -> int:
    """Check the certificates, a line a theorem; 1 where one is not proved."""
    parser = argparse.ArgumentParser(
        prog="reproduce prove",
        description="Check the certificate of each theorem by ball arithmetic, print a line for "
        "each, and exit 1 where one is not proved.",
    )
    parser.add_argument("name", nargs="*", help="theorems; all without a name")
    group = parser.add_mutually_exclusive_group()
    group.add_argument("--search", action="store_true", help="make the certificates anew first")
    group.add_argument(
        "--impacts", action="store_true", help="prove the impacts behind the figures instead"
    )
    group.add_argument(
        "--pictures", action="store_true", help="draw the pictures, into more_figures/proofs/"
    )
    given = parser.parse_args(arguments)
    if given.pictures:
        with locked():
            return figures.make(load(ROOT / "config.yaml"), "proofs", [])
    if given.impacts:
        from ...checks.proving import impacts

        with locked(), interruptible():
            try:
                return impacts(load(ROOT / "config.yaml"))
            except ValueError as error:  # a file that is missing or damaged, named
                raise UsageError(str(error)) from None
    from pseudorigid.proofs import THEOREMS, search_certificate

    for name in given.name:
        if name not in THEOREMS:
            raise UsageError(f"no theorem {name}: there are {', '.join(THEOREMS)}")
    names = given.name or list(THEOREMS)
    if given.search:
        for name in names:
            say(f"searching a certificate of {name}")
            path = SRC / "pseudorigid" / "proofs" / "certificates" / THEOREMS[name].certificate
            text = search_certificate(name)
            with replacing(path) as part:
                part.write_text(text, encoding="utf-8")
    status = 0
    for name in names:
        result = THEOREMS[name].check()
        print(result.line(), flush=True)
        status |= result.verdict != "proved"
    sys.stdout.flush()
    return status
