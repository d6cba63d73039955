"""What the scripts of workflow/scripts share: one line for a job that fails, and records."""

import sys
import traceback
from contextlib import contextmanager, suppress
from pathlib import Path

import pseudorigid

from . import record


def _uncaught(kind, error, trace):
    if not issubclass(kind, KeyboardInterrupt):
        sys.__excepthook__(kind, error, trace)


_PREAMBLE_ENDS = "######## snakemake preamble end #########\n"
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
    """Write the record of what made the output, once the body has made it."""
    given, main = snakemake.params, sys.modules["__main__"]
    # Snakemake runs a copy of the script, which it made when the job began.
    copy = Path(main.__real_file__).read_text(encoding="utf-8").partition(_PREAMBLE_ENDS)[2]
    same = Path(main.__file__).read_text(encoding="utf-8") == copy
    text = Path(main.__file__).read_bytes() if same else copy.encode()
    pseudorigid.note_loaded(main.__file__, text)
    for path, digest in given.workflow.items():
        pseudorigid.LOADED.setdefault(str(record.ROOT / path), set()).add(digest)
    return record.recorded(snakemake.output[0], given.block, given.sources, set(snakemake.input))
