"""Make one result and its record, or say in one line why it cannot be made."""

import sys
import traceback
from collections.abc import Mapping
from contextlib import suppress
from importlib import import_module
from multiprocessing.connection import Connection
from pathlib import Path
from types import TracebackType
from typing import Any

from ..records.build_spec import BuildSpec
from ..records.files import memory_is_short, write_whole
from ..records.record import log_path, recorded, refusal_path


def _excepthook(
    kind: type[BaseException], error: BaseException, trace: TracebackType | None
) -> None:
    """Print no traceback for Ctrl-C."""
    if not issubclass(kind, KeyboardInterrupt):
        sys.__excepthook__(kind, error, trace)


def make(
    spec: BuildSpec,
    answer: "Connection[bool, bool]",
    known: Mapping[str, Any] | None = None,
    about: Mapping[str, Any] | None = None,
) -> None:
    """Make a result in this process, which ends afterwards; the current folder is the root.

    `answer` gets True once the result and its record are written. An error becomes the last line
    of the job's log, below its traceback. The program is given what is `known`, and the record says
    what `about` says.
    """
    sys.excepthook = _excepthook
    log = log_path(spec.result)
    for file in (log, refusal_path(spec.result)):
        Path(file).unlink(missing_ok=True)
    try:
        with recorded(spec) as output:
            program = import_module(f"pipeline.jobs.{spec.program}")
            output.update(program.make(spec, **(known or {})) or about or {})
    except Exception as error:
        message = " ".join(str(error).split())
        if words := memory_is_short(error):
            message = f"{words} (traceback in {log})"
        elif not isinstance(error, ValueError):  # whose messages are for users
            message = f"{type(error).__name__}: {message} (traceback in {log})"
        last_line = f"pseudorigid: {spec.scene}: {message}"
        with suppress(OSError, ValueError):  # the disk may be full
            write_whole(log, f"{traceback.format_exc()}\n{last_line}\n")
        sys.exit(1)
    with suppress(OSError):  # the run may have been killed
        answer.send(True)
