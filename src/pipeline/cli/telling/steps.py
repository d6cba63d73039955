"""A line for each step of a run, from snakemake's own events."""

import os
import sys

from snakemake_interface_logger_plugins.base import LogHandlerBase
from snakemake_interface_logger_plugins.common import LogEvent
from snakemake_interface_logger_plugins.registry import LoggerPluginRegistry

from ...records.sources import ROOT
from .names import step

NAME = "steps"
_LOGS = "Complete log(s): "


class LogHandler(LogHandlerBase):
    """Prints `fig2  orbits  1.1 s  3 of 22` for a step done, and why one could not be."""

    writes_to_stream = has_filter = has_formatter = True
    writes_to_file = needs_rulegraph = False
    last = None  # the one of the last run

    def __post_init__(self):
        LogHandler.last = self
        self.results, self.started, self.finished = {}, {}, None
        self.failed, self.errors, self.log = False, [], None

    def emit(self, record):
        """Take one of snakemake's events."""
        match getattr(record, "event", None):
            case LogEvent.JOB_INFO:
                self.results[record.jobid] = str(record.output[0])
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
                self._tell(record.jobid, f"not made: {reason(self.results[record.jobid])}")
            case LogEvent.ERROR:
                self.errors.append(record.getMessage())
            case None if record.getMessage().startswith(_LOGS):
                self.log = os.path.relpath(record.getMessage().removeprefix(_LOGS), ROOT)

    def _tell(self, job, *words):
        scene, stage = step(self.results.get(job, "results/report/"))
        # What sweeps do is told by their cells; a block alone only where it fails.
        if not stage.startswith("block") or len(words) == 1:
            line = f"{scene:{WIDTH}}  {stage:12}  " + "  ".join(f"{word:>7}" for word in words)
            print(line.rstrip(), file=sys.stderr, flush=True)


WIDTH = 6


def reason(result) -> str:
    """Why a job could not be done: what it left as the last line of its log."""
    _, folder, *_, name = result.split("/")
    log = f"results/{folder}/logs/{name}.log"
    try:
        lines = (ROOT / log).read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        lines = []
    said = [line for line in lines if line.startswith("pseudorigid: ")]
    return said[-1].split(": ", 2)[2] if said else "it ended without a word (was it killed?)"


def register() -> str:
    """Make snakemake know the handler; its name there."""
    LoggerPluginRegistry().register_plugin(f"snakemake_logger_plugin_{NAME}", sys.modules[__name__])
    return NAME
