"""Read files with errors of one line, and write each file whole or not at all."""

import errno
import hashlib
import os
import re
import resource
import shutil
import traceback
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

_Path = str | os.PathLike[str]
ABSENT = (FileNotFoundError, NotADirectoryError)  # errors of a path without a file
_FULL_MB = 1.0  # a disk with less free space counts as full
# What Python and the system's loader say where memory is short.
_LEAST_MEMORY = 600e6  # bytes of addresses that a run takes on two cores; fewer end in tracebacks
_NO_MEMORY = "MemoryError|Cannot allocate memory|failed to map segment"


class FileError(ValueError):
    """A file that cannot be read or written, or that changed: one line that names it."""


def why_not_a_file(path: _Path) -> str | None:
    """Return words if a folder has the name of a file, else None."""
    return "a folder is in its place: move it away" if os.path.isdir(path) else None


def read_bytes(path: _Path) -> bytes:
    """Return the content of a file.

    Raises FileNotFoundError or NotADirectoryError without a file, else FileError.
    """
    try:
        return Path(path).read_bytes()
    except ABSENT:
        raise
    except OSError as error:
        words = why_not_a_file(path) or f"cannot be read: {error.strerror or error}"
        raise FileError(f"{path}: {words}") from None


def read_text(path: _Path) -> str:
    """Return the text of a UTF-8 file; also raises UnicodeDecodeError."""
    return read_bytes(path).decode("utf-8")


def read_yaml(path: Path) -> str:
    """Return the text of a YAML file; ValueError if it is none, as far as its text shows that."""
    try:
        text = read_text(path)
    except OSError as error:
        raise ValueError(f"cannot be read: {error.strerror}") from None
    except UnicodeDecodeError as error:
        raise ValueError(f"is not UTF-8 text: byte {error.start}") from None
    except FileError as error:
        raise ValueError(str(error).removeprefix(f"{path}: ")) from None
    if tab := re.search(r"^ *\t", text, re.MULTILINE):
        line = text.count("\n", 0, tab.start()) + 1
        raise ValueError(f"line {line}: begins with a tab: indent it with spaces")
    if not re.search(r"^\s*[^#\s]", text, re.MULTILINE):
        raise ValueError("is empty")
    return text


def disk_is_full(path: _Path) -> str | None:
    """Say how little space is left if the disk of `path` is full, else return None."""
    path = Path(path).absolute()
    while not path.is_dir():
        path = path.parent
    usage = shutil.disk_usage(path)
    free = usage.free / 1e6
    # Some file systems, /proc among them, have no size.
    return f"the disk is full, {free:.1f} MB are left" if usage.total and free < _FULL_MB else None


def memory_is_short(error: BaseException | str = "") -> str | None:
    """Say that memory is short if an error, its cause or a text says so, else None.

    Without one, say so if the limit of this process is less than a run takes.
    """
    limit = resource.getrlimit(resource.RLIMIT_AS)[0]
    limited = limit != resource.RLIM_INFINITY
    text = error if isinstance(error, str) else "".join(traceback.format_exception(error))
    # A new thread needs memory; without a limit of memory, too many processes run.
    signs = _NO_MEMORY + "|can't start new thread" * limited
    if re.search(signs, text) or (limited and not text and limit < _LEAST_MEMORY):
        return "memory is short" + f": the limit is {limit / 1e6:,.0f} MB (ulimit -v)" * limited
    return None


@contextmanager
def replacing(path: _Path) -> Iterator[Path]:
    """Yield a temporary path that replaces `path` if the body succeeds, and is removed otherwise.

    A reader sees the old file or the new one, never a part. A killed process can leave the
    temporary file, whose name begins with a dot and ends in .part. Raises FileError if the system
    or the netCDF library cannot write.
    """
    path = Path(path)
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        yield part
        os.replace(part, path)
    except (OSError, RuntimeError) as error:  # netCDF4 raises RuntimeError
        reason = " ".join(str(getattr(error, "strerror", None) or error).split())
        # On a full disk, the netCDF library reports a lack of permission, or no error number.
        if getattr(error, "errno", None) in (None, errno.EACCES, errno.ENOSPC):
            reason = disk_is_full(path) or reason
        raise FileError(f"{path}: cannot be written: {reason}") from error
    finally:
        with suppress(OSError):
            part.unlink()


def write_whole(path: _Path, data: str | bytes) -> None:
    """Write a file, whole or not at all; raises FileError if it cannot be written."""
    with replacing(path) as part:
        part.write_bytes(data.encode() if isinstance(data, str) else data)


def file_hash(path: _Path) -> str | None:
    """Return the SHA-256 of a file in hex, or None without one; raises FileError."""
    if os.path.isdir(path):
        return None
    with suppress(*ABSENT):
        return hashlib.sha256(read_bytes(path)).hexdigest()
    return None
