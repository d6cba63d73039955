"""What made a result: a record beside each artifact and drawing.

The record of results/paper/orbits_fig2.nc is results/paper/provenance/orbits_fig2.nc.json. It is
written as the job's last act and is one of the job's outputs: a job that was killed before it is
done again. Paths are relative to the project's root, so that a folder that moved still verifies.
"""

import json
import os
import platform
import subprocess
import time
from contextlib import contextmanager
from importlib import metadata
from pathlib import Path

import pseudorigid

from .files import file_hash, read_text, write_whole
from .sources import ROOT, syntax_hash

SHAPE = {"config": dict, "sources": dict, "inputs": dict, "environment": dict, "output": dict}
# The packages that decide bits. Python's own version does not, nor do the tools around the work.
PACKAGES = ("deflate", "fonttools", "llvmlite", "matplotlib", "netCDF4", "numba", "numpy")
PACKAGES += ("pyparsing", "python-flint", "xarray")


class RecordError(ValueError):
    """In words, why a record cannot be read."""


class ChangedError(ValueError):
    """One line about a file that changed while something was made from it."""


def record_path(result):
    """Where the record of a result is: results/paper/provenance/<its file's name>.json.

    Parameters
    ----------
    result : path
        From the root.

    Returns
    -------
    str
    """
    return _beside(result, "provenance", "json")


def refusal_path(result):
    """Where the record of why a result cannot be made is, as for `record_path`."""
    return _beside(result, "logs", "json")


def log_path(result):
    """Where the log of a job that failed to make a result is, as for `record_path`."""
    return _beside(result, "logs", "log")


def failure(result):
    """Why the last job that was to make a result failed, None where it did not or nobody knows."""
    try:
        return read_text(log_path(result)).splitlines()[-1].split(": ", 2)[2]
    except (OSError, ValueError, IndexError):
        return None


def _beside(result, folder, suffix):
    _, variant, *_, name = Path(result).parts
    return f"results/{variant}/{folder}/{name}.{suffix}"


def read_record(root, path):
    """Read the record of a result, or of why it cannot be made.

    Parameters
    ----------
    root : pathlib.Path
    path : str
        Of the record, from the root.

    Returns
    -------
    dict
        With the keys of SHAPE.

    Raises
    ------
    RecordError
        In words, where there is none to be read.
    """
    try:
        record = json.loads(read_text(root / path))
        for name, kind in SHAPE.items():
            if not isinstance(record[name], kind):
                raise TypeError
        str(record["output"]["sha256"])
    except FileNotFoundError:
        raise RecordError("no record of what made it") from None
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        raise RecordError(f"its record {path} cannot be read") from None
    return record


@contextmanager
def recorded(spec):
    """Write the record of a result, once the body has made it; the current folder is the root.

    An error with `lasting` says that the result cannot exist with what it is made from: this is
    recorded in its place, so that it is not tried again before something of that changes.

    Parameters
    ----------
    spec : BuildSpec

    Raises
    ------
    ChangedError
        Where a source or an input changed from when it was loaded to now; no record is written.
    """
    texts = {path: file_hash(path) for path in sorted(spec.sources)}
    commit, dirty = _commit()
    record = {
        "commit": commit,
        "dirty": dirty,
        "config": spec.config,
        "inputs": {path: file_hash(path) for path in sorted(spec.inputs)},
        "sources": {path: syntax_hash(path) for path in texts},
        "environment": versions(),
        "python": platform.python_version(),
    }
    require_unchanged(texts)
    start = time.monotonic()
    try:
        yield
    except ValueError as error:
        if getattr(error, "lasting", False):
            require_unchanged(texts | record["inputs"])
            _write(refusal_path(spec.result), record, {"sha256": None, "refused": str(error)})
        raise
    record["seconds"] = time.monotonic() - start
    require_unchanged(texts | record["inputs"])
    about = {"file": spec.result, "sha256": file_hash(spec.result)}
    _write(record_path(spec.result), record, about)


def _write(path, record, output):
    write_whole(path, json.dumps(record | {"output": output}, sort_keys=True, indent=1) + "\n")


def require_unchanged(hashes):
    """Refuse to go on where a file is not, or was not when it was loaded, what it should be.

    Parameters
    ----------
    hashes : dict
        File -> its sha256, or None where there is none; the current folder is the root.

    Raises
    ------
    ChangedError
    """
    for path, digest in hashes.items():
        loaded = pseudorigid.LOADED.get(os.path.realpath(path), set())
        if file_hash(path) != digest or loaded - {digest}:
            raise ChangedError(f"{path} changed during the run; run ./reproduce again")


def require_loaded_unchanged():
    """Refuse to go on where a file of this tree is not what this process loaded from it.

    Raises
    ------
    ChangedError
    """
    for path, digests in pseudorigid.LOADED.items():
        for digest in digests if Path(path).is_relative_to(ROOT) else ():
            require_unchanged({os.path.relpath(path, ROOT): digest})


def versions():
    """The packages that decide bits.

    Returns
    -------
    dict
        Package -> installed version, None where it is not installed.
    """
    found = {}
    for package in PACKAGES:
        try:
            found[package] = metadata.version(package)
        except metadata.PackageNotFoundError:
            found[package] = None
    return found


def git(*arguments, root="."):
    """What git prints.

    Parameters
    ----------
    *arguments : str
    root : path

    Returns
    -------
    bytes or None
        None where it fails or is not there.
    """
    try:
        result = subprocess.run(
            ["git", "-C", str(root), *arguments],
            stdin=subprocess.DEVNULL,
            capture_output=True,
            check=False,
            env=os.environ | {"GIT_OPTIONAL_LOCKS": "0"},
        )
    except OSError:
        return None
    return result.stdout if result.returncode == 0 else None


def _commit():
    """(commit, whether tracked files other than the figures differ from it), None if unknown."""
    commit = git("rev-parse", "HEAD")
    # Another repository may lie around a copy of this folder.
    if commit is None or git("ls-files", "--error-unmatch", "Snakefile") is None:
        return None, None
    changed = git("status", "--porcelain", "--untracked-files=no", "--", ".", ":!paper_figures")
    return commit.decode().strip(), None if changed is None else bool(changed.strip())
