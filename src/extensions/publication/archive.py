"""Archives of what is published and what it was made from, and comparison of a tree with them.

An archive is one tar file. The same files give the same bytes: names are sorted, there are no
times and no owners, modes follow from names, and nothing is compressed. An archive with packages
also has the sources of this tree and the locked packages, so that its unpacked folder runs
`./reproduce` without a network.
"""

import hashlib
import io
import json
import os
import tarfile
import tempfile
from collections.abc import Collection, Iterator
from contextlib import suppress
from pathlib import Path

import numpy as np

from pipeline.checks import manifest, verify
from pipeline.checks.layers import Comparison
from pipeline.checks.published_sets import (
    MANIFEST,
    SUMS,
    PublishedSet,
    committed_sets,
    format_sums,
    read_sums,
)
from pipeline.config import MAIN, PUBLISHED, Config
from pipeline.declaration import parts
from pipeline.records import files
from pipeline.records.artifacts import ArtifactError, load
from pipeline.records.differences import differing_data
from pipeline.records.files import FileError, file_hash, read_bytes
from pipeline.records.pictures import picture_difference
from pipeline.records.provenance import SHAPE, Freshness, git, read_record, record_path

TOP = "pseudorigid"  # the folder in the tar
ABOUT = "README.txt"
PACKAGES = "packages"  # the folder of the locked packages; `reproduce` installs from it
_EXECUTABLES = ("reproduce", ".ci/run")
EXPLORER = "results/explorer.html"  # if there is an explorer
# Files of the tree that say what the results were made from.
_INPUTS = (
    *("config.yaml", "Snakefile", "LICENSE", "CITATION.cff", "workflow/rules/*.smk"),
    *("src/*/scenes.yaml", "src/extensions/*/scenes.yaml"),
    "src/extensions/*/certificates/*.toml",
)
# README.txt, and what it says of packages.
_ABOUT_TEXT = Path(__file__).with_suffix(".txt")
_ABOUT_PACKAGES = Path(__file__).with_name("archive_packages.txt")

Contents = dict[str, bytes]  # path of a file -> its bytes


class ArchiveError(ValueError):
    """An archive cannot be made or read. The message is one line."""


def write(root: Path, config: Config, path: Path | str, packages: Collection[Path] = ()) -> str:
    """Write the archive of the tree at `root`, whole or not at all, and return its sha256.

    With `packages`, files of the locked packages, it also has these and the tree's sources. Raises
    ArchiveError if results are missing or not current, if published files are not the committed
    ones, or if `path` is a file that is no archive.
    """
    path = Path(path)
    if os.path.isdir(path):
        raise ArchiveError(f"{path} is a folder")
    if os.path.exists(path):  # another archive may be replaced, anything else is the user's
        read(path)
    left_out = refuse_unpublished(root, config)
    print(*left_out, sep="\n", end="\n" * bool(left_out))
    archived = contents(root, config, packages)
    with files.replacing(path) as part, tarfile.open(part, "w", format=tarfile.USTAR_FORMAT) as tar:
        for name, data in archived.items():
            entry = tarfile.TarInfo(f"{TOP}/{name}")
            entry.size, entry.mode = len(data), 0o755 if name in _EXECUTABLES else 0o644
            tar.addfile(entry, io.BytesIO(data))
    return str(file_hash(path))


def refuse_unpublished(root: Path, config: Config) -> list[str]:
    """Raise ArchiveError for a result that is not current, or a file that is not the committed one.

    Figures and data of sets that are made on request may be missing. Returns a line for each scene
    that cannot be made.
    """
    left_out = []
    for findings in verify.verify(root, config):
        published_set = findings.published_set
        if problem := findings.not_published(root, partial=published_set.on_request):
            raise ArchiveError(f"{problem}: run {published_set.command}")
        if findings.unlisted:
            raise ArchiveError(next(iter(findings.unlisted.values())))
        if problems := [*findings.problems, *_uncommitted(findings)]:
            raise ArchiveError(f"{problems[0]}: run ./reproduce accept")
        left_out += findings.left_out
    return left_out


def _uncommitted(findings: verify.Findings) -> Iterator[str]:
    """Yield a line for each published file that is new or not the committed one."""
    for name, layers in findings.layers.items():
        if layers is None or name in findings.differences:
            words = "; ".join((layers or {"file": "new"}).values())
            yield f"{findings.published_set.folder}/{name} is not the committed one: {words}"


