"""Files appear whole or not at all; and their hashes."""

import errno
import hashlib
import os
import shutil
from contextlib import contextmanager, suppress
from pathlib import Path


class FileError(ValueError):
    """One line about a file that cannot be written; it names the file."""


@contextmanager
def replacing(path):
    """Yield a temporary path beside `path`; on success it replaces `path`, on error it goes.

    A reader sees the old file or the new one, never a part, also when the process is killed
    (which can leave the temporary file, whose name begins with a dot).

    Parameters
    ----------
    path : path

    Yields
    ------
    pathlib.Path

    Raises
    ------
    FileError
        Where the system or the netCDF library cannot write, with the space that is left.
    """
    path = Path(path)
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        yield part
        os.replace(part, path)
    except (OSError, RuntimeError) as error:  # the second is what netCDF4 raises
        reason = " ".join(str(getattr(error, "strerror", None) or error).split())
        there = next(folder for folder in path.absolute().parents if folder.is_dir())
        free = shutil.disk_usage(there).free / 1e6
        if free < 1.0 or getattr(error, "errno", None) == errno.ENOSPC:
            reason = f"the disk is full, {free:.1f} MB are left"
        raise FileError(f"{path}: cannot be written: {reason}") from error
    finally:
        with suppress(OSError):
            part.unlink()


def write_whole(path, data):
    """Write a file, whole or not at all.

    Parameters
    ----------
    path : path
    data : str or bytes

    Raises
    ------
    FileError
        Where it cannot be written.
    """
    with replacing(path) as part:
        part.write_bytes(data.encode() if isinstance(data, str) else data)


def file_hash(path):
    """Hash of a file's bytes.

    Parameters
    ----------
    path : path

    Returns
    -------
    str or None
        sha256 in hex, None where there is no such file.
    """
    try:
        with open(path, "rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except (FileNotFoundError, IsADirectoryError, NotADirectoryError):
        return None


def identity(path):
    """What changes whenever a file is written anew.

    Parameters
    ----------
    path : path

    Returns
    -------
    (int, int) or None
        None where there is no file.
    """
    try:
        status = Path(path).stat()
    except OSError:
        return None
    return status.st_ino, status.st_mtime_ns
