"""Run snakemake: read its options, and make the outdated results."""

import argparse
import os
import re
import signal
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import nullcontext, suppress
from functools import cache
from typing import Any, NoReturn

import yaml

from ..checks.freshness import DAMAGED, MISSING, Freshness
from ..config.build_specs import with_dependencies
from ..jobs import server
from ..records.files import obstacle
from ..records.record import log_path, record_path
from ..records.sources import ROOT
from .arguments import explain
from .session import CommandLineError, UsageError, interruptible, print_error

INTERRUPTED = 130
# Options that would run another workflow or folder, and what to do instead.
_REFUSED = {
    "directory": "results are made in the folder of ./reproduce: copy it to have them elsewhere",
    "snakefile": "the Snakefile of this folder is run",
}
# Reasons to make a result again that a user is told of, since nobody edited anything.
_REPORTED = ("its record", "no record", DAMAGED)
# Options with which snakemake makes nothing.
_DRY_RUN_OPTIONS = (
    *("dryrun", "dag", "rulegraph", "filegraph", "d3dag", "lint", "summary", "detailed_summary"),
    *("touch", "list_rules", "list_target_rules", "list_changes", "unlock"),
)
# The options of most runs, which are read without importing snakemake: that takes long.
_USUAL = argparse.ArgumentParser(add_help=False, allow_abbrev=False, exit_on_error=False)
_USUAL.add_argument("-n", "--dry-run", "--dryrun", action="store_true", dest="dryrun")
_USUAL.add_argument("-c", "--cores")
_USUAL.add_argument("-j", "--jobs")
_USUAL.add_argument("targets", nargs="*")
_USUAL.set_defaults(special=False)


@cache
def _snakemakes_parser() -> argparse.ArgumentParser:
    """Return snakemake's parser, which raises CommandLineError."""
    from snakemake.cli import get_argument_parser

    parser: argparse.ArgumentParser = get_argument_parser()

    def refuse(message: str) -> NoReturn:
        raise CommandLineError(explain(parser, message))

    parser.error = refuse  # type: ignore[method-assign]
    return parser


def options_of(arguments: list[str]) -> argparse.Namespace:
    """Parse options of snakemake; CommandLineError if they are wrong or not used here.

    The attribute `special` says whether there are others than -n and the number of cores.
    """
    with suppress(argparse.ArgumentError):  # snakemake's parser then reports the mistake
        options, others = _USUAL.parse_known_args(arguments)
        numbers = f"{options.cores} {options.jobs}"
        if not others and re.fullmatch("(None|all|[1-9][0-9]*) (None|[1-9][0-9]*)", numbers):
            return options
    from snakemake.exceptions import CliException, WorkflowError

    try:
        options = _snakemakes_parser().parse_args(arguments)
    except (CliException, WorkflowError, ValueError) as error:  # wrong values, as in --cores x
        raise CommandLineError(" ".join(str(error).split())) from None
    for name, instead in _REFUSED.items():
        if getattr(options, name):
            raise CommandLineError(f"--{name} is not used here: {instead}")
    options.special = True
    return options


def is_dry_run(arguments: list[str]) -> bool:
    """Whether snakemake makes nothing with these options."""
    options = options_of(arguments)
    return any(getattr(options, name, None) for name in _DRY_RUN_OPTIONS)


