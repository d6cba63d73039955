"""Snakemake as ./reproduce runs it: what it is told to make again, and its options."""

import argparse
import os
import re
import signal
import subprocess
import sys
from contextlib import nullcontext, suppress
from functools import cache
from pathlib import Path

import yaml

from ...checks.freshness import DAMAGED, MISSING, Freshness
from ...config.build_specs import with_dependencies
from ...jobs import server
from ...records.files import obstacle
from ...records.record import log_path, record_path
from ...records.sources import ROOT
from ..arguments import explained
from ..progress.plan import plan
from ..session import CommandLineError, UsageError, interruptible, print_error
from .space import require_space

INTERRUPTED = 130
# Options with which a run would not be one of this folder, and what is so instead.
_ELSEWHERE = {
    "directory": "results are made in the folder of ./reproduce: copy it to have them elsewhere",
    "snakefile": "the Snakefile of this folder is run",
}
_CAUSES = ("its record", "no record", DAMAGED)
# Options with which nothing is made.
_SAY = ("dryrun", "dag", "rulegraph", "filegraph", "d3dag", "lint", "summary", "detailed_summary")
_SAY += ("touch", "list_rules", "list_target_rules", "list_changes", "unlock")
# The options of most runs, which are understood without snakemake: that loads slowly.
_USUAL = argparse.ArgumentParser(add_help=False, allow_abbrev=False, exit_on_error=False)
_USUAL.add_argument("-n", "--dry-run", "--dryrun", action="store_true", dest="dryrun")
_USUAL.add_argument("-c", "--cores")
_USUAL.add_argument("targets", nargs="*")


@cache
def _parser():
    """Snakemake's parser of its options, which raises MisuseError."""
    from snakemake.cli import get_argument_parser  # takes a while

    parser = get_argument_parser()

    def refuse(message):
        raise CommandLineError(explained(parser, message))

    parser.error = refuse
    return parser


def options_of(arguments):
    """Snakemake's own reading of its options; MisuseError where it refuses them."""
    with suppress(argparse.ArgumentError):  # which snakemake has better words for
        options, others = _USUAL.parse_known_args(arguments)
        if not others and re.fullmatch("None|all|[1-9][0-9]*", str(options.cores)):
            return options
    parser = _parser()
    from snakemake.exceptions import CliException, WorkflowError

    try:
        options = parser.parse_args(arguments)
    except (CliException, WorkflowError, ValueError) as error:  # of a value, as in --cores x
        raise CommandLineError(" ".join(str(error).split())) from None
    for name, what in _ELSEWHERE.items():
        if getattr(options, name):
            raise CommandLineError(f"--{name} is not used here: {what}")
    return options


def is_dry_run(arguments) -> bool:
    """Whether these options of snakemake make nothing."""
    options = options_of(arguments)
    return any(getattr(options, name, None) for name in _SAY)


def asked(arguments) -> set[str]:
    """What these options of snakemake ask for, beside numbers of cores."""
    given, usual = (vars(options_of(some)) for some in (arguments, []))
    if given.keys() != usual.keys():
        usual = vars(_parser().parse_args([]))
    different = {
        name
        for name, value in given.items()
        if getattr(value, "__dict__", value) != getattr(usual[name], "__dict__", usual[name])
    }
    return different - {"cores", "jobs", "targets"}


