"""Run snakemake on the outdated results, in an environment of its own, until a signal comes."""

import os
import signal
import subprocess
import sys
import warnings
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from types import FrameType
from typing import Any

from ..jobs.heartbeat import clear_line
from ..records.files import disk_is_full, memory_is_short, read_text, why_not_a_file
from ..records.provenance import DAMAGED, Freshness, log_path, record_path, with_dependencies
from ..records.sources import ROOT
from .arguments import Arguments
from .errors import UsageError, print_error

INTERRUPTED = 130
RUN = "PSEUDORIGID_RUN"  # a variable of runs that end with this process
# Reasons that are printed when a result is made again, because no edit explains them.
_REPORTED = ("its record", "no record", DAMAGED)
_LOGS = ".snakemake/log/*.log"  # one of each run
_NUMBA_SETTINGS = ("NUMBA_CACHE_DIR", "NUMBA_CPU_NAME", "NUMBA_CPU_FEATURES", "NUMBA_DISABLE_JIT")


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
    python, options = [sys.executable, "-P", "-m"], [*_profile(), "--cores", args.cores]
    options += ["--dry-run"] * args.dry_run
    options += [] if args.makes_nothing else ["--logger", "reproduce"]
    if not args.options:
        options += ["--executor", "reproduce", "--", *outdated]
        return _run([*python, "pipeline.jobs.forks", *options], remote=False)
    command = [*python, "snakemake", *options, *args.options, "--", *paths]
    if not args.makes_nothing:
        return _run(command, remote=True)
    result = subprocess.run(command, stdout=subprocess.PIPE, check=False)
    sys.stdout.write(result.stdout.decode(errors="replace"))  # to a reader that may end: `| head`
    return result.returncode


def _profile() -> list[str]:
    """Return the options of profiles/default. If snakemake reads them there, it prints a line.

    The lock of a killed snakemake would stop the next run, and ./reproduce has a lock of its own.
    """
    import yaml  # none of the packages is there when they are installed

    options = ["--workflow-profile", "none", "--nolock"]
    for name, value in yaml.safe_load(read_text(ROOT / "profiles/default/config.yaml")).items():
        values = value if isinstance(value, list) else [value]
        options += [f"--{name}", *(str(each) for each in values if each is not True)]
    return options


def _run(command: list[str], remote: bool) -> int:
    """Run snakemake in a process group of its own, and return its exit status.

    It inherits the lock, and its stdin closes when this process ends. If its jobs may be `remote`,
    on other machines, it is asked to cancel them on Ctrl-C.
    """
    before = {*ROOT.glob(_LOGS)}
    environment = os.environ if remote else os.environ | {RUN: "1"}
    how: dict[str, Any] = {"stdin": subprocess.PIPE, "process_group": 0, "close_fds": False}
    with (
        suppress(KeyboardInterrupt),
        interruptible(end=not remote) as caught,
        subprocess.Popen(command, env=environment, **how) as child,
    ):
        try:
            status = child.wait()
        except KeyboardInterrupt:
            if remote:
                child.send_signal(signal.SIGINT)
                child.wait()
            raise
    clear_line()  # of a snakemake that was killed
    if caught:
        print_error("interrupted: run it again to go on")
        return INTERRUPTED
    if status < 0:
        print_error(f"snakemake was killed ({signal.Signals(-status).name}): memory may be short")
    if status and (logs := {*ROOT.glob(_LOGS)} - before):  # none if it refuses its arguments
        print_error(f"snakemake's log: {logs.pop().relative_to(ROOT)}")
    return status


def _end_jobs() -> None:
    """Kill every process that this one started; results are written whole or not at all."""
    import psutil

    for process in psutil.Process().children(recursive=True):
        with suppress(psutil.NoSuchProcess):
            process.kill()


@contextmanager
def interruptible(end: bool = True) -> Iterator[list[int]]:
    """Raise KeyboardInterrupt in the body on Ctrl-C, SIGTERM or SIGHUP, and end the jobs.

    Jobs end at once, or without `end` after the body. Yields a list that gets the signal's number.
    """
    caught: list[int] = []
    numbers = [signal.SIGINT, signal.SIGTERM]
    if signal.getsignal(signal.SIGHUP) != signal.SIG_IGN:  # which nohup sets
        numbers.append(signal.SIGHUP)

    def stop(number: int, frame: FrameType | None) -> None:
        caught.append(number)
        warnings.simplefilter("ignore")  # multiprocessing warns that its processes were killed
        for each in numbers:
            signal.signal(each, signal.SIG_IGN)
        if end:
            _end_jobs()
        raise KeyboardInterrupt

    before = {number: signal.signal(number, stop) for number in numbers}
    try:
        yield caught
    finally:
        if caught:
            _end_jobs()  # also jobs that have started since
        for number, handler in before.items():
            signal.signal(number, handler)


def set_environment() -> None:
    """Select this tree's packages and caches, and drop settings of snakemake and numba.

    Settings stay that say whether numba compiles, for which processor, and where it keeps the code.
    """
    caches = ROOT / ".venv" / "cache"
    for name in [*os.environ]:
        if name.startswith(("SNAKEMAKE_", "NUMBA_")) and name not in _NUMBA_SETTINGS:
            del os.environ[name]
    os.environ |= {"PYTHONPATH": str(ROOT / "src"), "XDG_CACHE_HOME": str(caches)}
    os.environ["MPLCONFIGDIR"] = str(caches / "matplotlib")
    for name in ("MPLBACKEND", RUN):  # no window is opened
        os.environ.pop(name, None)
