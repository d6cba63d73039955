"""The job server of a run: it forks a process for each job.

A new Python takes longer to load packages than most jobs take to compute, so the server loads them
once. `workflow/scripts/make.py` asks it for a result, and the Snakefile asks it for the plan.
Without ./reproduce, a plain snakemake has no server and starts a new Python for each job.
"""

import multiprocessing
import os
import pickle
import signal
import socket
import socketserver
import sys
import tempfile
import threading
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from functools import cache
from multiprocessing import forkserver
from multiprocessing.context import ForkServerContext, SpawnContext
from pathlib import Path
from typing import Any, NamedTuple

from ..records.build_spec import BuildSpec
from ..records.files import write_whole
from ..records.record import log_path
from . import dispatch

ADDRESS = "PSEUDORIGID_JOBS"  # the variable that holds the path of the server's socket
_PLAN = "plan"  # the Snakefile's request
# Read by numerical libraries when they are loaded: a job has one thread, or starts its own.
_LIBRARIES = ("OMP", "GOTO", "OPENBLAS", "MKL", "NUMEXPR")
THREADS = [*(f"{name}_NUM_THREADS" for name in _LIBRARIES), "VECLIB_MAXIMUM_THREADS"]


class Plan(NamedTuple):
    """The checked config, the build specification of each result, and the outdated results."""

    config: dict[str, Any]
    specs: dict[str, BuildSpec]
    outdated: set[str]


@cache
def plan() -> Plan:
    """Plan of this run, from the server if there is one; ConfigError if config.yaml is wrong."""
    if address := os.environ.get(ADDRESS):
        with socket.socket(socket.AF_UNIX) as server:
            server.connect(address)
            server.sendall(f"{_PLAN}\n".encode())
            with server.makefile("rb") as answer:
                return Plan(*pickle.load(answer))
    from ..checks.freshness import Freshness
    from ..config import build_specs, load
    from ..records.sources import ROOT

    config = load(ROOT / "config.yaml")
    specs = build_specs.of_all(config)
    return Plan(config, specs, set(Freshness(ROOT, specs).outdated()))


def run(context: ForkServerContext | SpawnContext, spec: BuildSpec) -> bool:
    """Make a result in a process of its own, and return whether it was made."""
    # The exit status is no answer: multiprocessing may lose it if other threads start jobs.
    receiver, answer = context.Pipe(duplex=False)
    job = context.Process(target=dispatch.make, args=(spec, answer))
    job.start()
    answer.close()
    made = False
    with receiver, suppress(EOFError):
        made = receiver.recv()
    job.join()
    log = Path(log_path(spec.result))
    if not made and not log.exists():
        status = job.exitcode or 0
        reason = signal.Signals(-status).name if status < 0 else "it ended without a message"
        with suppress(ValueError):  # the disk may be full
            write_whole(log, f"pseudorigid: {spec.scene}: the job was killed ({reason})\n")
    return made


class _Server(socketserver.ThreadingUnixStreamServer):
    daemon_threads = True
    request_queue_size = 64


@contextmanager
def job_server(
    plan: Plan, current: Callable[[str], bool] = lambda path: False
) -> Iterator[dict[str, str]]:
    """Serve the jobs of a run while the body runs.

    Yields the environment variables with which snakemake finds the server; none if no server could
    be started. `current` says, when a job begins, whether its result is current and stays.
    """

    class Handler(socketserver.StreamRequestHandler):
        def handle(self) -> None:
            with suppress(OSError):  # the client may have been killed
                request = self.rfile.readline().decode().rstrip("\n")
                if request == _PLAN:
                    self.wfile.write(pickle.dumps(tuple(plan)))
                else:
                    made = current(request) or run(jobs, plan.specs[request])
                    self.wfile.write(b"1" if made else b"0")

    jobs = multiprocessing.get_context("forkserver")
    with ExitStack() as stack:
        try:
            folder = stack.enter_context(tempfile.TemporaryDirectory())
            address = f"{folder}/jobs"
            server = stack.enter_context(_Server(address, Handler))
            _start_forkserver(plan)
        except OSError:
            yield {}  # the temporary folder is full, or its name is too long for a socket
            return
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield {ADDRESS: address}
        server.shutdown()


def _start_forkserver(plan: Plan) -> None:
    """Start the process that forks jobs; it imports what the outdated results need."""
    wanted = "data" if any(path.endswith(".nc") for path in plan.outdated) else ""
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
    sys.exit(not run(multiprocessing.get_context("spawn"), plan().specs[_result]))
