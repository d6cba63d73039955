"""Make one result, with its record, or say in one line why it cannot be made."""

import sys
import traceback
from contextlib import suppress
from importlib import import_module
from pathlib import Path

from ..records.files import write_whole
from ..records.record import log_path, recorded, refusal_path


def _uncaught(kind, error, trace):
    if not issubclass(kind, KeyboardInterrupt):
        sys.__excepthook__(kind, error, trace)


def make(spec, answer):
    """Make a result in this process, which ends afterwards.

    An error becomes one line on stderr and the last one of the job's log, below its traceback.

    Parameters
    ----------
    spec : BuildSpec
        The current folder is the root.
    answer : multiprocessing connection
        Gets True once the result and its record are there.
    """
    sys.excepthook = _uncaught  # Ctrl-C is no reason for a traceback
    log = log_path(spec.result)
    for file in (log, refusal_path(spec.result)):
        Path(file).unlink(missing_ok=True)
    try:
        with recorded(spec):
            import_module(f"pipeline.jobs.{spec.program}").make(spec)
    except Exception as error:
        message = " ".join(str(error).split())
        if not isinstance(error, ValueError):  # ValueErrors are written for the user
            message = f"{type(error).__name__}: {message} (traceback in {log})"
        said = f"pseudorigid: {spec.scene}: {message}"
        with suppress(OSError, ValueError):  # the disk may be full
            write_whole(log, f"{traceback.format_exc()}\n{said}\n")
        sys.exit(1)
    with suppress(OSError):  # of a run that was killed
        answer.send(True)
