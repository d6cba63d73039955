"""./reproduce prove: check each theorem from its certificate."""

from contextlib import ExitStack

from ...jobs.heartbeat import Heartbeat
from ...records.files import replacing
from ...records.sources import ROOT
from .. import figures
from ..arguments import Arguments, hint
from ..session import CommandLineError, UsageError, interruptible, locked, one_line, print_error

CERTIFICATES = "src/pseudorigid/proofs/certificates"


def run(args: Arguments) -> int:
    """Print a line for each theorem; the status is 1 if one is not proved."""
    if args.search + args.impacts + args.pictures > 1:
        raise CommandLineError("prove: use one of --search, --impacts and --pictures")
    if args.theorem and (args.impacts or args.pictures):
        raise CommandLineError("prove: --impacts and --pictures take no theorems")
    if args.pictures:
        with locked():
            wanted = figures.of_scenes(args.checked, "proofs")
            return figures.make(args.checked, "proofs", wanted, args)
    if args.impacts:
        from ...checks.proved_impacts import impacts

        with locked(), interruptible(), one_line():
            return int(impacts(args.checked))
    from pseudorigid.proofs import THEOREMS, search_certificate
    from pseudorigid.proofs.enclosure.flight import NotProvedError

    for name in args.theorem:
        if name not in THEOREMS:
            meant = hint(name, list(THEOREMS)) or f": there are {', '.join(THEOREMS)}"
            raise CommandLineError(f"no theorem {name}{meant}")
    files = {
        name: f"{CERTIFICATES}/{THEOREMS[name].certificate}" for name in args.theorem or THEOREMS
    }
    found, checked = dict[str, str](), list[str]()

    def progress() -> str:
        searched = f"{len(found)} of {len(files)} certificates found, " if args.search else ""
        return f"{searched}{len(checked)} of {len(files)} theorems checked"

    Heartbeat(progress)
    for name in files if args.search else ():
        print_error(f"searching for a certificate of {name}")
        prefix = f"no certificate of {name}: "
        with one_line(prefix), one_line(prefix, NotProvedError):
            found[name] = search_certificate(name)
    status = 0
    for name in files:
        result = THEOREMS[name].check(found.get(name))
        print(result.line(), flush=True)
        checked.append(name)
        status |= result.verdict != "proved"
    if found and status:
        raise UsageError("the certificates are left as they were: a new one is not proved")
    with ExitStack() as replaced:  # all of them, once each is proved and written
        for name, text in found.items():
            replaced.enter_context(replacing(ROOT / files[name])).write_text(text)
    print("", *files.values(), sep="\n", flush=True)
    return status
