"""What the scripts share: one line for a job that cannot be done, and records."""

import sys
import traceback
from contextlib import contextmanager, suppress
from pathlib import Path


def _uncaught(kind, error, trace):
    if not issubclass(kind, KeyboardInterrupt):
        sys.__excepthook__(kind, error, trace)


sys.excepthook = _uncaught  # Ctrl-C is no reason for a traceback


@contextmanager
def one_line_errors(snakemake):
    """Turn an error into one line on stderr and exit status 1; the job's log has its traceback."""
    log = snakemake.log[0]
    try:
        yield
    except Exception as error:
        message = " ".join(str(error).split())
        if not isinstance(error, ValueError):  # ValueErrors are written for the user
            message = f"{type(error).__name__}: {message} (traceback in {log})"
        message = f"pseudorigid: {_subject(snakemake.wildcards)}: {message}"
        with suppress(OSError):  # on a full disk the log needs the space of what goes anyway
            for output in snakemake.output:
                Path(output).unlink(missing_ok=True)
        with suppress(OSError), open(log, "w", encoding="utf-8") as file:  # or the disk is full
            file.write(f"{traceback.format_exc()}\n{message}\n")
        sys.exit(1)


def _subject(wildcards):
    """What the job is about: a scene of the paper, a variant's scene, or a variant."""
    parts = [wildcards.get("variant", "paper"), wildcards.get("scene")]
    return "/".join(part for part in parts if part not in ("paper", None))


def recorded(snakemake):
    """Write the record of what made the output, `config` being the block behind it."""
    from pipeline.records.record import recorded

    given = snakemake.params
    return recorded(snakemake.output[0], given.block, given.sources, set(snakemake.input))
