"""Provenance: how each result is to be made, what made it, and which results are current.

- The **specification** of results/paper/orbits_fig2.nc, results/paper/specs/orbits_fig2.nc.json,
  says how it is to be made. It is written when the workflow is read (`Freshness.set_times`).
- Its **record**, results/paper/provenance/orbits_fig2.nc.json, says what made it. A job writes it
  last (`recorded`).
- A result is **current** if its record has its specification and its hash, and the hashes of its
  inputs, which are current (`Freshness.reason`). Nothing else decides that, and times never do.

All paths are relative to the project's root, so that the folder can be moved.
"""

import json
import os
import platform
import re
import subprocess
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from functools import cache, partial
from importlib import metadata
from pathlib import Path
from typing import Any, NamedTuple

from ..declaration import parts
from ..loading import LOADED
from .differences import differing_layers, differing_names
from .files import ABSENT, FileError, file_hash, read_bytes, read_text, why_not_a_file, write_whole
from .sources import ROOT, imported_modules, syntax_hash

SHAPE = ("config", "sources", "inputs", "environment", "output")  # the mappings of a record
# Imported module -> the packages that decide bits: its own, and those that it brings. Python's own
# version does not, nor do the tools around the work.
PACKAGES = {
    "deflate": ("deflate",),
    "flint": ("python-flint",),
    "matplotlib": ("matplotlib", "fonttools", "pyparsing"),
    "netCDF4": ("netCDF4",),
    "numba": ("numba", "llvmlite"),
    "numpy": ("numpy",),
    "scipy": ("scipy",),
    "xarray": ("xarray",),
}
CURRENT = "current"
MISSING = "missing"
DAMAGED = "changed after it was made"
REFUSED = "cannot exist: "  # how the reason begins then
# Differing layer -> the beginning of the reason to recompute a result.
_MADE = {
    "config": "made from another config: ",
    "source": "made by other code than this tree's: ",
    "environment": "made with ",
    "data": "made from another ",
}
_MOST_CAUSES = 4  # in one line


class BuildSpec(NamedTuple):
    """The specification of a result."""

    result: str  # its file
    scene: str  # its names in messages, such as those of a figure and a stage
    step: str
    config: dict[str, Any]  # the block of the config that it depends on
    program: str  # the module of `pipeline.jobs` that makes it
    function: str  # module.function that computes the dataset or draws the picture
    sources: Mapping[str, str | None]  # the project's files that decide its bytes -> their hashes
    inputs: list[str]  # the results that it is made from
    environment: Mapping[str, str | None] = {}  # package -> version


def beside(folder: str, suffix: str, result: str | os.PathLike[str]) -> str:
    """Return the path of a file about a result, in a folder of the result's variant."""
    _, variant, *_, name = Path(result).parts
    return f"results/{variant}/{folder}/{name}.{suffix}"


# Each takes a result and returns a path.
spec_path = partial(beside, "specs", "json")
record_path = partial(beside, "provenance", "json")
log_path = partial(beside, "logs", "log")  # written by a job that failed to make the result


def read_spec(path: str | os.PathLike[str]) -> BuildSpec:
    """Read a specification; raises FileError if the file is none."""
    try:
        return BuildSpec(**json.loads(read_text(path)))
    except (OSError, ValueError, TypeError) as error:
        reason = getattr(error, "strerror", None) or error
        raise FileError(f"{path}: no specification of a result: {reason}") from None


# -- records ---------------------------------------------------------------------------------------


def failure(result: str | os.PathLike[str]) -> str | None:
    """Return why the last job for a result failed, or None if that is not known."""
    try:
        return read_text(log_path(result)).splitlines()[-1].split(": ", 2)[2]
    except (OSError, ValueError, IndexError):
        return None


def read_record(root: Path, path: str) -> dict[str, Any]:
    """Read a record, with the mappings of SHAPE; raises FileError, whose message says why."""
    try:
        record: dict[str, Any] = json.loads(read_text(root / path))
        if not all(isinstance(record[name], dict) for name in SHAPE):
            raise TypeError
        str(record["output"]["sha256"])
    except FileNotFoundError:
        raise FileError("no record of what made it") from None
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        raise FileError(f"its record {path} cannot be read") from None
    return record