def make(checked, freshness, wanted, arguments) -> int:
    """Have snakemake make the results `wanted` where they are not current; its exit status.

    Parameters
    ----------
    checked : dict
        The checked config.
    freshness : checks.freshness.Freshness
        Of every result of it.
    wanted : iterable of str
        Results, from the root. Those that cannot be made are left out.
    arguments : list of str
        Options for snakemake; `-n` alone is answered here.
    """
    paths = with_dependencies(
        freshness.build_specs, [path for path in wanted if not freshness.refusal(path)]
    )
    outdated = freshness.outdated(paths)
    for path, why in outdated.items():
        if obstacle(ROOT / path):
            raise UsageError(f"{path}: {why}")
        files = (path, record_path(path), log_path(path))
        for folder in dict.fromkeys(folder for file in files for folder in Path(file).parents):
            if (ROOT / folder).exists() and not (ROOT / folder).is_dir():
                raise UsageError(f"{folder}: a file stands in a folder's place, move it away")
        if why.startswith(_CAUSES):
            print_error(f"{path}: {why}: made again")
    own = ROOT / ".snakemake"
    for place in (own, *(own.iterdir() if own.is_dir() else ())):
        if place.exists() and not place.is_dir():
            where = place.relative_to(ROOT)
            raise UsageError(f"{where}: a file stands in a folder's place, move it away")
    options = asked(arguments)
    if options == {"dryrun"}:
        print(*plan(freshness, paths), sep="\n")
        return 0
    if not outdated and not options:
        return 0
    require_space(freshness.build_specs[path] for path in outdated)

    # An input that is made again with the same bytes leaves what was made from it current: this is
    # decided when its job begins. With options, snakemake decides.
    def current(path):
        return not options and Freshness(ROOT, freshness.build_specs).own_reason(path) is None

    run = server.Plan(checked, freshness.build_specs, set(outdated))
    targets = paths if options else [*outdated]
    return _run(run, targets, outdated, arguments, current)


def _run(run, targets, outdated, arguments, current) -> int:
    """Run snakemake until the targets are made; its exit status."""
    forced = [path for path, why in outdated.items() if why != MISSING]
    # The lock is ours: one that snakemake leaves behind when killed would stop the next run.
    command = [sys.executable, "-P", "-m", "snakemake", *_profile()]
    command += ["--forcerun", *forced] if forced else []
    command += ["--nolock", "--workflow-profile", "none", *targets]
    given = options_of(arguments)
    if given.cores is None and getattr(given, "jobs", None) is None:
        command += ["--cores", "all"]
    if is_dry_run(arguments):
        said = subprocess.run([*command, *arguments], stdout=subprocess.PIPE, check=False)
        sys.stdout.write(said.stdout.decode(errors="replace"))
        return said.returncode
    if not any(getattr(given, name, None) for name in ("logger", "quiet", "verbose")):
        command += ["--logger", "reproduce"]
    # On a cluster, which a profile may ask for, a job is a snakemake of its own elsewhere.
    executor = getattr(given, "executor", None)
    remote = bool(getattr(given, "profile", None)) or executor not in (None, "local")
    with interruptible(end=not remote) as caught:
        try:
            with nullcontext({}) if remote else server.job_server(run, current) as variables:
                status = _wait([*command, *arguments], os.environ | variables, remote)
        except KeyboardInterrupt:
            if not caught:
                raise
    if caught:
        print_error("interrupted: run it again to go on")
        return INTERRUPTED
    if status and (logs := sorted(ROOT.glob(".snakemake/log/*.log"))):
        print_error(
            f"snakemake's log: {logs[-1].relative_to(ROOT)}"
        )  # their names begin with the time
    return status


def _wait(command, environment, remote) -> int:
    """Run a command in a group that Ctrl-C does not reach; its stdin closes with this process.

    Where it has jobs on another machine, it is asked to cancel these.
    """
    child = subprocess.Popen(command, stdin=subprocess.PIPE, env=environment, process_group=0)
    with child:
        try:
            return child.wait()
        except KeyboardInterrupt:
            if remote:
                child.send_signal(signal.SIGINT)
                child.wait()
            raise


def _profile():
    """The options that are passed on every run; as a profile snakemake would tell of them."""
    text = (ROOT / "profiles" / "default" / "config.yaml").read_text(encoding="utf-8")
    for name, value in yaml.safe_load(text).items():
        values = [value] if isinstance(value, str) else value
        yield from (f"--{name}", *([] if value is True else values))
