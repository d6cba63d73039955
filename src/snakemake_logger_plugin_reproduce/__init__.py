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

from pipeline.cli.running import RUN
from pipeline.jobs.heartbeat import Heartbeat
from pipeline.records.files import disk_is_full, memory_is_short
from pipeline.records.provenance import failure, read_spec, spec_path
from pipeline.records.sources import ROOT

WIDTH = 6  # characters of a scene's name
PAUSE = 1.0  # least number of seconds between two lines about blocks


class LogHandler(LogHandlerBase):
    """Prints `fig2  orbits  1.1 s  3 of 22` for a finished step, or why a step failed."""

    writes_to_stream = has_filter = has_formatter = True
    writes_to_file = needs_rulegraph = False

    def __post_init__(self) -> None:
        self.results: dict[int, str] = {}  # job -> result
        self.names: dict[int, tuple[str, str]] = {}  # job -> its scene and its step
        self.started: dict[int, float] = {}  # job -> time
        self.running: dict[int, float] = {}  # job that has not ended -> time of the monotonic clock
        self.finished: tuple[int, float] | None = None  # the last job and its time
        self.failed = False
        self.errors: list[str] = []
        self.blocks = 0  # of datasets: how many this run makes, how many are done, and
        self.blocks_done = 0
        self.first_block = self.printed = 0.0  # times of the first one and of the last line
        self.steps = "0 steps"  # how many are done
        logging.raiseExceptions = False  # snakemake's own log may be on a full disk
        threading.Thread(target=_end_with_parent, daemon=True).start()
        self.compiling = _compiling()
        parent = psutil.Process(os.getppid() if RUN in os.environ else None)
        self.heartbeat = Heartbeat(self._running, waited=time.time() - parent.create_time())

    def emit(self, record: LogRecord) -> None:
        """Handle one of snakemake's events."""
        match getattr(record, "event", None):
            case LogEvent.RUN_INFO:
                jobs = record.stats.items()
                self.blocks = sum(n for rule, n in jobs if rule.endswith("_block"))
            case LogEvent.JOB_INFO:
                # Snakemake appends a file's flags to its name, in parentheses.
                result = str((record.output or [""])[0]).partition(" (")[0]
                self.results[record.jobid], self.names[record.jobid] = result, _names(result)
            case LogEvent.JOB_STARTED:
                self.started |= dict.fromkeys(record.jobs, record.created)
                self.running |= dict.fromkeys(record.jobs, time.monotonic())
            case LogEvent.JOB_FINISHED:
                self.finished = record.job_id, record.created
                self.running.pop(record.job_id, None)
            case LogEvent.PROGRESS if self.finished:
                job, now = self.finished
                self.steps = f"{record.done} of {record.total}"
                if self.names[job][1].startswith("block "):
                    self._print_block(job)
                else:
                    self._print(job, f"{now - self.started[job]:.1f} s", self.steps)
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
            jobs.append(f"{' '.join(self.names[job])} ({now - started:.0f} s)")
        if not jobs:
            return "" if self.finished else "snakemake looks for what there is to do"
        compiling = "" if self.finished else self.compiling
        return f"{compiling}running: {', '.join(jobs)}; {self.steps} done"

    def _print(self, job: int, *words: str) -> None:
        """Print a line about a job."""
        scene, step = self.names[job]
        line = f"{scene:{WIDTH}}  {step:12}  " + "  ".join(f"{each:>7}" for each in words)
        self.heartbeat.print(line.rstrip())

    def _print_block(self, job: int) -> None:
        """Count a block of a dataset, and print a line if it is time for one, with the time left.

        Speed is measured from the first block on: before it, jobs may compile the map.
        """
        self.blocks_done += 1
        now, left = time.monotonic(), self.blocks - self.blocks_done
        if left and now < self.printed + PAUSE:
            return
        words, self.printed = f"{self.blocks_done:,} of {self.blocks:,} blocks", now
        if self.blocks_done == 1:
            self.first_block = now
        elif left:
            seconds = left * (now - self.first_block) / (self.blocks_done - 1)
            words += f", {_duration(round(seconds))} to go"
        self.heartbeat.print(f"{self.names[job][0]}: {words}")

    def _reason(self, result: str) -> str:
        """Return the last line of a failed job's log, or of snakemake's message."""
        words = "".join(self.errors[-1:]).splitlines()
        words = [line for line in words if line and not line.startswith("  File ")]
        full = disk_is_full(result)
        return full or failure(result) or (words[-1] if words else "no reason is known")


def _names(result: str) -> tuple[str, str]:
    """Return the scene and the step of a result, as its specification has them."""
    try:
        spec = read_spec(spec_path(result))
    except ValueError:  # all
        return "", "all of it"
    return spec.scene, spec.step


def _compiling() -> str:
    """Return words about the compilation of the kernel if no machine code is stored yet."""
    folder = os.environ.get("NUMBA_CACHE_DIR") or ROOT / "src/pseudorigid/kernel/__pycache__"
    return "" if any(Path(folder).glob("pseudorigid.*/*.nbc")) else "compiling, once; "


def _end_with_parent() -> None:
    """End snakemake when ./reproduce has ended, which closes the pipe on stdin."""
    if RUN in os.environ:
        os.read(sys.stdin.fileno(), 1)  # nothing is ever written
        os.kill(os.getpid(), signal.SIGKILL)


def _duration(seconds: int) -> str:
    """Return a time in minutes and seconds, or in hours and minutes."""
    minutes, rest = divmod(seconds, 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours} h {minutes} min" if hours else f"{minutes} min {rest} s"