@contextmanager
def recorded(spec: BuildSpec) -> Iterator[dict[str, Any]]:
    """Write the record of a result once the body has made it; the current folder is the root.

    The body may describe the result further in the mapping that it is given.

    A ValueError in the body says that the result cannot exist. The record then has its message. An
    error of a subclass of ValueError, such as FileError, counts only if it has the attribute
    `lasting`. Raises FileError, and writes no record, if a source is not as the specification has
    it, or if a source or an input changes.
    """
    hashes = {path: file_hash(path) for path in sorted([*spec.sources, *spec.inputs])}
    for path, meaning in spec.sources.items():
        if syntax_hash(path) != meaning:
            raise _changed(path)
    installed = versions(spec)
    for package, version in spec.environment.items():
        if installed.get(package) != version:
            words = f"{package} is {installed.get(package)} here, not {version}"
            raise FileError(f"{words}: run ./reproduce again")
    head, dirty = commit()
    record: dict[str, Any] = {
        "commit": head,
        "dirty": dirty,
        "function": spec.function,
        "config": spec.config,
        "inputs": {path: hashes[path] for path in spec.inputs},
        "sources": dict(spec.sources),
        "environment": installed,
        "python": platform.python_version(),
    }
    require_unchanged(hashes)
    start, refusal = time.monotonic(), None
    output: dict[str, Any] = {"file": spec.result}
    try:
        yield output
        record["seconds"] = time.monotonic() - start
    except ValueError as error:
        if not getattr(error, "lasting", type(error) is ValueError):
            raise
        refusal, output = error, {"refused": str(error)}
    require_unchanged(hashes)
    output["sha256"] = None if refusal else file_hash(spec.result)
    text = json.dumps(record | {"output": output}, sort_keys=True, indent=1)
    write_whole(record_path(spec.result), f"{text}\n")
    if refusal:
        raise refusal


def _changed(path: str) -> FileError:
    return FileError(f"{path} changed during the run; run ./reproduce again")


def require_unchanged(hashes: Mapping[str, str | None]) -> None:
    """Raise FileError if a file does not have its hash, or did not when it was loaded.

    `hashes` maps a path, relative to the current folder, to its SHA-256, or None for no file.
    """
    for path, digest in hashes.items():
        loaded = LOADED.get(os.path.realpath(path), set())
        if file_hash(path) != digest or loaded - {digest}:
            raise _changed(path)


def require_loaded_unchanged() -> None:
    """Raise FileError if a file of this tree has changed since this process loaded it."""
    for path, digests in LOADED.items():
        for digest in digests if Path(path).is_relative_to(ROOT) else ():
            require_unchanged({os.path.relpath(path, ROOT): digest})


def _installed(package: str) -> str | None:
    """Return the version of a package, of one that is installed on demand that of its list."""
    with suppress(metadata.PackageNotFoundError):
        return metadata.version(package)
    lines = read_text(ROOT / "requirements" / "algebra.txt").splitlines()
    pins = dict(line.split()[0].split("==") for line in lines if re.match("[a-z]", line))
    return pins.get(package)


def versions(
    spec: BuildSpec,
    modules_of: Callable[[str], set[str]] = imported_modules,
    version_of: Callable[[str], str | None] = _installed,
) -> dict[str, str | None]:
    """Return the installed version of each package that decides the bits of a result, or None.

    Those are PACKAGES of the modules that its sources import, by `modules_of`, and, for a GIF, what
    encodes it. Files are relative to the current folder.
    """
    imported = set[str]().union(*map(modules_of, spec.sources))
    packages = {each for module in imported & PACKAGES.keys() for each in PACKAGES[module]}
    packages |= {"pillow"} if spec.result.endswith(".gif") else set()
    return {package: version_of(package) for package in sorted(packages)}


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


@cache
def commit() -> tuple[str | None, bool | None]:
    """Return the commit, and whether tracked files other than figures differ from it."""
    # Without the second name, this could be the commit of a repository that contains this folder.
    commits = git("rev-parse", "HEAD", "HEAD:./Snakefile")
    if commits is None:
        return None, None
    sets = [each for part in parts().values() for each in part.sets.values()]
    figures = [f":!{each.folder}" for each in sets if each.folder]
    changed = git("status", "--porcelain", "--untracked-files=no", "--", ".", *figures)
    return commits.split()[0].decode(), None if changed is None else bool(changed)


# -- which results are current ---------------------------------------------------------------------


def with_dependencies(build_specs: Mapping[str, BuildSpec], wanted: Iterable[str]) -> list[str]:
    """Return those of the results `wanted` that have specifications, each after its inputs."""
    results: dict[str, None] = {}
    for path in wanted:
        if path in build_specs:
            behind = with_dependencies(build_specs, build_specs[path].inputs)
            results |= dict.fromkeys([*behind, path])
    return list(results)


