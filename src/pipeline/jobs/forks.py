"""Jobs in processes of their own, which are forked from one that has loaded their packages.

A new Python takes longer to load packages than most jobs take to compute. The executor of
`snakemake_executor_plugin_reproduce` forks jobs; a plain snakemake starts a new Python for each.
"""

import multiprocessing
import os
import signal
import sys
import threading
from contextlib import suppress
from multiprocessing import forkserver
from multiprocessing.connection import Connection, wait
from multiprocessing.context import ForkServerContext, SpawnContext
from pathlib import Path
from typing import Any

from ..records.files import disk_is_full, write_whole
from ..records.provenance import BuildSpec, log_path
from . import job

# Read by numerical libraries when they are loaded: a job has one thread, or starts its own.
_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "VECLIB_MAXIMUM_THREADS")

# To start a process, multiprocessing asks for the status of all others. A status can be read once:
# if two threads ask for it, it is lost.
_lock = threading.Lock()
PROGRESS: dict[str, str] = {}  # result -> what its job said last of its progress


def run(
    context: ForkServerContext | SpawnContext, spec: BuildSpec, *given: Any, threads: int = 1
) -> bool:
    """Make a result in a process of its own by `job.make`, and return whether it is made."""
    try:
        receiver, stderr = context.Pipe(duplex=False)
        process = context.Process(target=_make, args=(stderr, threads, spec, *given))
        with stderr, _lock:
            process.start()
    except (OSError, EOFError) as error:  # EOFError: the process that forks jobs has ended
        reason = getattr(error, "strerror", None) or "memory or file handles may be short"
        return _failed(spec, f"the job could not start: {reason} (limits: ulimit -a)")
    lines = os.fdopen(receiver.fileno(), errors="replace", closefd=False)
    with receiver, lines, suppress(OSError):
        for line in lines:
            if line.startswith(prefix := f"{spec.scene}: "):
                PROGRESS[spec.result] = line.removeprefix(prefix).rstrip()
            else:
                sys.stderr.write(line)
    wait([process.sentinel])
    with _lock:
        process.join()
    status = process.exitcode
    if status and not Path(log_path(spec.result)).exists():
        reason = signal.Signals(-status).name if status < 0 else f"exit status {status}"
        return _failed(spec, f"the job was killed ({reason}): memory may be short")
    return status == 0


def _failed(spec: BuildSpec, words: str) -> bool:
    """Write the log of a job that wrote none, or to stderr if that fails, and return False."""
    log = log_path(spec.result)
    line = f"pseudorigid: {spec.scene}: {disk_is_full(log) or words}\n"
    try:
        write_whole(log, line)
    except (ValueError, OSError):
        sys.stderr.write(line)
    return False


def _make(stderr: "Connection[Any, Any]", threads: int, *given: Any) -> None:
    """Make a result in this process, which ends afterwards; `stderr` gets what it writes there."""
    os.dup2(stderr.fileno(), 2)
    os.environ["OMP_NUM_THREADS"] = str(threads)  # for what starts its own
    try:
        job.make(*given)
    except SystemExit:  # the log has its words
        sys.exit(1)


def forking() -> ForkServerContext | SpawnContext:
    """Start the process that forks jobs, which imports first what they need (preload.py).

    If it cannot start, because the temporary folder is full or has a name too long for a socket,
    each job is a new Python.
    """
    jobs = multiprocessing.get_context("forkserver")
    before = dict(os.environ)
    os.environ.update(dict.fromkeys(_THREADS, "1"))
    # Jobs inherit this: Ctrl-C is for this process alone, which then ends the jobs.
    handler = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        jobs.set_forkserver_preload([f"{__package__}.preload"])
        forkserver.ensure_running()
    except OSError:
        return multiprocessing.get_context("spawn")
    finally:
        signal.signal(signal.SIGINT, handler)
        os.environ.clear()
        os.environ.update(before)
    return jobs


if __name__ == "__main__":  # both snakemake and the process that forks its jobs load packages
    forking()
    from snakemake.cli import main

    main()
