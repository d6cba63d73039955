"""Reading and writing files: only regular files are read, and files are written whole."""

import errno
import hashlib
import os
import shutil
import stat
from contextlib import contextmanager, suppress
from pathlib import Path

_FULL = 1.0  # MB; a disk with less space left counts as full
_KINDS = {
    stat.S_IFDIR: "a folder",
    stat.S_IFIFO: "a FIFO",
    stat.S_IFSOCK: "a socket",
    stat.S_IFBLK: "a device",
    stat.S_IFCHR: "a device",
}


class FileError(ValueError):
    """One line about a file that cannot be read or written; it names the file."""


def obstacle(path):
    """What stands in the place of a file, in words.

    Parameters
    ----------
    path : path

    Returns
    -------
    str or None
        None where there is a regular file or nothing at all.
    """
    try:
        kind = stat.S_IFMT(os.stat(path).st_mode)
    except (FileNotFoundError, NotADirectoryError):
        return None
    except OSError as error:
        return f"cannot be read: {error.strerror}"
    if kind == stat.S_IFREG:
        return None
    return f"{_KINDS.get(kind, 'no file')} stands in its place, move it away"


def open_regular(path):
    """Open a regular file to read its bytes.

    Reading a FIFO would wait for ever, and a device may have no end: neither is opened.

    Parameters
    ----------
    path : path

    Returns
    -------
    binary file

    Raises
    ------
    FileNotFoundError, NotADirectoryError
        Where there is no file.
    FileError
        What is no regular file or cannot be read.
    """
    if words := obstacle(path):
        raise FileError(f"{path}: {words}")
    try:
        return open(path, "rb")
    except (FileNotFoundError, NotADirectoryError):
        raise
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise FileError(f"{path}: cannot be read: {reason}") from None


def read_bytes(path):
    """Content of a regular file; raises as `open_regular` does."""
    with open_regular(path) as file:
        return file.read()


def read_text(path):
    """Content of a regular file of UTF-8; raises also UnicodeDecodeError."""
    return read_bytes(path).decode("utf-8")


def disk_is_full(path):
    """Whether the disk of `path` is full, in words that say what is left, or None."""
    path = Path(path).absolute()
    there = next(folder for folder in (path, *path.parents) if folder.is_dir())
    usage = shutil.disk_usage(there)
    free = usage.free / 1e6
    # Some file systems, /proc among them, have no size.
    return f"the disk is full, {free:.1f} MB are left" if usage.total and free < _FULL else None


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
        # Where the disk is full, the netCDF library speaks of permissions, or gives no number.
        if getattr(error, "errno", None) in (None, errno.EACCES, errno.ENOSPC):
            reason = disk_is_full(path) or reason
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
        sha256 in hex, None where there is no regular file.

    Raises
    ------
    FileError
        A regular file that cannot be read.
    """
    if obstacle(path):
        return None
    try:
        with open_regular(path) as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except (FileNotFoundError, NotADirectoryError):
        return None
    except OSError as error:
        raise FileError(f"{path}: cannot be read: {error.strerror}") from None


def identity(path):
    """What changes whenever a file is written anew, and not when it is only touched.

    Parameters
    ----------
    path : path

    Returns
    -------
    int or None
        None where there is no file.
    """
    try:
        return Path(path).stat().st_ino
    except OSError:
        return None
