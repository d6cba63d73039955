"""./reproduce prove: check each theorem from its certificate."""

from ...records.files import write_whole
from ...records.sources import ROOT
from .. import figures
from ..arguments import CERTIFICATES, Arguments, hint
from ..session import CommandLineError, interruptible, locked, one_line, print_error


def run(args: Arguments) -> int:
    """Print a line for each theorem; the status is 1 if one is not proved."""
    if args.search + args.impacts + args.pictures > 1:
        raise CommandLineError("prove: use one of --search, --impacts and --pictures")
    if args.theorem and (args.impacts or args.pictures):
        raise CommandLineError("prove: --impacts and --pictures take no theorems")
    if args.pictures:
        with locked():
            wanted = figures.of_scenes(args.checked, "proofs")
            return figures.make(args.checked, "proofs", wanted, [])
    if args.impacts:
        from ...checks.proved_impacts import impacts

        with locked(), interruptible(), one_line():
            return int(impacts(args.checked))
    from pseudorigid.proofs import THEOREMS, search_certificate

    for name in args.theorem:
        if name not in THEOREMS:
            meant = hint(name, list(THEOREMS)) or f": there are {', '.join(THEOREMS)}"
            raise CommandLineError(f"no theorem {name}{meant}")
    files = {
        name: f"{CERTIFICATES}/{THEOREMS[name].certificate}" for name in args.theorem or THEOREMS
    }
    for name, file in files.items() if args.search else ():
        print_error(f"searching for a certificate of {name}")
        write_whole(ROOT / file, search_certificate(name))
    status = 0
    for name in files:
        result = THEOREMS[name].check()
        print(result.line(), flush=True)
        status |= result.verdict != "proved"
    print("", *dict.fromkeys(files.values()), sep="\n", flush=True)
    return status
