"""The job server of a run: it forks a process for each job.

A new Python takes longer to load packages than most jobs take to compute, so the server loads them
once. `workflow/scripts/make.py` asks it for a result. Without ./reproduce, a plain snakemake has no
server and starts a new Python for each job.
"""

import multiprocessing
import os
import signal
import socketserver
import sys
import tempfile
import threading
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from multiprocessing import forkserver
from multiprocessing.context import ForkServerContext, SpawnContext
from pathlib import Path
from typing import TYPE_CHECKING

from ..records.build_spec import BuildSpec
from ..records.files import write_whole
from ..records.record import log_path
from . import job

if TYPE_CHECKING:  # jobs, and an installation, load this module without the config's
    from ..checks.freshness import Freshness

ADDRESS = "PSEUDORIGID_JOBS"  # the variable that holds the path of the server's socket
# Read by numerical libraries when they are loaded: a job has one thread, or starts its own.
_LIBRARIES = ("OMP", "GOTO", "OPENBLAS", "MKL", "NUMEXPR")
THREADS = [*(f"{name}_NUM_THREADS" for name in _LIBRARIES), "VECLIB_MAXIMUM_THREADS"]


def run(context: ForkServerContext | SpawnContext, spec: BuildSpec) -> bool:
    """Make a result in a process of its own, and return whether it is current afterwards."""
    # The exit status is no answer: multiprocessing may lose it if other threads start jobs.
    receiver, answer = context.Pipe(duplex=False)
    process = context.Process(target=job.make, args=(spec, answer))
    made, reason = False, "it could not start"
    with receiver, suppress(OSError, EOFError):
        process.start()
        answer.close()
        made = receiver.recv()
    if process.pid:
        process.join()
        status = process.exitcode or 0
        reason = signal.Signals(-status).name if status < 0 else "it ended without a message"
    log = Path(log_path(spec.result))
    if not made and not log.exists():
        words = f"the job was killed ({reason}): memory may be short"
        with suppress(ValueError):  # the disk may be full
            write_whole(log, f"pseudorigid: {spec.scene}: {words}\n")
    return made


class _Server(socketserver.ThreadingUnixStreamServer):
    daemon_threads = True
    request_queue_size = 64


@contextmanager
def job_server(freshness: "Freshness", outdated: Iterable[str]) -> Iterator[dict[str, str]]:
    """Serve the jobs that make the `outdated` results of a run while the body runs.

    Yields the environment variables with which snakemake finds the server; none if no server could
    be started.
    """

    class Handler(socketserver.StreamRequestHandler):
        def handle(self) -> None:
            # The client may have been killed, or the process that forks jobs.
            with suppress(OSError, EOFError):
                path = self.rfile.readline().decode().rstrip("\n")
                current = freshness.is_current_now(path)
                made = current or run(jobs, freshness.build_specs[path])
                self.wfile.write(b"1" if made else b"0")

    jobs = multiprocessing.get_context("forkserver")
    with ExitStack() as stack:
        try:
            folder = stack.enter_context(tempfile.TemporaryDirectory())
            address = f"{folder}/jobs"
            server = stack.enter_context(_Server(address, Handler))
            _start_forkserver(any(path.endswith(".nc") for path in outdated))
        except OSError:
            yield {}  # the temporary folder is full, or its name is too long for a socket
            return
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield {ADDRESS: address}
        server.shutdown()


def _start_forkserver(data: bool) -> None:
    """Start the process that forks jobs; it imports what drawings need, or also what `data` do."""
    wanted = "data" if data else ""
    before = dict(os.environ)
    os.environ.update(dict.fromkeys(THREADS, "1") | {"PSEUDORIGID_PRELOAD": wanted})
    # Jobs inherit this: Ctrl-C is for this process alone, which then ends the jobs.
    handler = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        jobs = multiprocessing.get_context("forkserver")
        jobs.set_forkserver_preload([f"{__package__}.preload"])
        forkserver.ensure_running()
    finally:
        signal.signal(signal.SIGINT, handler)
        os.environ.clear()
        os.environ.update(before)


if __name__ == "__main__":
    (_result,) = sys.argv[1:]
    from .plan import plan

    _freshness = plan().freshness
    _current = _freshness.is_current_now(_result)
    _context = multiprocessing.get_context("spawn")
    sys.exit(not (_current or run(_context, _freshness.build_specs[_result])))
