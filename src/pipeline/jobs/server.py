"""The server of jobs: it knows what a run makes, and forks a job in a few milliseconds.

A Python of its own takes longer to load its packages than most jobs take for their work. The server
has loaded them, and forks a process for each job. `workflow/scripts/make.py` asks it for a result,
and the Snakefile for the plan. A plain snakemake has no server: each job is then a Python.
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
from contextlib import ExitStack, contextmanager, suppress
from functools import cache
from multiprocessing import forkserver
from pathlib import Path
from typing import NamedTuple

from ..records.build_spec import BuildSpec
from ..records.files import write_whole
from ..records.record import log_path
from . import dispatch

ADDRESS = "PSEUDORIGID_JOBS"  # the variable that holds the server's socket
_PLAN = "plan"  # what the Snakefile asks for
# What numerical libraries read when they are loaded: a job has one thread, or makes its own.
THREADS = [f"{name}_NUM_THREADS" for name in ("OMP", "GOTO", "OPENBLAS", "MKL", "NUMEXPR")]
THREADS.append("VECLIB_MAXIMUM_THREADS")


class Plan(NamedTuple):
    """The checked config, the build specification of each result, and what is outdated."""

    config: dict
    specs: dict[str, BuildSpec]
    outdated: set[str]


@cache
def plan() -> Plan:
    """The plan of this run; ConfigError without a server, where config.yaml is wrong."""
    if address := os.environ.get(ADDRESS):
        with socket.socket(socket.AF_UNIX) as server:
            server.connect(address)
            server.sendall(f"{_PLAN}\n".encode())
            with server.makefile("rb") as answer:
                return pickle.load(answer)
    from ..checks.freshness import Freshness
    from ..config import build_specs, load
    from ..records.sources import ROOT

    config = load(ROOT / "config.yaml")
    specs = build_specs.of_all(config)
    return Plan(config, specs, set(Freshness(ROOT, specs).outdated()))


def run(context, spec) -> bool:
    """Make a result in a process of its own, from a context of multiprocessing; whether it did."""
    # Not by its exit status: where other threads start jobs, multiprocessing may lose that.
    done, answer = context.Pipe(duplex=False)
    job = context.Process(target=dispatch.make, args=(spec, answer))
    job.start()
    answer.close()
    made = False
    with done, suppress(EOFError):
        made = done.recv()
    job.join()
    log = Path(log_path(spec.result))
    if not made and not log.exists():
        status = job.exitcode or 0
        how = signal.Signals(-status).name if status < 0 else "it ended without a word"
        with suppress(ValueError):  # of a full disk
            write_whole(log, f"pseudorigid: {spec.scene}: the job was killed ({how})\n")
    return made


class _Server(socketserver.ThreadingUnixStreamServer):
    daemon_threads = True
    request_queue_size = 64


@contextmanager
def job_server(plan, current=lambda path: False):
    """Serve the jobs of a run while the body runs.

    Parameters
    ----------
    plan : Plan
    current : callable
        Whether a result is found to be current when its job begins, and stays as it is.

    Yields
    ------
    dict
        The variables that snakemake needs to find the server, none where there can be none.
    """

    class Handler(socketserver.StreamRequestHandler):
        def handle(self):
            with suppress(OSError):  # of a client that was killed
                asked = self.rfile.readline().decode().rstrip("\n")
                if asked == _PLAN:
                    self.wfile.write(pickle.dumps(plan))
                else:
                    made = current(asked) or run(jobs, plan.specs[asked])
                    self.wfile.write(b"1" if made else b"0")

    jobs = multiprocessing.get_context("forkserver")
    with ExitStack() as stack:
        try:
            folder = stack.enter_context(tempfile.TemporaryDirectory())
            server = stack.enter_context(_Server(f"{folder}/jobs", Handler))
            _start(computes=any(path.endswith(".nc") for path in plan.outdated))
        except OSError:
            yield {}  # the temporary folder is full, or its name is too long for a socket
            return
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield {ADDRESS: server.server_address}
        server.shutdown()


def _start(computes):
    """Start the process that forks jobs; it loads what they need while this one goes on.

    Where nothing is computed, only drawn, it does without what takes longest to load.
    """
    before = dict(os.environ)
    os.environ.update(dict.fromkeys(THREADS, "1"))
    # Inherited: Ctrl-C is for this process alone, which then ends the jobs.
    handler = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        modules = ["loaded_sources", *(["compiled"] if computes else [])]
        jobs = multiprocessing.get_context("forkserver")
        jobs.set_forkserver_preload([f"{__package__}.{name}" for name in modules])
        forkserver.ensure_running()
    finally:
        signal.signal(signal.SIGINT, handler)
        os.environ.clear()
        os.environ.update(before)


if __name__ == "__main__":
    (_result,) = sys.argv[1:]
    sys.exit(not run(multiprocessing.get_context("spawn"), plan().specs[_result]))
