"""This folder: one run at a time, what Ctrl-C does, and how lines reach the user."""

import fcntl
import os
import signal
import sys
from contextlib import contextmanager, suppress

from ..jobs.server import ADDRESS
from ..records.record import require_loaded_unchanged
from ..records.sources import ROOT


class UsageError(Exception):
    """One line for the user, and the end of the run with this exit status."""

    status = 1


class CommandLineError(UsageError):
    """The same about what was typed."""

    status = 2


@contextmanager
def one_line(about="", kind=ValueError):
    """An error that is written for the user as the end of the run; `about` stands before."""
    try:
        yield
    except kind as error:
        raise UsageError(about + str(error).replace(f"{ROOT}/", "")) from None


@contextmanager
def locked():
    """Hold the lock of this folder; UsageError where another run has it. Death releases it.

    ChangedError at the end where config.yaml or a module that was loaded has changed.
    """
    try:
        # Nothing is written into it: a FIFO or a link to another file does no harm.
        lock = os.fdopen(
            os.open(ROOT / ".lock", os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC, 0o666)
        )
        (ROOT / "results").mkdir(exist_ok=True)
    except OSError as error:
        raise UsageError(f"cannot write in {ROOT}: {error.strerror}: {error.filename}") from None
    with lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            raise UsageError("another ./reproduce is running in this folder") from None
        yield
        require_loaded_unchanged()


def end_jobs() -> None:
    """Kill every process that this one started: results appear whole or not at all."""
    import psutil

    for process in psutil.Process().children(recursive=True):
        with suppress(psutil.NoSuchProcess):
            process.kill()


@contextmanager
def interruptible(end=True):
    """Ctrl-C, SIGTERM or SIGHUP raises KeyboardInterrupt in here and ends the jobs.

    They end at once, or without `end` when the body has ended. Yields a list that then holds the
    signal's number.
    """
    caught, numbers = [], [signal.SIGINT, signal.SIGTERM]
    if signal.getsignal(signal.SIGHUP) != signal.SIG_IGN:  # nohup
        numbers.append(signal.SIGHUP)

    def stop(number, frame):
        caught.append(number)
        for each in numbers:
            signal.signal(each, signal.SIG_IGN)  # once is enough
        if end:
            end_jobs()
        raise KeyboardInterrupt

    before = {number: signal.signal(number, stop) for number in numbers}
    try:
        yield caught
    finally:
        if caught:
            end_jobs()  # those that began meanwhile
        for number, handler in before.items():
            signal.signal(number, handler)


def print_error(*lines: str) -> None:
    """Lines for the user, on stderr."""
    sys.stdout.flush()  # what was printed before stands before, also in a pipe
    for line in lines:
        print(f"reproduce: {line}", file=sys.stderr, flush=True)


NUMBA_SETTINGS = ("NUMBA_CACHE_DIR", "NUMBA_CPU_NAME", "NUMBA_CPU_FEATURES", "NUMBA_DISABLE_JIT")


def set_environment() -> None:
    """Set the tree's own packages, wherever the folder was moved, and caches beside them.

    Settings of snakemake and numba that a user's shell may have do not reach a run, apart from
    those that say for which processor numba compiles, whether it does, and where it keeps that.
    """
    caches = ROOT / ".venv" / "cache"
    for name in [name for name in os.environ if name.startswith(("SNAKEMAKE_", "NUMBA_"))]:
        if name not in NUMBA_SETTINGS:
            del os.environ[name]
    os.environ |= {"PYTHONPATH": str(ROOT / "src"), "XDG_CACHE_HOME": str(caches)}
    os.environ["MPLCONFIGDIR"] = str(caches / "matplotlib")
    for name in ("MPLBACKEND", ADDRESS):  # nothing here opens a window; each run has its server
        os.environ.pop(name, None)
