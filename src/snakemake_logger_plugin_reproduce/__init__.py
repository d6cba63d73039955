"""Logger plugin of snakemake: `snakemake --logger reproduce` prints a line for each step."""

import logging
import os
import signal
import sys
import threading
import time
from logging import LogRecord
from pathlib import Path

import psutil
from snakemake_interface_logger_plugins.base import LogHandlerBase
from snakemake_interface_logger_plugins.common import LogEvent

from pipeline.cli.session import RUN
from pipeline.jobs.heartbeat import Heartbeat
from pipeline.jobs.plan import plan
from pipeline.records.build_spec import BuildSpec
from pipeline.records.files import disk_is_full, inode, memory_is_short
from pipeline.records.record import failure
from pipeline.records.sources import ROOT

WIDTH = 6  # characters of a scene's name
PAUSE = 1.0  # least number of seconds between two lines about blocks


class LogHandler(LogHandlerBase):
    """Prints `fig2  orbits  1.1 s  3 of 22` for a finished step, or why a step failed."""

    writes_to_stream = has_filter = has_formatter = True
    writes_to_file = needs_rulegraph = False

    def __post_init__(self) -> None:
        self.results: dict[int, str] = {}  # job -> result
        self.started: dict[int, float] = {}  # job -> time
        self.running: dict[int, float] = {}  # job that has not ended -> time of the monotonic clock
        self.before: dict[str, int | None] = {}  # result -> its inode before the job
        self.finished: tuple[int, float] | None = None  # the last job and its time
        self.failed = False
        self.errors: list[str] = []
        self.blocks: Blocks | None = None
        self.steps = "0 steps"  # how many are done
        logging.raiseExceptions = False  # snakemake's own log may be on a full disk
        threading.Thread(target=_end_with_parent, daemon=True).start()
        self.compiling = _compiling()
        parent = psutil.Process(os.getppid() if RUN in os.environ else None)
        self.heartbeat = Heartbeat(self._running, waited=time.time() - parent.create_time())

    def emit(self, record: LogRecord) -> None:
        """Handle one of snakemake's events."""
        match getattr(record, "event", None):
            case LogEvent.JOB_INFO:
                # Snakemake appends a file's flags to its name, in parentheses.
                result = str((record.output or [""])[0]).partition(" (")[0]
                self.results[record.jobid], self.before[result] = result, inode(result)
            case LogEvent.JOB_STARTED:
                self.started |= dict.fromkeys(record.jobs, record.created)
                self.running |= dict.fromkeys(record.jobs, time.monotonic())
            case LogEvent.JOB_FINISHED:
                self.finished = record.job_id, record.created
                self.running.pop(record.job_id, None)
            case LogEvent.PROGRESS if self.finished:
                job, now = self.finished
                result = self.results[job]
                words = f"{now - self.started[job]:.1f} s"
                if inode(result) and inode(result) == self.before[result]:
                    words = "as it was"
                self.steps = f"{record.done} of {record.total}"
                self._print(job, words, self.steps)
            case LogEvent.JOB_ERROR:
                self.failed = True
                self.running.pop(record.jobid, None)
                self._print(record.jobid, f"not made: {self._reason(self.results[record.jobid])}")
            case LogEvent.ERROR:
                self.errors.append(record.getMessage())

    def close(self) -> None:
        """Print snakemake's own messages if it ended before any job failed."""
        if self.errors and not self.failed:
            text = "\n".join(self.errors)
            print(memory_is_short(text) or text, file=sys.stderr, flush=True)
            self.errors.clear()  # it is called twice
        super().close()

    def _running(self) -> str:
        """Describe the jobs that run, as the heartbeat prints them."""
        now, jobs = time.monotonic(), []
        for job, started in [*self.running.items()]:
            spec = plan().freshness.build_specs.get(self.results[job])
            if spec:
                jobs.append(f"{spec.scene} {spec.step} ({now - started:.0f} s)")
        if not jobs:
            return "" if self.finished else "snakemake looks for what there is to do"
        compiling = "" if self.finished else self.compiling
        return f"{compiling}running: {', '.join(jobs)}; {self.steps} done"

    def _print(self, job: int, *words: str) -> None:
        """Print a line about a job; blocks of a dataset are many, and are counted instead."""
        spec = plan().freshness.build_specs.get(self.results[job])
        scene, step = (spec.scene, spec.step) if spec else ("", "all of it")
        line: str | None = f"{scene:{WIDTH}}  {step:12}  " + "  ".join(f"{w:>7}" for w in words)
        if spec and _is_block(spec) and len(words) > 1:
            self.blocks = self.blocks or Blocks(plan().freshness.build_specs, plan().outdated)
            line = self.blocks.done(self.results[job])
        if line:
            self.heartbeat.print(line.rstrip())

    def _reason(self, result: str) -> str:
        """Return the last line of a failed job's log, or of snakemake's message."""
        words = "".join(self.errors[-1:]).splitlines()
        words = [line for line in words if line and not line.startswith("  File ")]
        full = disk_is_full(result)
        return full or failure(result) or (words[-1] if words else "no reason is known")


def _compiling() -> str:
    """Return words about the compilation of the kernel if no machine code is stored yet."""
    folder = os.environ.get("NUMBA_CACHE_DIR") or ROOT / "src/pseudorigid/kernel/__pycache__"
    return "" if any(Path(folder).glob("pseudorigid.*/*.nbc")) else "compiling, once; "


def _end_with_parent() -> None:
    """End snakemake when ./reproduce has ended, which closes the pipe on stdin."""
    if RUN in os.environ:
        os.read(sys.stdin.fileno(), 1)  # nothing is ever written
        os.kill(os.getpid(), signal.SIGKILL)


class Blocks:
    """Counts the finished blocks of datasets, and estimates the time left.

    Each block is computed by a job of its own. `specs` maps results to build specifications, and
    `outdated` has the results of the run.
    """

    def __init__(self, specs: dict[str, BuildSpec], outdated: set[str]) -> None:
        scenes = {path: spec.scene for path, spec in specs.items() if _is_block(spec)}
        self.left = scenes.keys() & outdated
        self.names = sorted({scenes[path] for path in self.left})
        self.total = sum(scene in self.names for scene in scenes.values())
        self.first: tuple[float, int] | None = None  # time, and blocks that were left then
        self.printed = -PAUSE

    def done(self, path: str) -> str | None:
        """Count a finished block, and return a line if it is time for one.

        Speed is measured from the first block on: before it, jobs may compile the map.
        """
        self.left.discard(path)
        now, left = time.monotonic(), len(self.left)
        since, self.first = self.first, self.first or (now, left)
        if left and now < self.printed + PAUSE:
            return None
        self.printed = now
        text = f"{', '.join(self.names)}: {self.total - left:,} of {self.total:,} blocks"
        if since is None or not left:
            return text
        seconds = left * (now - since[0]) / max(since[1] - left, 1)
        return f"{text}, {_duration(round(seconds))} to go"


def _is_block(spec: BuildSpec) -> bool:
    """Return whether a result is a block of a dataset."""
    return spec.step.startswith("block ")


def _duration(seconds: int) -> str:
    """Return a time in minutes and seconds, or in hours and minutes."""
    minutes, rest = divmod(seconds, 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours} h {minutes} min" if hours else f"{minutes} min {rest} s"