def contents(root: Path, config: Config, packages: Collection[Path] = ()) -> Contents:
    """Return the files that an archive of this tree has, as far as they exist."""
    archived = {f"{PACKAGES}/{_short(file.name)}": read_bytes(file) for file in packages}
    paths = _sources(root) if packages else []
    paths += [str(file.relative_to(root)) for pattern in _INPUTS for file in root.glob(pattern)]
    counts = []  # of datasets, in words
    for published_set in committed_sets(config):
        paths += published_set.text_files
        if not published_set.is_committed(root):
            continue
        names = [*read_sums(root, published_set.folder), SUMS, MANIFEST]
        paths += [f"{published_set.folder}/{name}" for name in names]
        # Also blocks of sweeps: without its inputs, a dataset is not current.
        data = [path for path in published_set.build_specs if path.endswith(".nc")]
        present = sorted(path for path in data if (root / path).is_file())
        paths += present
        counts.append(f"{len(present)} of {len(data)} datasets of {published_set.command}")
        drawn = [path for path in published_set.drawn.values() if (root / path).is_file()]
        archived |= {record_path(path): _public_record(root, path) for path in present + drawn}
    archived |= {path: read_bytes(root / path) for path in paths if (root / path).is_file()}
    archived |= _explorer_page(root, config)
    about_packages = _ABOUT_PACKAGES.read_text(encoding="utf-8") if packages else ""
    about = _ABOUT_TEXT.read_text(encoding="utf-8")
    archived[ABOUT] = about.format(sets=", ".join(counts), packages=about_packages).encode()
    archived = dict(sorted(archived.items()))
    sums = {path: hashlib.sha256(data).hexdigest() for path, data in archived.items()}
    return archived | {SUMS: format_sums(sums).encode()}


def _explorer_page(root: Path, config: Config) -> Contents:
    """Return the page of the explorer, if there is that extension."""
    if "explorer" in parts():
        from extensions.explorer import page

        try:
            return {EXPLORER: page.render(config, root).encode()}
        except ValueError as error:
            raise ArchiveError(str(error)) from None
    return {}


def _sources(root: Path) -> list[str]:
    """Return the paths of the files that git tracks in this tree."""
    listed = git("ls-files", "-z", root=root)
    if listed is None:
        raise ArchiveError(
            "an archive with packages has the sources that git lists: see git status"
        )
    return [path for path in listed.decode().split("\0") if path and (root / path).is_file()]


def _public_record(root: Path, path: str) -> bytes:
    """Return the record of a result without commit and Python, which belong to one machine."""
    try:
        record = read_record(root, record_path(path))
    except FileError:
        return b""
    public = {name: record[name] for name in ("function", *SHAPE) if name in record}
    return (json.dumps(public, sort_keys=True, indent=1) + "\n").encode()


def read(path: Path | str) -> Contents:
    """Return the regular files of an archive, each checked by its sum. Nothing is written."""
    if os.path.exists(path) and not os.path.isfile(path):
        raise ArchiveError(f"{path}: no archive: it is no regular file")
    try:
        with tarfile.open(path, mode="r:") as tar:
            archived = {entry.name.removeprefix(f"{TOP}/"): _content(tar, entry) for entry in tar}
    except FileError as error:
        raise ArchiveError(str(error)) from None
    except (tarfile.TarError, OSError, ValueError, MemoryError) as error:
        raise ArchiveError(f"{path}: no archive, or damaged: {error}") from None
    if SUMS not in archived:
        raise ArchiveError(f"{path}: not made by ./reproduce archive, or damaged: no {SUMS}")
    sums = _parsed(archived.pop(SUMS))
    for name in sorted({*sums, *archived}):
        if name not in archived or hashlib.sha256(archived[name]).hexdigest() != sums.get(name):
            shown = name if name in archived else repr(name)  # a listed name may be any text
            raise ArchiveError(f"{path}: damaged: {shown} does not fit {SUMS}")
    return archived


def _content(tar: tarfile.TarFile, entry: tarfile.TarInfo) -> bytes:
    """Return the bytes of a regular file with a plain name."""
    plain = entry.type == tarfile.REGTYPE and not entry.issparse() and _is_plain(entry.name)
    file = tar.extractfile(entry) if plain else None
    if file is None:
        raise tarfile.TarError(f"./reproduce archive did not write {entry.name!r:.100}")
    return file.read()


def _is_plain(name: str) -> bool:
    """Return whether a path from elsewhere stays below the folder that it starts from."""
    return name.isprintable() and not {"", ".", ".."} & {*name.split("/")}


def _short(name: str) -> str:
    """Return the name of a wheel, with as many of its platforms as a tar has room for."""
    while len(name) > tarfile.LENGTH_NAME:
        stem, _, platforms = name.removesuffix(".whl").rpartition("-")
        name = f"{stem}-{platforms.partition('.')[2]}.whl"
    return name


def _parsed(sums: bytes) -> dict[str, str]:
    """Return file -> sha256 of an archive's SHA256SUMS."""
    lines = (line.split("  ", 1) for line in sums.decode("utf-8", "replace").splitlines())
    return {line[1]: line[0] for line in lines if len(line) == 2}


