"""A logger plugin of snakemake: `snakemake --logger reproduce` prints a line for each step."""

import os
import signal
import sys
import threading

from snakemake_interface_logger_plugins.base import LogHandlerBase
from snakemake_interface_logger_plugins.common import LogEvent

from pipeline.jobs.server import ADDRESS, plan
from pipeline.records.files import disk_is_full, identity
from pipeline.records.record import failure

from .cells import Cells

WIDTH = 6  # of a scene's name


class LogHandler(LogHandlerBase):
    """Prints `fig2  orbits  1.1 s  3 of 22` for a step done, and why one could not be."""

    writes_to_stream = has_filter = has_formatter = True
    writes_to_file = needs_rulegraph = False

    def __post_init__(self):
        self.results, self.started, self.before, self.finished = {}, {}, {}, None
        self.failed, self.errors, self.cells = False, [], None
        threading.Thread(target=_end_with_parent, daemon=True).start()

    def emit(self, record):
        """Take one of snakemake's events."""
        match getattr(record, "event", None):
            case LogEvent.JOB_INFO:
                # Snakemake writes what is special about a file behind its name, in parentheses.
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
                self._tell(job, words, f"{record.done} of {record.total}")
            case LogEvent.JOB_ERROR:
                self.failed = True
                self._tell(record.jobid, f"not made: {self._reason(self.results[record.jobid])}")
            case LogEvent.ERROR:
                self.errors.append(record.getMessage())

    def close(self):
        """Print snakemake's own words where it ended before any job could fail."""
        if self.errors and not self.failed:
            print(*self.errors, sep="\n", file=sys.stderr, flush=True)
        super().close()

    def _tell(self, job, *words):
        spec = plan().specs.get(self.results[job])
        scene, step = (spec.scene, spec.step) if spec else ("", "all of it")
        line = f"{scene:{WIDTH}}  {step:12}  " + "  ".join(f"{word:>7}" for word in words)
        if step.startswith("block") and len(words) > 1:  # there are many: their cells are counted
            self.cells = self.cells or Cells(plan().specs, plan().outdated)
            line = self.cells.done(self.results[job])
        if line:
            print(line.rstrip(), file=sys.stderr, flush=True)

    def _reason(self, result):
        """Why a job could not be done: what its log ends with, or what snakemake says of it."""
        words = "".join(self.errors[-1:]).splitlines()
        words = [line for line in words if line and not line.startswith("  File ")]
        full = disk_is_full(result)
        return failure(result) or full or (words[-1] if words else "no reason is known")


def _end_with_parent():
    """End snakemake when ./reproduce has ended, whose end of the pipe on stdin then closes."""
    if ADDRESS in os.environ:
        os.read(sys.stdin.fileno(), 1)  # nothing is ever written
        os.kill(os.getpid(), signal.SIGKILL)
