"""Logger plugin of snakemake: `snakemake --logger reproduce` shows the progress of a run."""

import logging
import os
import signal
import sys
import threading
import time
from contextlib import suppress
from functools import cache
from logging import LogRecord
from pathlib import Path
from statistics import mean

from snakemake_interface_logger_plugins.base import LogHandlerBase
from snakemake_interface_logger_plugins.common import LogEvent

from pipeline.cli.running import RUN
from pipeline.declaration import parts
from pipeline.jobs.forks import PROGRESS
from pipeline.jobs.heartbeat import Heartbeat, on_terminal
from pipeline.records import provenance
from pipeline.records.files import disk_is_full, memory_is_short
from pipeline.records.provenance import failure, read_record, record_path
from pipeline.records.sources import ROOT


class LogHandler(LogHandlerBase):
    """Shows in one line of a terminal how far the run is: steps, percent, time left, what runs.

    Elsewhere it prints `fig2  orbits  1.1 s  3 of 22` for a finished step.
    """

    writes_to_stream = has_filter = has_formatter = True
    writes_to_file = needs_rulegraph = False

    def __post_init__(self) -> None:
        self.results: dict[int, str] = {}  # job -> result
        self.started: dict[int, float] = {}  # job that has not ended -> time of the monotonic clock
        self.steps = 0
        self.finished: dict[str, float] = {}  # result that is made -> seconds
        self.last: int | None = None  # the job that ended last
        self.failed, self.errors = False, list[str]()
        self.expected = _expected()
        logging.raiseExceptions = False  # snakemake's own log may be on a full disk
        threading.Thread(target=_end_with_parent, daemon=True).start()
        kernel = os.environ.get("NUMBA_CACHE_DIR") or ROOT / "src/pseudorigid/kernel/__pycache__"
        self.compiling = not any(Path(kernel).glob("pseudorigid.*/*.nbc"))  # no machine code yet
        self.heartbeat = Heartbeat(self.describe)

    def emit(self, record: LogRecord) -> None:
        """Handle one of snakemake's events."""
        match getattr(record, "event", None):
            case LogEvent.RUN_INFO:
                self.steps = record.stats["total"]
            case LogEvent.JOB_INFO:
                # Snakemake appends a file's flags to its name, in parentheses.
                self.results[record.jobid] = str((record.output or [""])[0]).partition(" (")[0]
            case LogEvent.JOB_STARTED:
                self.started |= dict.fromkeys(record.jobs, time.monotonic())
            case LogEvent.JOB_FINISHED:
                self.last, started = record.job_id, self.started.pop(record.job_id)
                self.finished[self.results[record.job_id]] = time.monotonic() - started
            case LogEvent.PROGRESS if self.last is not None:
                result = self.results[self.last]
                if not (on_terminal() or _names(result)[1].startswith("block ")):
                    steps = f"{record.done} of {record.total}"
                    self._print(self.last, f"{self.finished[result]:.1f} s", steps)
            case LogEvent.JOB_ERROR:
                self.failed = True
                self.started.pop(record.jobid, None)
                self._print(record.jobid, f"not made: {self._reason(self.results[record.jobid])}")
            case LogEvent.ERROR:
                self.errors.append(record.getMessage())

    def close(self) -> None:
        """Print snakemake's own messages if it ended before any job failed."""
        self.heartbeat.close()
        if self.errors and not self.failed:
            text = "\n".join(self.errors)
            print(memory_is_short(text) or text, file=sys.stderr, flush=True)
            self.errors.clear()  # it is called twice
        super().close()

    def describe(self) -> str:
        """Say how many steps are done, which share of all seconds, how long the rest takes."""
        finished = self.finished.copy()
        expected = done = sum(map(self._seconds, finished))
        running = list[str]()
        for job, started in [*self.started.items()]:
            result, seconds = self.results[job], time.monotonic() - started
            known = filter(None, [PROGRESS.get(result), f"{seconds:.0f} s"])
            running.append(f"{' '.join(_names(result))} ({', '.join(known)})")
            done += min(seconds, self._seconds(result))
        if not running and not finished:
            return "snakemake looks for what there is to do"
        total = sum(self.expected.values()) or float(self.steps)
        words = f"{len(finished)} of {self.steps}, {done / total:.0%}"
        if not any(result.endswith(".nc") for result in finished) and self.compiling:
            words += ", compiling (once)"
        elif finished and done < total:
            slower = sum(finished.values()) / expected  # than in the earlier runs
            words += f", {_duration((total - done) * slower / max(len(running), 1))} left"
        return f"{words}: {', '.join(running)}"

    def _seconds(self, result: str) -> float:
        """Return the seconds that a result is expected to take; without any, all count the same."""
        return self.expected.get(result, 1.0)

    def _print(self, job: int, *words: str) -> None:
        """Print a line about a job."""
        line = "{:6}  {:12}".format(*_names(self.results[job]))
        for each in words:
            line += f"  {each:>7}"
        self.heartbeat.print(line)

    def _reason(self, result: str) -> str:
        """Return the last line of a failed job's log, or of snakemake's message."""
        words = "".join(self.errors[-1:]).splitlines()
        words = [line for line in words if line and not line.startswith("  File ")]
        full = disk_is_full(result)
        return full or failure(result) or (words[-1] if words else "no reason is known")


def _expected() -> dict[str, float]:
    """Map each result that this run makes to its seconds in an earlier run, or to a guess."""
    results = sys.argv[sys.argv.index("--") + 1 :] if RUN in os.environ else []
    seconds, earlier = dict[str, float](), dict[str, float]()
    for part in parts().values():
        seconds |= part.seconds
    for path in results:
        with suppress(ValueError, KeyError):  # not made yet, or refused
            earlier[path] = read_record(ROOT, record_path(path))["seconds"]
    typical, seconds = mean(earlier.values() or [1.0]), seconds | earlier
    return {path: seconds.get(path, typical) for path in results}


@cache
def _names(result: str) -> tuple[str, str]:
    """Return the scene and the step of a result, as its specification has them."""
    try:
        spec = provenance.read_spec(provenance.spec_path(result))
    except ValueError:  # all
        return "", "all of it"
    return spec.scene, spec.step


def _end_with_parent() -> None:
    """End snakemake when ./reproduce has ended, which closes the pipe on stdin."""
    if RUN in os.environ:
        os.read(sys.stdin.fileno(), 1)  # nothing is ever written
        os.kill(os.getpid(), signal.SIGKILL)


def _duration(seconds: float) -> str:
    """Return a time in hours and minutes, minutes and seconds, or seconds."""
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    if hours:
        return f"{hours} h {minutes} min"
    return f"{minutes} min {rest} s" if minutes else f"{rest} s"
