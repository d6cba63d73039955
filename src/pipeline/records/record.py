"""Records: what made each result.

The record of results/paper/orbits_fig2.nc is results/paper/provenance/orbits_fig2.nc.json. A job
writes it last and declares it as an output, so that a job that was killed before is run again. Its
paths are relative to the project's root, so that the folder can be moved.
"""

import json
import os
import platform
import subprocess
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from functools import partial
from importlib import metadata
from pathlib import Path
from typing import Any

from ..declaration import parts
from ..loading import LOADED
from .build_spec import BuildSpec
from .files import file_hash, read_text, write_whole
from .sources import ROOT, syntax_hash

SHAPE = ("config", "sources", "inputs", "environment", "output")  # the mappings of a record
# The packages that decide bits. Python's own version does not, nor do the tools around the work.
PACKAGES = (
    *("deflate", "fonttools", "llvmlite", "matplotlib", "netCDF4"),
    *("numba", "numpy", "pyparsing", "python-flint", "scipy", "xarray"),
)


class RecordError(ValueError):
    """A record that cannot be read; the message says why."""


class ChangedError(ValueError):
    """A file that changed while something was made from it: one line."""


def beside(folder: str, suffix: str, result: str | os.PathLike[str]) -> str:
    """Return the path of a file about a result, in a folder of the result's variant."""
    _, variant, *_, name = Path(result).parts
    return f"results/{variant}/{folder}/{name}.{suffix}"


# Each takes a result and returns a path; both are relative to the root.
record_path = partial(beside, "provenance", "json")
refusal_path = partial(beside, "logs", "json")  # a record of why the result cannot exist
log_path = partial(beside, "logs", "log")  # written by a job that failed to make the result


def failure(result: str | os.PathLike[str]) -> str | None:
    """Return why the last job for a result failed, or None if that is not known."""
    try:
        return read_text(log_path(result)).splitlines()[-1].split(": ", 2)[2]
    except (OSError, ValueError, IndexError):
        return None


def read_record(root: Path, path: str) -> dict[str, Any]:
    """Read a record of a result or of a refusal, with the mappings of SHAPE; raises RecordError."""
    try:
        record: dict[str, Any] = json.loads(read_text(root / path))
        if not all(isinstance(record[name], dict) for name in SHAPE):
            raise TypeError
        str(record["output"]["sha256"])
    except FileNotFoundError:
        raise RecordError("no record of what made it") from None
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        raise RecordError(f"its record {path} cannot be read") from None
    return record


def public_record(root: Path, result: str) -> dict[str, Any]:
    """Return the record of a result without what belongs to one machine; raises RecordError."""
    record = read_record(root, record_path(result))
    return {name: record[name] for name in SHAPE}


@contextmanager
def recorded(spec: BuildSpec) -> Iterator[dict[str, Any]]:
    """Write the record of a result once the body has made it; the current folder is the root.

    The body may describe the result further in the mapping that it is given.

    A ValueError in the body says that the result cannot exist (one of a subclass, such as
    FileError, only if it has the attribute `lasting`). The refusal is recorded then, so that the
    job is not repeated before its config, sources or inputs change. Raises ChangedError, and writes
    no record, if a source or an input has changed since it was loaded.
    """
    source_hashes = {path: file_hash(path) for path in sorted(spec.sources)}
    commit, dirty = _commit()
    record: dict[str, Any] = {
        "commit": commit,
        "dirty": dirty,
        "config": spec.config,
        "inputs": {path: file_hash(path) for path in sorted(spec.inputs)},
        "sources": {path: syntax_hash(path) for path in source_hashes},
        "environment": versions(),
        "python": platform.python_version(),
    }
    require_unchanged(source_hashes)
    start = time.monotonic()
    output: dict[str, Any] = {"file": spec.result}
    try:
        yield output
    except ValueError as error:
        if getattr(error, "lasting", type(error) is ValueError):
            require_unchanged(source_hashes | record["inputs"])
            _write(refusal_path(spec.result), record, {"sha256": None, "refused": str(error)})
        raise
    record["seconds"] = time.monotonic() - start
    require_unchanged(source_hashes | record["inputs"])
    output["sha256"] = file_hash(spec.result)
    _write(record_path(spec.result), record, output)


def _write(path: str, record: dict[str, Any], output: dict[str, Any]) -> None:
    """Write a record with a description of its output."""
    write_whole(path, json.dumps(record | {"output": output}, sort_keys=True, indent=1) + "\n")


def require_unchanged(hashes: Mapping[str, str | None]) -> None:
    """Raise ChangedError if a file does not have its hash, or did not when it was loaded.

    `hashes` maps a path, relative to the current folder, to its SHA-256, or None for no file.
    """
    for path, digest in hashes.items():
        loaded = LOADED.get(os.path.realpath(path), set())
        if file_hash(path) != digest or loaded - {digest}:
            raise ChangedError(f"{path} changed during the run; run ./reproduce again")


def require_loaded_unchanged() -> None:
    """Raise ChangedError if a file of this tree has changed since this process loaded it."""
    for path, digests in LOADED.items():
        for digest in digests if Path(path).is_relative_to(ROOT) else ():
            require_unchanged({os.path.relpath(path, ROOT): digest})


def versions() -> dict[str, str | None]:
    """Return the installed version of each package that decides bits, None for a missing one."""
    installed: dict[str, str | None] = dict.fromkeys(PACKAGES)
    for package in PACKAGES:
        with suppress(metadata.PackageNotFoundError):
            installed[package] = metadata.version(package)
    return installed


def git(*arguments: str, root: str | os.PathLike[str] = ".") -> bytes | None:
    """Return the output of a git command, or None if it fails or git is not installed."""
    command = ["git", "--no-optional-locks", "-C", str(root), *arguments]
    with suppress(OSError, subprocess.CalledProcessError):
        return subprocess.check_output(command, stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return None


def git_refuses(root: str | os.PathLike[str] = ".") -> bool:
    """Return whether git cannot read the repository around a folder, as one of another owner."""
    folder = Path(root).resolve()
    there = any((each / ".git").exists() for each in (folder, *folder.parents))
    return there and git("rev-parse", "--git-dir", root=root) is None


def _commit() -> tuple[str | None, bool | None]:
    """Return the commit, and whether tracked files other than figures differ from it."""
    commit = git("rev-parse", "HEAD")
    # Another repository may contain this folder.
    if commit is None or git("ls-files", "--error-unmatch", "Snakefile") is None:
        return None, None
    published = [each.folder for part in parts().values() for each in part.sets.values()]
    others = [f":!{folder}" for folder in published if folder]
    changed = git("status", "--porcelain", "--untracked-files=no", "--", ".", *others)
    return commit.decode().strip(), None if changed is None else bool(changed.strip())
