"""Intrinsic identifiers (SWHIDs, ISO/IEC 18670) of folders.

A folder's identifier is the hash of a git tree with its files, so that anybody who has the files
can compute it, for example with `swh identify` of the package swh.model. `./reproduce --version`
imports this module before anything is installed, so it needs only Python 3.6.
"""

import hashlib
import subprocess
import tarfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

EXECUTABLE = 0o755  # mode of a file; any other means a file that is not executable
_PREFIX = "swh:1:dir:"


def of_files(files: "Mapping[str, tuple[bytes, int]]") -> "str":
    """Return the identifier of a folder that has these files: path -> bytes and mode."""
    tree = {}  # type: dict[str, Any]
    for path, file in files.items():
        *folders, name = path.split("/")
        inner = tree
        for folder in folders:
            inner = inner.setdefault(folder, {})
        inner[name] = file
    return _PREFIX + _of_tree(tree).hex()


def of_commit(root: "Path") -> "str | None":
    """Return the identifier of the tree that is checked out at `root`, or None without git.

    Changes that are not committed are not in it.
    """
    command = ["git", "-C", str(root), "rev-parse", "--show-prefix", "--verify", "HEAD^{tree}"]
    try:
        output = subprocess.check_output(command, stderr=subprocess.DEVNULL)
    except (OSError, subprocess.CalledProcessError):
        return None
    folder, tree = output.decode().splitlines()
    return None if folder else _PREFIX + tree  # a folder of another project's repository


def identifiers(root: "Path") -> "list[tuple[str, str]]":
    """Return name and identifier of the committed tree and of the content of each archive."""
    found = []
    tree = of_commit(root)
    if tree:
        found.append(("the committed tree", tree))
    for path in sorted((root / "results" / "archive").glob("*.tar")):
        try:
            found.append((path.name, _of_tar(path)))
        except (OSError, tarfile.TarError):
            continue  # `verify --against` says what is wrong with it
    return found


def _of_tar(path: "Path") -> "str":
    """Return the identifier of the one folder that an archive unpacks to."""
    files = {}
    with tarfile.open(str(path)) as tar:
        for entry in tar:
            content = tar.extractfile(entry)
            if content:
                files[entry.name.partition("/")[2]] = content.read(), entry.mode
    return of_files(files)


def _of_tree(tree: "dict[str, Any]") -> "bytes":
    entries = []
    for name, item in tree.items():
        if isinstance(item, dict):
            mode, key, digest = b"40000", name + "/", _of_tree(item)
        else:
            data, permissions = item
            mode = b"100755" if permissions == EXECUTABLE else b"100644"
            key, digest = name, _of_object(b"blob", data)
        entries.append((key.encode(), mode + b" " + name.encode() + b"\0" + digest))
    return _of_object(b"tree", b"".join(entry for _, entry in sorted(entries)))


def _of_object(kind: "bytes", data: "bytes") -> "bytes":
    header = kind + b" " + str(len(data)).encode() + b"\0"
    return hashlib.sha1(header + data).digest()
