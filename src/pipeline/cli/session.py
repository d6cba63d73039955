"""The lock of this folder, interrupts, error messages and environment of a run."""

import fcntl
import os
import signal
import sys
import time
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from types import FrameType

from ..records.provenance import require_loaded_unchanged
from ..records.sources import ROOT

LOCK_SECONDS = 5.0  # that a run waits for the lock of another one
RUN = "PSEUDORIGID_RUN"  # a variable of runs that end with this process
_NO_LOCKS = "PSEUDORIGID_NO_LOCKS"  # the variable that says that the command has said so


class UsageError(Exception):
    """One line for the user, which ends the run with the exit status `status`."""

    status = 1


class CommandLineError(UsageError):
    """One line about a mistake in the command line."""

    status = 2


@contextmanager
def one_line(prefix: str = "", kind: type[Exception] = ValueError) -> Iterator[None]:
    """Turn an error of this kind, whose message is for users, into a UsageError."""
    try:
        yield
    except kind as error:
        raise UsageError(prefix + str(error).replace(f"{ROOT}/", "")) from None


@contextmanager
def locked() -> Iterator[None]:
    """Hold the lock of this folder, which the system releases if the process dies.

    The snakemake of a run inherits the lock. If the run is killed, the next one waits until that
    snakemake has ended: before it ends, it may delete or restore the result of its last job.

    Without locks in the file system, says so once a command. Raises UsageError if another run holds
    the lock for longer than LOCK_SECONDS, and ChangedError at the end if config.yaml or a loaded
    module has changed.
    """
    try:
        # Nothing is written to the lock: a FIFO or a link to another file does no harm.
        flags = os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC
        lock = os.fdopen(os.open(ROOT / ".lock", flags, 0o666))
        (ROOT / "results").mkdir(exist_ok=True)
    except FileExistsError:
        raise UsageError("results is no folder, or a link to none: move it away") from None
    except OSError as error:
        raise UsageError(f"cannot write in {ROOT}: {error.strerror}: {error.filename}") from None
    with lock:
        end = time.monotonic() + LOCK_SECONDS
        while True:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                break
            except BlockingIOError:
                if time.monotonic() > end:
                    raise UsageError("another ./reproduce is running in this folder") from None
            except OSError as error:  # a file system without locks
                if not os.environ.get(_NO_LOCKS):
                    print_error(f"no locks here ({error.strerror}): run one command at a time")
                os.environ[_NO_LOCKS] = "said"
                break
            time.sleep(0.05)
        os.set_inheritable(lock.fileno(), True)
        yield
        require_loaded_unchanged()


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


def print_error(*lines: str) -> None:
    """Print lines for the user to stderr."""
    sys.stdout.flush()  # keeps the order of lines if both streams go to one pipe
    for line in lines:
        print(f"reproduce: {line}", file=sys.stderr, flush=True)


_NUMBA_SETTINGS = ("NUMBA_CACHE_DIR", "NUMBA_CPU_NAME", "NUMBA_CPU_FEATURES", "NUMBA_DISABLE_JIT")


def set_environment() -> None:
    """Select this tree's packages and caches, and drop settings of snakemake and numba.

    Settings stay that say whether numba compiles, for which processor, and where it keeps the code.
    """
    caches = ROOT / ".venv" / "cache"
    for name in [name for name in os.environ if name.startswith(("SNAKEMAKE_", "NUMBA_"))]:
        if name not in _NUMBA_SETTINGS:
            del os.environ[name]
    os.environ |= {"PYTHONPATH": str(ROOT / "src"), "XDG_CACHE_HOME": str(caches)}
    os.environ["MPLCONFIGDIR"] = str(caches / "matplotlib")
    for name in ("MPLBACKEND", RUN):  # no window is opened
        os.environ.pop(name, None)
