"""The lock of this folder."""

import fcntl
import os
import time
from collections.abc import Iterator
from contextlib import contextmanager

from ..records.provenance import require_loaded_unchanged
from ..records.sources import ROOT
from .errors import UsageError, print_error

LOCK_SECONDS = 5.0  # that a run waits for the lock of another one
_NO_LOCKS = "PSEUDORIGID_NO_LOCKS"  # the variable that says that the command has said so


@contextmanager
def locked() -> Iterator[None]:
    """Hold the lock of this folder, which the system releases if the process dies.

    The snakemake of a run inherits the lock. If the run is killed, the next one waits until that
    snakemake has ended: before it ends, it may delete or restore the result of its last job.

    Without locks in the file system, says so once a command. Raises UsageError if another run holds
    the lock for longer than LOCK_SECONDS, and FileError at the end if config.yaml or a loaded
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