class Freshness:
    """Tells which results of a tree have to be recomputed, and why.

    The cached method `reason(path)` returns why a result has to be recomputed: MISSING if it is not
    there, REFUSED and why if it cannot exist, None if it is current.
    """

    def __init__(self, root: Path, build_specs: Mapping[str, BuildSpec]) -> None:
        self.root = root
        self.digest = cache(lambda path: file_hash(root / path))
        self.syntax_hash = cache(lambda path: syntax_hash(root / path))
        self.reason = cache(self._reason)
        self.build_specs = dict[str, BuildSpec]()
        modules_of = cache(lambda file: imported_modules(root / file))
        version_of = cache(_installed)
        for path, spec in build_specs.items():
            sources = {file: self.syntax_hash(file) for file in spec.sources}
            environment = versions(spec, modules_of, version_of)
            self.build_specs[path] = spec._replace(sources=sources, environment=environment)

    def set_times(self) -> None:
        """Write all specifications, and set times of files so that they say what is current.

        The files of a current result are touched, each after those of its inputs. The specification
        of another result becomes newer than the result, which is touched too, as its time may be in
        the future. Raises FileError if that cannot be done.
        """
        outdated = self.outdated()
        try:
            for path, spec in self.build_specs.items():  # inputs come first
                file, result = self.root / spec_path(path), self.root / path
                text = f"{json.dumps(spec._asdict(), indent=1)}\n"
                if not file.is_file() or read_bytes(file) != text.encode():
                    write_whole(file, text)
                for each in (file, result, self.root / record_path(path)):
                    try:
                        os.utime(each)
                    except ABSENT:
                        pass
                    except PermissionError:  # it belongs to another user: a copy replaces it
                        write_whole(each, read_bytes(each))
                again = path in outdated and result.exists()
                while again and file.stat().st_mtime_ns <= result.stat().st_mtime_ns:
                    time.sleep(0.001)
                    os.utime(file)
        except OSError as error:
            words = f"its time cannot be set: {error.strerror}"
            raise FileError(f"{error.filename}: {words}") from None

    def outdated(self, paths: Iterable[str] | None = None) -> dict[str, str]:
        """Map each result in `paths` (default: all) that has to be recomputed to the reason."""
        results = self.build_specs if paths is None else paths
        return {path: why for path in results if (why := self.reason(path))}

    def refusal(self, path: str) -> str | None:
        """Return why a result cannot exist, or None."""
        reason = self.reason(path) or ""
        return reason.removeprefix(REFUSED) if reason.startswith(REFUSED) else None

    def state(self, path: str) -> str:
        """Say whether a result is current, missing, stale and why, or cannot exist and why."""
        reason = self.reason(path) or CURRENT
        if reason in (CURRENT, MISSING) or self.refusal(path):
            return reason
        return f"stale: {self._why([*self.outdated(with_dependencies(self.build_specs, [path]))])}"

    def to_make(self, paths: Iterable[str]) -> list[str]:
        """Return a line for each scene with outdated results: the reasons and the steps."""
        scenes: dict[str, list[str]] = {}
        for path in self.outdated(paths):
            scenes.setdefault(self.build_specs[path].scene, []).append(path)
        lines = []
        for scene, results in scenes.items():
            steps = dict.fromkeys(self.build_specs[path].step.split()[0] for path in results)
            lines.append(f"{scene}: {self._why(results)}: {', '.join(steps)}")
        return lines or ["nothing to make"]

    def _why(self, paths: list[str]) -> str:
        """Join the reasons of outdated results, without those that follow from others."""
        causes = dict.fromkeys(filter(None, map(self._own_reason, paths)))
        if len(causes) > 1:
            causes.pop(MISSING, None)
        shown = ["not made yet" if cause == MISSING else cause for cause in causes][:_MOST_CAUSES]
        shown = [cause.removeprefix(_MADE["config"]) for cause in shown]
        more = [f"and {len(causes) - len(shown)} more"] if len(causes) > len(shown) else []
        return "; ".join(shown + more) or str(self.reason(paths[0]))

    def _reason(self, path: str) -> str | None:
        if path not in self.build_specs:
            return None  # an input that is made by another command
        inputs = self.build_specs[path].inputs
        if why := next(filter(None, map(self.refusal, inputs)), None):
            return REFUSED + why
        if why := self._own_reason(path):
            return why
        for used in inputs:
            if why := self.reason(used):
                return f"made from {used}, which is {MISSING if why == MISSING else 'not current'}"
        return None

    def _own_reason(self, path: str) -> str | None:
        """Return why a result has to be recomputed even if its inputs are current."""
        digest, output, why = self.digest(path), dict[str, Any](), None
        try:
            record = read_record(self.root, record_path(path))
        except FileError as error:
            why = str(error)
        else:
            output, why = record["output"], self._made_otherwise(path, record)
        if output.get("refused") and not why:
            return f"{REFUSED}{output['refused']}"
        if digest is None:
            return why_not_a_file(self.root / path) or MISSING
        return DAMAGED if output.get("sha256", digest) != digest else why

    def _made_otherwise(self, path: str, record: dict[str, Any]) -> str | None:
        """Return the first difference between a record and what this tree makes a result from."""
        spec = self.build_specs[path]
        # A graphics card makes the same bytes with further sources, which the record names.
        way = record["output"].get("way", {})
        before = record | {"sources": record["sources"] | way}
        here = record | {
            "function": spec.function,
            "config": spec.config,
            "sources": {**spec.sources, **{file: self.syntax_hash(file) for file in way}},
            "environment": spec.environment,
            "inputs": {used: self.digest(used) for used in spec.inputs},
        }
        if json.dumps(before, sort_keys=True) == json.dumps(here, sort_keys=True):  # 1 is not 1.0
            return None
        layers = differing_layers(before, here)
        for used in differing_names(before["inputs"], here["inputs"]):
            layers.setdefault("data", used)
        other = f"function {record.get('function')} -> {spec.function}"
        layer, words = next(iter(layers.items()), ("source", other))
        return _MADE[layer] + words