def _read_folder(folder: Path, config: Config) -> Contents:
    """Return the files of another tree, or of an unpacked archive, that an archive would have."""
    try:
        manifest.read(folder, PUBLISHED[MAIN])
        archived = contents(folder, config)
        if (folder / EXPLORER).is_file():  # otherwise the page of its config and its manifest
            archived[EXPLORER] = read_bytes(folder / EXPLORER)
        # An archive may have files that this tree's config does not name.
        for name in _parsed(read_bytes(folder / SUMS)) if (folder / SUMS).is_file() else ():
            if name not in archived and _is_plain(name) and (folder / name).is_file():
                archived[name] = read_bytes(folder / name)
    except FileError as error:
        expected = "no tree of this project, and no archive of it that was unpacked"
        raise ArchiveError(f"{folder} is {expected}: {error}") from None
    del archived[SUMS]
    return archived


def compare(root: Path, config: Config, other: Path) -> int:
    """Compare this tree with an archive, an unpacked one, or another tree; print a line a file.

    A file that differs has a line for each layer too. Returns 0 if both have the same files with
    the same bytes. Raises ArchiveError if `other` is none of these.
    """
    theirs = _read_folder(other, config) if other.is_dir() else read(other)
    ours = contents(root, config)
    if any(name.startswith(f"{PACKAGES}/") for name in theirs):  # it has the sources too
        ours |= {name: read_bytes(root / name) for name in _sources(root)}
    # SUMS and ABOUT list the datasets that exist; requirements/ has the hashes of packages.
    names = sorted({*ours, *theirs} - {SUMS, ABOUT})
    names = [name for name in names if not name.startswith(f"{PACKAGES}/")]
    sets = {f"{s.folder}/{name}": s for s in committed_sets(config) for name in s.drawn}
    absent = f"not in the {'folder' if other.is_dir() else 'archive'}"
    counts = dict.fromkeys(("identical", "differs", "missing here", absent), 0)
    width = max(map(len, names))
    with tempfile.TemporaryDirectory() as scratch:  # a comparison by layers needs files
        folder = Path(scratch)
        for name, data in theirs.items():
            if name.endswith(f"/{MANIFEST}") or ours.get(name, data) != data:
                files.write_whole(folder / name, data)
        for name in names:
            layers: dict[str, str] = {}
            if name not in ours or name not in theirs:
                state = "missing here" if name in theirs else absent
            elif ours[name] == theirs[name]:
                state = "identical"
            else:
                state = "differs"
                if name.endswith(".nc"):
                    layers = {"data": _data_difference(root, name, folder)}
                elif name in sets:
                    layers = _drawing_differences(root, sets[name], name, folder)
            counts[state] += 1
            print(f"{name:{width}}  {state}")
            for layer, words in layers.items():
                print(f"{'':{width}}  {layer}: {words}".replace(f"{folder}/", "the other "))
    print("", ", ".join(f"{n} {state}" for state, n in counts.items() if n), sep="\n")
    return int(counts["identical"] < len(names))


def _data_difference(root: Path, path: str, other: Path) -> str:
    """Return how a dataset of this tree differs from its copy in the folder `other`."""
    try:
        ours, theirs = load(root / path), load(other / path)
        words = differing_data(*map(manifest.describe_data, (theirs, ours)))
    except (ArtifactError, FileError) as error:
        return str(error)
    gaps = [0.0]
    for name in ours.variables.keys() & theirs.variables.keys():
        a, b = ours.variables[name], theirs.variables[name]
        if a.shape == b.shape and {a.dtype.kind, b.dtype.kind} <= {*"iuf"}:
            gaps.append(float(np.nanmax(np.abs(a.values - b.values), initial=0.0)))
    size = f"numbers differ by at most {max(gaps):.3g}"
    return f"{path}: {words}; {size}" if words else "the same in other bytes"


def _drawing_differences(
    root: Path, published_set: PublishedSet, path: str, other: Path
) -> dict[str, str]:
    """Return layer -> how a published picture differs from its copy in the folder `other`."""
    name = os.path.basename(path)
    image = root / "results" / published_set.group / "differences" / name
    layers: dict[str, str] = {}
    try:
        with suppress(FileError):
            committed = manifest.read(other, published_set.folder)
            freshness = Freshness(root, published_set.build_specs)
            layers = Comparison(freshness, published_set, committed).layers(name) or {}
        if "file" not in layers:
            words = picture_difference(root / path, other / path, image)
            layers["drawing"] = f"{path}: {words}".replace(f"{root}/", "")
    except (ArtifactError, FileError) as error:
        layers["drawing"] = str(error)
    return layers
