"""What made a result: a record beside each artifact and drawing.

The record of results/paper/orbits_fig2.nc is results/paper/provenance/orbits_fig2.nc.json. It is
written as the job's last act and is one of the job's outputs: a job that was killed before it is
done again. Paths are relative to the project's root, so that a folder that moved still verifies.
"""

import json
import os
import platform
import subprocess
from contextlib import contextmanager
from importlib import metadata
from pathlib import Path

import pseudorigid

from .files import file_hash, read_text, write_whole
from .sources import ROOT, meaning

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
    _, variant, *_, name = Path(result).parts
    return f"results/{variant}/provenance/{name}.json"


def read_record(root, path):
    """The record of a result.

    Parameters
    ----------
    root : pathlib.Path
    path : str
        Of the result, from the root.

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
        record = json.loads(read_text(root / record_path(path)))
        for name, kind in SHAPE.items():
            if not isinstance(record[name], kind):
                raise TypeError
        str(record["output"]["sha256"])
    except FileNotFoundError:
        raise RecordError("no record of what made it") from None
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        raise RecordError(f"its record {record_path(path)} cannot be read") from None
    return record


@contextmanager
def recorded(output, config, sources, inputs=()):
    """Write the record of a result, once the body has made it; the current folder is the root.

    Parameters
    ----------
    output : str
        The result, from the root.
    config : dict
        The block behind it.
    sources : iterable of str
        The project's own files that make it.
    inputs : iterable of str
        The results it is made from.

    Raises
    ------
    ChangedError
        Where a source or an input changed from when it was loaded to now; no record is written.
    """
    texts = {path: file_hash(path) for path in sorted(sources)}
    commit, dirty = _commit()
    record = {
        "commit": commit,
        "dirty": dirty,
        "config": config,
        "inputs": {path: file_hash(path) for path in sorted(inputs)},
        "sources": {path: meaning(path) for path in texts},
        "environment": versions(),
        "python": platform.python_version(),
    }
    require_unchanged(texts)
    yield
    require_unchanged(texts | record["inputs"])
    about = {"file": output, "sha256": file_hash(output)}
    if output.endswith(".nc"):
        from .artifacts import content_hash, load

        about["content"] = content_hash(load(output))
    text = json.dumps(record | {"output": about}, sort_keys=True, indent=1)
    write_whole(record_path(output), f"{text}\n")


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
