"""A line for each step of a run, from snakemake's own events."""

import os
import sys
from contextlib import suppress

from snakemake_interface_logger_plugins.base import LogHandlerBase
from snakemake_interface_logger_plugins.common import LogEvent
from snakemake_interface_logger_plugins.registry import LoggerPluginRegistry

from ...records.files import disk_is_full
from ...records.sources import ROOT
from .names import step

NAME = "steps"
WIDTH = 6  # of a scene's name
_LOGS = "Complete log(s): "


class LogHandler(LogHandlerBase):
    """Prints `fig2  orbits  1.1 s  3 of 22` for a step done, and why one could not be."""

    writes_to_stream = has_filter = has_formatter = True
    writes_to_file = needs_rulegraph = False
    last = None  # the one of the last run
    interrupted = ()  # by which signals

    def __post_init__(self):
        LogHandler.last = self
        self.results, self.started, self.finished = {}, {}, None
        self.failed, self.errors, self.log = False, [], None
        self.reasons = {}  # result -> why it could not be made

    def emit(self, record):
        """Take one of snakemake's events."""
        match getattr(record, "event", None):
            case LogEvent.JOB_INFO:
                self.results[record.jobid] = str((record.output or [""])[0])
            case LogEvent.JOB_STARTED:
                self.started |= dict.fromkeys(record.jobs, record.created)
            case LogEvent.JOB_FINISHED:
                self.finished = record.job_id, record.created
            case LogEvent.PROGRESS if self.finished:
                job, now = self.finished
                self._tell(
                    job, f"{now - self.started[job]:.1f} s", f"{record.done} of {record.total}"
                )
            case LogEvent.JOB_ERROR:
                self.failed = True
                if not self.interrupted:
                    reason = self._reason(record.jobid)
                    self.reasons[self.results[record.jobid]] = reason
                    self._tell(record.jobid, f"not made: {reason}")
            case LogEvent.ERROR:
                self.errors.append(record.getMessage())
            case None if record.getMessage().startswith(_LOGS):
                self.log = os.path.relpath(record.getMessage().removeprefix(_LOGS), ROOT)

    def _tell(self, job, *words):
        scene, stage = step(self.results[job]) if self.results[job] else ("", "all of it")
        # What sweeps do is told by their cells; a block alone only where it fails.
        if not stage.startswith("block") or len(words) == 1:
            line = f"{scene:{WIDTH}}  {stage:12}  " + "  ".join(f"{word:>7}" for word in words)
            print(line.rstrip(), file=sys.stderr, flush=True)

    def _reason(self, job):
        """Why a job could not be done: the last line of its log, or what snakemake says of it."""
        _, folder, *_, name = self.results[job].split("/")
        log = ROOT / "results" / folder / "logs" / f"{name}.log"
        lines = []
        with suppress(OSError):
            if log.stat().st_mtime > self.started[job] - 2:  # some file systems keep whole seconds
                lines = log.read_text(encoding="utf-8", errors="replace").splitlines()
        said = [line.split(": ", 2)[2] for line in lines if line.startswith("pseudorigid: ")]
        if said:
            return said[-1]
        words = "".join(self.errors[-1:]).splitlines()
        words = [line for line in words if line and not line.startswith("  File ")]
        full = disk_is_full(ROOT / self.results[job])
        return full or (words[-1] if words else "no reason is known")


def register() -> str:
    """Make snakemake know the handler; its name there."""
    LoggerPluginRegistry().register_plugin(f"snakemake_logger_plugin_{NAME}", sys.modules[__name__])
    return NAME
