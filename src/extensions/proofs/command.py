"""./reproduce prove: check each theorem from its certificate."""

from collections.abc import Sequence
from contextlib import ExitStack, closing
from functools import partial

from pipeline.cli import publishing
from pipeline.cli.arguments import Arguments, hint
from pipeline.cli.errors import CommandLineError, UsageError, one_line
from pipeline.cli.lock import locked
from pipeline.cli.running import interruptible
from pipeline.cli.table import print_lines, wrapped
from pipeline.jobs.heartbeat import Heartbeat
from pipeline.records.files import replacing
from pipeline.records.sources import ROOT

from .part import CERTIFICATES


def run(args: Arguments) -> int:
    """Check the theorems that changed and print a line for each; 1 if one is not proved."""
    if args.search + args.impacts + args.pictures > 1:
        raise CommandLineError("prove: use one of --search, --impacts and --pictures")
    if (args.theorem or args.again) and (args.impacts or args.pictures):
        raise CommandLineError("prove: --impacts and --pictures take no theorems")
    if args.makes_nothing and (args.search or args.impacts or args.again):
        raise CommandLineError("prove: --search, --impacts and --again do not take -n")
    if args.makes_nothing:  # the packages of THEOREMS may not be installed
        known = [scene for _, scene, stage in args.config.datasets if stage == "theorem"]
    else:
        from . import THEOREMS

        known = [*THEOREMS]
    for name in args.theorem:
        if name not in known:
            meant = hint(name, known) or f": there are {', '.join(known)}"
            raise CommandLineError(f"no theorem {name}{meant}")
    with locked():
        if args.pictures:
            wanted = publishing.drawings_of(args.config, "proofs")
            return publishing.make(args.config, {"proofs": wanted}, args)
        if args.impacts:
            from .proved_impacts import prove_figures

            doing = ["reading the impacts"]
            heartbeat = Heartbeat(lambda: f"reproduce: {doing[0]}")
            with interruptible(), one_line(), closing(heartbeat):
                return int(prove_figures(args.config, partial(doing.__setitem__, 0)))
        return _check(args, args.theorem or known)


def _check(args: Arguments, names: Sequence[str]) -> int:
    """Check theorems, after a search if it is asked for, and print them."""
    from pipeline.records.artifacts import load

    if args.search:
        search(names)
    datasets = args.config.datasets
    known = {scene: path for (_, scene, stage), path in datasets.items() if stage == "theorem"}
    for name in names:
        if name not in known:
            file = f"{CERTIFICATES}/{name}.toml"
            raise UsageError(f"{file} was missing when this run began: search for it, or run again")
    results = [known[name] for name in names]
    for path in results if args.again else ():
        (ROOT / path).unlink(missing_ok=True)
    status = publishing.make(args.config, {"theorems": {}}, args, results)
    if status or args.makes_nothing:
        return status
    for path in results:
        about = load(ROOT / path).attrs
        print_lines(wrapped(about["line"]))
        status |= about["verdict"] != "proved"
    return status


def search(names: Sequence[str]) -> None:
    """Replace the certificates of theorems by new ones if each of these is proved, or none."""
    from pseudorigid.verified.flight import NotProvedError

    from . import THEOREMS, search_certificate

    found = dict[str, str]()

    with closing(
        Heartbeat(lambda: f"{len(found)} of {len(names)} certificates found")
    ) as heartbeat:
        for name in names:
            heartbeat.print(f"reproduce: searching for a certificate of {name}")
            prefix = f"no certificate of {name}: "
            with one_line(prefix), one_line(prefix, NotProvedError):
                text = search_certificate(name)
                THEOREMS[name].prove(text)
                found[name] = text
    with ExitStack() as replaced:  # all of them, once each is written
        for name, text in found.items():
            file = ROOT / CERTIFICATES / f"{name}.toml"
            replaced.enter_context(replacing(file)).write_text(text)
