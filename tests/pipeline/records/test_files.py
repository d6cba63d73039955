"""Reading files, and the message about a full disk."""

import errno
import os
from collections import namedtuple

import pytest

from pipeline.records import files

Usage = namedtuple("Usage", "total used free")


def test_a_file_that_cannot_be_read_is_one_line(tmp_path):
    (tmp_path / "a folder").mkdir()
    words = "a folder is in its place: move it away"
    assert files.why_not_a_file(tmp_path / "a folder") == words
    assert files.file_hash(tmp_path / "a folder") is None
    with pytest.raises(files.FileError, match=f"/a folder: {words}$"):
        files.read_bytes(tmp_path / "a folder")
    (tmp_path / "loop").symlink_to("loop")
    with pytest.raises(files.FileError, match="/loop: cannot be read: Too many levels"):
        files.read_bytes(tmp_path / "loop")
    for missing in ("none", "a file/below"):
        (tmp_path / "a file").touch()
        assert (files.why_not_a_file(missing), files.file_hash(missing)) == (None, None)
    (tmp_path / "link").symlink_to("a file")
    assert files.read_text(tmp_path / "link") == ""


@pytest.mark.parametrize(
    ("number", "usage", "words"),
    [
        (errno.ENOSPC, Usage(10**9, 10**9, 0), "the disk is full, 0.0 MB are left"),
        (None, Usage(10**9, 10**9, 0), "the disk is full, 0.0 MB are left"),
        (errno.EACCES, Usage(0, 0, 0), "Permission denied"),
        (errno.ENOSPC, Usage(10**9, 0, 10**9), "No space left on device"),
    ],
)
def test_a_disk_is_full_only_if_it_is(tmp_path, monkeypatch, number, usage, words):
    monkeypatch.setattr(files.shutil, "disk_usage", lambda path: usage)
    error = OSError(number, os.strerror(number)) if number else RuntimeError("NetCDF: HDF error")
    refused = pytest.raises(files.FileError, match=f"cannot be written: {words}$")
    with refused, files.replacing(tmp_path / "new" / "x"):
        raise error


def test_a_reader_keeps_the_old_file(tmp_path):
    """A new file takes the name; bytes of the old one are never overwritten in place."""
    path = tmp_path / "file"
    path.write_bytes(b"old")
    with path.open("rb") as reader:
        files.write_whole(path, b"new!")
        assert (reader.read(), path.read_bytes()) == (b"old", b"new!")
