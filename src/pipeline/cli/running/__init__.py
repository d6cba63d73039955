"""Snakemake as ./reproduce runs it, and what it is told to make again."""

import signal
import sys
from contextlib import nullcontext
from functools import cache
from pathlib import Path

import yaml

from ...checks.currency import DAMAGED, MISSING, Currency
from ...config.expected import needed
from ...records.files import obstacle
from ...records.record import record_path
from ...records.sources import ROOT
from ..arguments import explained
from ..folder import MisuseError, UsageError, interruptible, say

INTERRUPTED = 130
LOGS = []  # snakemake's own, of the runs of this process, from the root
REASONS = {}  # result -> why it could not be made in a run of this process
# Options with which a run would not be one of this folder, and what is so instead.
_ELSEWHERE = {
    "directory": "results are made in the folder of ./reproduce: copy it to have them elsewhere",
    "snakefile": "the Snakefile of this folder is run",
}
_CAUSES = ("its record", "no record", DAMAGED)
# Options with which nothing is made.
_SAY = ("dryrun", "dag", "rulegraph", "filegraph", "d3dag", "lint", "summary", "detailed_summary")
_SAY += ("touch", "list_rules", "list_target_rules", "list_changes", "unlock")


@cache
def _parser():
    """Snakemake's parser of its options, which raises MisuseError."""
    if not any(word.startswith("--report") for word in sys.argv):
        # What makes reports takes long to import, and snakemake goes on where it is not there.
        from snakemake_interface_report_plugins.registry import ReportPluginRegistry

        sys.modules["snakemake.report"] = None
        try:
            ReportPluginRegistry()
        finally:
            del sys.modules["snakemake.report"]
    from snakemake.cli import get_argument_parser

    parser = get_argument_parser()

    def refuse(message):
        raise MisuseError(explained(parser, message))

    parser.error = refuse
    return parser


def options_of(arguments):
    """Snakemake's own reading of its options; MisuseError where it refuses them."""
    parser = _parser()
    from snakemake.exceptions import CliException, WorkflowError

    try:
        options = parser.parse_args(arguments)
    except (CliException, WorkflowError, ValueError) as error:  # of a value, as in --cores x
        raise MisuseError(" ".join(str(error).split())) from None
    for name, what in _ELSEWHERE.items():
        if getattr(options, name):
            raise MisuseError(f"--{name} is not used here: {what}")
    return options


def only_says(arguments) -> bool:
    """Whether these options of snakemake make nothing."""
    options = options_of(arguments) if arguments else None
    return any(getattr(options, name, None) for name in _SAY)


def asked(arguments) -> set[str]:
    """What these options of snakemake ask for, beside numbers of cores."""
    if not arguments:
        return set()
    given, usual = (vars(options_of(some)) for some in (arguments, []))
    different = {
        name
        for name, value in given.items()
        if getattr(value, "__dict__", value) != getattr(usual[name], "__dict__", usual[name])
    }
    return different - {"cores", "jobs", "targets"}


def make(currency, wanted, arguments) -> int:
    """Have snakemake make the results `wanted` where they are not current; its exit status.

    Parameters
    ----------
    currency : checks.currency.Currency
        Of every result that may be needed.
    wanted : iterable of str
        Results, from the root.
    arguments : list of str
        Options for snakemake; `-n` alone is answered here.
    """
    paths = needed(currency.expected, wanted)
    outdated = currency.outdated(paths)
    for path, why in outdated.items():
        if obstacle(ROOT / path):
            raise UsageError(f"{path}: {why}")
        for folder in Path(path).parents:
            if (ROOT / folder).exists() and not (ROOT / folder).is_dir():
                raise UsageError(f"{folder}: a file stands in a folder's place, move it away")
        if why.startswith(_CAUSES):
            say(f"{path}: {why}: made again")
    own = ROOT / ".snakemake"
    for place in (own, *(own.iterdir() if own.is_dir() else ())):
        if place.exists() and not place.is_dir():
            where = place.relative_to(ROOT)
            raise UsageError(f"{where}: a file stands in a folder's place, move it away")
    options = asked(arguments)
    if options == {"dryrun"}:
        from ..telling.plan import plan

        print(*plan(currency, paths), sep="\n")
        return 0
    if options:  # snakemake decides
        return _run(paths, outdated, arguments)
    status, tried, due = 0, set(), currency.due(paths)
    while due:
        status = _run(due, {path: currency.reason(path) for path in due}, arguments) or status
        tried |= set(due)
        if status == INTERRUPTED or tried >= set(outdated):
            break
        # What was made from these is outdated only if they have other bytes now; what could not be
        # made is not tried again.
        currency = Currency(ROOT, currency.expected)
        failed = {path for path in tried if currency.reason(path)}
        due = [
            path
            for path in currency.due(paths)
            if not failed.intersection(needed(currency.expected, [path]))
        ]
    return status


def _run(paths, outdated, arguments) -> int:
    """Run snakemake in this process until some results are made; its exit status."""
    forced = [path for path, why in outdated.items() if why != MISSING]
    computes = any(path.endswith(".nc") for path in outdated)
    targets = [*paths, *map(record_path, paths)]
    from . import server

    makes = not (arguments and only_says(arguments))
    if not makes:
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # of `| head`, which has seen enough
    served = server.serving if makes and server.begin(computes) else nullcontext
    from snakemake.cli import main as snakemake

    from ..telling import steps

    # The lock is ours: one that snakemake leaves behind when killed would stop the next run.
    command = [*_profile(), *(["--forcerun", *forced] if forced else [])]
    command += ["--nolock", "--workflow-profile", "none", *targets, *arguments]
    given = options_of(arguments)
    if given.cores is None and given.jobs is None:
        command += ["--cores", "all"]
    told = makes and not (given.logger or given.quiet or given.verbose)
    if told:
        command += ["--logger", steps.register()]
    executable, status = sys.executable, 0
    with interruptible() as caught, served():
        steps.LogHandler.interrupted = caught
        try:
            snakemake(command)
        except SystemExit as end:
            status = end.code or 0
        except KeyboardInterrupt:
            status = INTERRUPTED
        finally:
            sys.executable = executable  # the Snakefile quotes it for the shell
    if caught:
        say("interrupted: run it again to go on")
        return INTERRUPTED
    if isinstance(status, str):
        print(status, file=sys.stderr)
        return 1
    if told and (handler := steps.LogHandler.last):
        LOGS.extend([handler.log] if handler.log else [])
        REASONS.update(handler.reasons)
        if status and not handler.failed:
            print(*handler.errors, sep="\n", file=sys.stderr)
    return status


def _profile():
    """The options that are passed on every run; as a profile snakemake would tell of them."""
    text = (ROOT / "workflow" / "profiles" / "default" / "config.yaml").read_text(encoding="utf-8")
    for name, value in yaml.safe_load(text).items():
        values = [value] if isinstance(value, str) else value
        yield from (f"--{name}", *([] if value is True else values))
