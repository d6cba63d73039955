"""./reproduce prove: the theorems, each checked from its certificate."""

import os

from ...records.files import write_whole
from ...records.sources import ROOT
from .. import figures
from ..arguments import CERTIFICATES, hint
from ..folder import MisuseError, interruptible, locked, one_line, say


def run(given) -> int:
    """Check the certificates, a line a theorem; 1 where one is not proved."""
    if given.search + given.impacts + given.pictures > 1:
        raise MisuseError("prove: --search, --impacts and --pictures are one at a time")
    if given.theorem and (given.impacts or given.pictures):
        raise MisuseError("prove: --impacts and --pictures take no theorems")
    if given.pictures:
        with locked():
            return figures.make(given.checked, "proofs", [])
    if given.impacts:
        from ...checks.proving import impacts

        with locked(), interruptible(), one_line():
            return impacts(given.checked)
    from pseudorigid.proofs import THEOREMS, search_certificate

    for name in given.theorem:
        if name not in THEOREMS:
            there = f"there are {', '.join(THEOREMS)}"
            raise MisuseError(f"no theorem {name}{hint(name, THEOREMS) or f': {there}'}")
    names = given.theorem or list(THEOREMS)
    if given.search:
        for name in names:
            say(f"searching a certificate of {name}")
            path = ROOT / CERTIFICATES / THEOREMS[name].certificate
            write_whole(path, search_certificate(name))
    status = 0
    for name in names:
        result = THEOREMS[name].check()
        print(result.line(), flush=True)
        status |= result.verdict != "proved"
    files = dict.fromkeys(ROOT / CERTIFICATES / THEOREMS[name].certificate for name in names)
    print("", *(os.path.relpath(file, ROOT) for file in files), sep="\n", flush=True)
    return status