def make(
    checked: dict[str, Any], freshness: Freshness, wanted: Iterable[str], arguments: list[str]
) -> int:
    """Make the results `wanted` that are outdated, and return snakemake's exit status.

    Results that are known not to exist are left out. `arguments` are options for snakemake; `-n`
    alone is answered without it.
    """
    paths = with_dependencies(
        freshness.build_specs, [path for path in wanted if not freshness.refusal(path)]
    )
    outdated = freshness.outdated(paths)
    for path, reason in outdated.items():
        for file in (path, record_path(path), log_path(path)):
            if words := obstacle(ROOT / file):
                raise UsageError(f"{file}: {words}")
        if reason.startswith(_REPORTED):
            print_error(f"{path}: {reason}: made again")
    options = options_of(arguments)
    if options.dryrun and not options.special:
        print(*freshness.plan(paths), sep="\n")
        return 0
    if not outdated and not options.special:
        return 0
    _require_folders(outdated)
    specs = freshness.build_specs

    # If an input keeps its bytes, what was made from it stays current: that is decided when the
    # job begins. With special options, snakemake decides.
    def current(path: str) -> bool:
        return not options.special and Freshness(ROOT, specs).own_reason(path) is None

    forced = [path for path, reason in outdated.items() if reason != MISSING]
    # ./reproduce has its own lock: a killed snakemake would leave one that stops the next run.
    command = [sys.executable, "-P", "-m", "snakemake", *_profile()]
    command += ["--forcerun", *forced] if forced else []
    command += ["--nolock", "--workflow-profile", "none", *(paths if options.special else outdated)]
    return _run(command, arguments, server.Plan(checked, specs, set(outdated)), current)


def _require_folders(results: Iterable[str]) -> None:
    """Raise UsageError if a file stands in the place of a folder in which snakemake writes."""
    files = [ROOT / place(path) for path in results for place in (str, record_path, log_path)]
    for folder in {ROOT / ".snakemake", *(folder for file in files for folder in file.parents)}:
        if folder.exists() and not folder.is_dir():
            name = folder.relative_to(ROOT)
            raise UsageError(f"{name}: a file stands in a folder's place, move it away")


def _run(
    command: list[str], arguments: list[str], run: server.Plan, current: Callable[[str], bool]
) -> int:
    """Run snakemake with further arguments and return its exit status."""
    options = options_of(arguments)
    if options.cores is None and options.jobs is None:
        command += ["--cores", "all"]
    if is_dry_run(arguments):
        result = subprocess.run([*command, *arguments], stdout=subprocess.PIPE, check=False)
        sys.stdout.write(result.stdout.decode(errors="replace"))
        return result.returncode
    if not any(getattr(options, name, None) for name in ("logger", "quiet", "verbose")):
        command += ["--logger", "reproduce"]
    # On a cluster, each job is a snakemake of its own on another machine.
    executor = getattr(options, "executor", None)
    remote = bool(getattr(options, "profile", None)) or executor not in (None, "local")
    no_server: dict[str, str] = {}
    with interruptible(end=not remote) as caught:
        try:
            with nullcontext(no_server) if remote else server.job_server(run, current) as variables:
                status = _wait([*command, *arguments], os.environ | variables, remote)
        except KeyboardInterrupt:
            if not caught:
                raise
    if caught:
        print_error("interrupted: run it again to go on")
        return INTERRUPTED
    if status and (logs := sorted(ROOT.glob(".snakemake/log/*.log"))):
        newest = logs[-1]  # names begin with the time
        print_error(f"snakemake's log: {newest.relative_to(ROOT)}")
    return status


def _wait(command: list[str], environment: dict[str, str], remote: bool) -> int:
    """Run a command in a process group of its own, whose stdin closes when this process ends.

    The command inherits the lock. On Ctrl-C, one with jobs on other machines is asked to cancel
    them.
    """
    options: dict[str, Any] = {"env": environment, "process_group": 0, "close_fds": False}
    with subprocess.Popen(command, stdin=subprocess.PIPE, **options) as child:
        try:
            return child.wait()
        except KeyboardInterrupt:
            if remote:
                child.send_signal(signal.SIGINT)
                child.wait()
            raise


def _profile() -> Iterator[str]:
    """Yield the options of profiles/default; snakemake would print that it uses a profile."""
    text = (ROOT / "profiles" / "default" / "config.yaml").read_text(encoding="utf-8")
    for name, value in yaml.safe_load(text).items():
        values = [value] if isinstance(value, str) else value
        yield from (f"--{name}", *([] if value is True else values))
