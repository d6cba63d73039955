"""Logger plugin of snakemake: `snakemake --logger reproduce` prints a line for each step."""

import os
import signal
import sys
import threading
from logging import LogRecord

from snakemake_interface_logger_plugins.base import LogHandlerBase
from snakemake_interface_logger_plugins.common import LogEvent

from pipeline.jobs.server import ADDRESS, plan
from pipeline.records.files import disk_is_full, identity
from pipeline.records.record import failure

from .cells import Cells

WIDTH = 6  # characters of a scene's name


class LogHandler(LogHandlerBase):
    """Print `fig2  orbits  1.1 s  3 of 22` for a finished step, or why a step failed."""

    writes_to_stream = has_filter = has_formatter = True
    writes_to_file = needs_rulegraph = False

    def __post_init__(self) -> None:
        self.results: dict[int, str] = {}  # job -> result
        self.started: dict[int, float] = {}  # job -> time
        self.before: dict[str, int | None] = {}  # result -> its identity before the job
        self.finished: tuple[int, float] | None = None  # the last job and its time
        self.failed = False
        self.errors: list[str] = []
        self.cells: Cells | None = None
        threading.Thread(target=_end_with_parent, daemon=True).start()

    def emit(self, record: LogRecord) -> None:
        """Handle one of snakemake's events."""
        match getattr(record, "event", None):
            case LogEvent.JOB_INFO:
                # Snakemake appends a file's flags to its name, in parentheses.
                result = str((record.output or [""])[0]).partition(" (")[0]
                self.results[record.jobid], self.before[result] = result, identity(result)
            case LogEvent.JOB_STARTED:
                self.started |= dict.fromkeys(record.jobs, record.created)
            case LogEvent.JOB_FINISHED:
                self.finished = record.job_id, record.created
            case LogEvent.PROGRESS if self.finished:
                job, now = self.finished
                result = self.results[job]
                words = f"{now - self.started[job]:.1f} s"
                if identity(result) and identity(result) == self.before[result]:
                    words = "as it was"
                self._print(job, words, f"{record.done} of {record.total}")
            case LogEvent.JOB_ERROR:
                self.failed = True
                self._print(record.jobid, f"not made: {self._reason(self.results[record.jobid])}")
            case LogEvent.ERROR:
                self.errors.append(record.getMessage())

    def close(self) -> None:
        """Print snakemake's own messages if it ended before any job failed."""
        if self.errors and not self.failed:
            print(*self.errors, sep="\n", file=sys.stderr, flush=True)
        super().close()

    def _print(self, job: int, *words: str) -> None:
        spec = plan().specs.get(self.results[job])
        scene, step = (spec.scene, spec.step) if spec else ("", "all of it")
        line: str | None = f"{scene:{WIDTH}}  {step:12}  " + "  ".join(f"{w:>7}" for w in words)
        if step.startswith("block") and len(words) > 1:  # blocks are many: cells are counted
            self.cells = self.cells or Cells(plan().specs, plan().outdated)
            line = self.cells.done(self.results[job])
        if line:
            print(line.rstrip(), file=sys.stderr, flush=True)

    def _reason(self, result: str) -> str:
        """Return the last line of a failed job's log, or of snakemake's message."""
        words = "".join(self.errors[-1:]).splitlines()
        words = [line for line in words if line and not line.startswith("  File ")]
        full = disk_is_full(result)
        return failure(result) or full or (words[-1] if words else "no reason is known")


def _end_with_parent() -> None:
    """End snakemake when ./reproduce has ended, which closes the pipe on stdin."""
    if ADDRESS in os.environ:
        os.read(sys.stdin.fileno(), 1)  # nothing is ever written
        os.kill(os.getpid(), signal.SIGKILL)
