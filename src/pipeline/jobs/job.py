"""Make one result and its record, or say in one line why it cannot be made.

`python -m pipeline.jobs.job results/paper/specs/orbits_fig2.nc.json` makes what this file says.
"""

import signal
import sys
import traceback
from collections.abc import Mapping
from contextlib import suppress
from importlib import import_module
from pathlib import Path
from typing import Any

from ..records.files import FileError, memory_is_short, write_whole
from ..records.provenance import BuildSpec, log_path, read_spec, recorded


def make(
    spec: BuildSpec, known: Mapping[str, Any] | None = None, about: Mapping[str, Any] | None = None
) -> None:
    """Make a result and its record in this process; the current folder is the root.

    An error becomes the last line of the job's log, below its traceback, and the exit status 1. The
    program is given what is `known`, and the record says what `about` says.
    """
    log = log_path(spec.result)
    Path(log).unlink(missing_ok=True)
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
        sys.exit(last_line)


if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # no traceback for Ctrl-C
    try:
        specification = read_spec(sys.argv[1])
    except FileError as error:
        sys.exit(f"pseudorigid: {error}")
    make(specification)
