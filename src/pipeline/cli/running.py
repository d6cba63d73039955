"""Run snakemake on the outdated results."""

import os
import signal
import subprocess
import sys
from collections.abc import Iterable
from typing import Any

from ..records.differences import DAMAGED
from ..records.files import disk_is_full, memory_is_short, why_not_a_file
from ..records.provenance import Freshness, log_path, record_path, with_dependencies
from ..records.sources import ROOT
from .arguments import Arguments
from .session import RUN, UsageError, interruptible, print_error

INTERRUPTED = 130
# Reasons that are printed when a result is made again, because no edit explains them.
_REPORTED = ("its record", "no record", DAMAGED)
# The options of profiles/default; snakemake prints a line if it reads them there. --nolock: the
# lock of a killed snakemake would stop the next run, and ./reproduce has a lock of its own.
OPTIONS = (
    *("--workflow-profile", "none", "--nolock", "--ignore-incomplete", "--keep-incomplete"),
    *("--rerun-triggers", "mtime", "--max-checksum-file-size", "0", "--keep-going"),
    *("--scheduler", "greedy"),
)

_LOGGER = ("--logger", "reproduce")


def make(freshness: Freshness, results: Iterable[str], args: Arguments) -> int:
    """Make those of these results that are outdated, and return snakemake's exit status.

    Results that are known not to exist are left out. `-n` alone is answered without snakemake.
    """
    possible = [path for path in results if not freshness.refusal(path)]
    paths = with_dependencies(freshness.build_specs, possible)
    outdated = freshness.outdated(paths)
    for path, reason in outdated.items():
        for file in (path, record_path(path), log_path(path)):
            if words := why_not_a_file(ROOT / file):
                raise UsageError(f"{file}: {words}")
        if reason.startswith(_REPORTED):
            print_error(f"{path}: {reason}: made again")
    if args.dry_run and not args.options:
        print(*freshness.to_make(paths), sep="\n")
        return 0
    if not outdated and not args.options:
        return 0
    if words := disk_is_full(ROOT) or memory_is_short():
        raise UsageError(words)
    python, options = [sys.executable, "-P", "-m"], [*OPTIONS, "--cores", args.cores]
    command = [*python, "snakemake", *options]
    command += ["--dry-run"] if args.dry_run else []
    if args.makes_nothing:  # its reader may close the pipe, as `head` does
        result = subprocess.run([*command, *args.options, "--", *paths], stdout=-1, check=False)
        sys.stdout.write(result.stdout.decode(errors="replace"))
        return result.returncode
    if args.options:  # jobs may run on other machines
        return _run([*command, *_LOGGER, *args.options, "--", *paths], remote=True)
    options += [*_LOGGER, "--executor", "reproduce", "--", *outdated]
    return _run([*python, "pipeline.jobs.forked", *options], remote=False)


def _run(command: list[str], remote: bool) -> int:
    """Run snakemake, whose jobs may be `remote`: on other machines."""
    with interruptible(end=not remote) as caught:
        try:
            status = _wait(command, remote)
        except KeyboardInterrupt:
            if not caught:
                raise
    if caught:
        print_error("interrupted: run it again to go on")
        return INTERRUPTED
    if status < 0:
        print_error(f"snakemake was killed ({signal.Signals(-status).name}): memory may be short")
    if status and (logs := sorted(ROOT.glob(".snakemake/log/*.log"))):
        newest = logs[-1]  # names begin with the time
        print_error(f"snakemake's log: {newest.relative_to(ROOT)}")
    return status


def _wait(command: list[str], remote: bool) -> int:
    """Run a command in a process group of its own, and return its exit status.

    The command inherits the lock, and its stdin closes when this process ends. If its jobs may be
    `remote`, it is asked to cancel them on Ctrl-C.
    """
    environment = os.environ if remote else os.environ | {RUN: "1"}
    options: dict[str, Any] = {"env": environment, "process_group": 0, "close_fds": False}
    with subprocess.Popen(command, stdin=subprocess.PIPE, **options) as child:
        try:
            return child.wait()
        except KeyboardInterrupt:
            if remote:
                child.send_signal(signal.SIGINT)
                child.wait()
            raise
