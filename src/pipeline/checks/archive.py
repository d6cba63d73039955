"""One tar with what this tree publishes and what that was made from; and a tree against such a tar.

The same files give the same bytes: names in order, no times, no owners, one mode, no compression.
"""

import hashlib
import io
import json
import os
import tarfile
import tempfile
from contextlib import suppress
from pathlib import Path, PurePosixPath

from ..config.paths import LEDGER, LEDGER_DATA, PAPER, PUBLISHED
from ..records import files
from ..records.artifacts import ArtifactError, load
from ..records.files import FileError, file_hash, obstacle, read_bytes
from ..records.pictures import PictureError, difference
from ..records.record import SHAPE, read_record, record_path
from . import manifest, published_sets
from .checksums import SUMS, ChecksumError, format_sums, known_sums, read_sums
from .difference import Comparison, not_as_made
from .freshness import MISSING

TOP = "pseudorigid"  # the folder in the tar
ABOUT = "README.txt"
_MOST = 10_000  # files in an archive; a complete one has some hundreds
CERTIFICATES = "src/pseudorigid/proofs/certificates"
README = Path(__file__).with_suffix(".txt")  # of the archive


class ArchiveError(ValueError):
    """One line about an archive that cannot be made or read."""


def write(root, checked, path):
    """Write the archive of the tree at `root`, whole or not at all; its sha256.

    Raises
    ------
    ArchiveError
        Where results are missing or not current, or published files not as their contract says.
    """
    path = Path(path)
    if os.path.isdir(path):
        raise ArchiveError(f"{path} is a folder")
    if os.path.exists(path):  # another archive may be replaced, anything else is the user's
        read(path)
    for published_set in published_sets.committed_sets(checked):
        if problem := _problem(root, published_set):
            raise ArchiveError(problem)
    found = contents(root, checked)
    with files.replacing(path) as part, tarfile.open(part, "w", format=tarfile.USTAR_FORMAT) as tar:
        for name, data in found.items():
            entry = tarfile.TarInfo.frombuf(_header(name, len(data)), "utf-8", "strict")
            tar.addfile(entry, io.BytesIO(data))
    return file_hash(path)


def contents(root, checked):
    """File -> bytes of all that an archive of this tree has, as far as it is there."""
    found, sets = {}, []
    places = ["config.yaml", "LICENSE", "CITATION.cff", LEDGER, LEDGER_DATA]
    places += [str(f.relative_to(root)) for f in (root / CERTIFICATES).glob("*.toml")]
    for published_set in published_sets.committed_sets(checked):
        if not manifest.is_present(root, published_set):
            continue
        names = [*known_sums(root, published_set.folder), SUMS, manifest.MANIFEST]
        places += [f"{published_set.folder}/{name}" for name in names]
        data = sorted({path for stages in published_set.data.values() for path in stages.values()})
        there = [path for path in data if (root / path).is_file()]
        sets += [f"{len(there)} of {len(data)} datasets of {published_set.command}"]
        places += there
        for path in (*there, *published_set.drawn.values()):
            if (root / path).is_file():
                found[record_path(path)] = _public_record(root, path)
    for path in places:
        if (root / path).is_file():
            found[path] = read_bytes(root / path)
    about = README.read_text(encoding="utf-8").format(
        certificates=CERTIFICATES, sets=", ".join(sets)
    )
    found[ABOUT] = about.encode()
    sums = {path: hashlib.sha256(found[path]).hexdigest() for path in sorted(found)}
    return dict(sorted(found.items())) | {SUMS: format_sums(sums).encode()}


def _public_record(root, path):
    """The record of a result without what is of one run and machine: commit and Python."""
    try:
        record = read_record(root, record_path(path))
    except ValueError:
        return b""
    kept = {name: record[name] for name in SHAPE}
    return (json.dumps(kept, sort_keys=True, indent=1) + "\n").encode()


def _problem(root, published_set):
    """Why a contract's files cannot be archived, in a line with what to run, or None."""
    if published_set.on_request and not manifest.is_present(root, published_set):
        return None
    try:
        committed = manifest.read(root, published_set.folder)
        sums = read_sums(root, published_set.folder)
    except ChecksumError as error:
        return f"{error}: run ./reproduce accept"
    comparison = Comparison(root, published_set, committed)
    for path, why in not_as_made(root, published_set, comparison).items():
        if why != MISSING:
            return f"{path}: {why}: run {published_set.command}"
        if not published_set.on_request:
            return f"{path} is missing: run {published_set.command}"
    for name in sorted({*published_set.drawn, *sums}):
        path = f"{published_set.folder}/{name}"
        if words := obstacle(root / path):
            return f"{path}: {words}"
        here, drawn = file_hash(root / path), file_hash(root / published_set.drawn.get(name, path))
        if here is None or drawn not in (None, here):
            return f"{path} is not the one that was drawn: run {published_set.command}"
        if here != sums.get(name):
            return f"{path} is not as in {published_set.folder}/{SUMS}: run ./reproduce accept"
    listed = f"{published_set.folder}/{manifest.MANIFEST}"
    for path in published_set.texts:
        if file_hash(root / path) != committed["texts"].get(path):
            return f"{path} is not as in {listed}: run {published_set.command}"
    return None


def read(path):
    """File -> bytes of an archive, each checked by its sum; nothing is written.

    Only what `write` writes is taken: regular files with plain names, and not a byte beside them.

    Raises
    ------
    ArchiveError
    """
    found = {}
    if os.path.exists(path) and not os.path.isfile(path):
        raise ArchiveError(f"{path}: no archive: it is no regular file")
    try:
        with files.open_regular(path) as file:
            for name, data in _members(file):
                if name in found or len(found) == _MOST:
                    many = f"more than {_MOST:,} files" if len(found) == _MOST else "twice"
                    raise tarfile.TarError(f"{name!r}: {many}")
                found[name] = data
    except _ForeignError as error:
        raise ArchiveError(f"{path}: not made by ./reproduce archive: {error}") from None
    except FileError as error:
        raise ArchiveError(str(error)) from None
    except (tarfile.TarError, OSError, ValueError) as error:
        raise ArchiveError(f"{path}: no archive, or damaged: {error}") from None
    if SUMS not in found:
        raise ArchiveError(f"{path}: not made by ./reproduce archive, or damaged: no {SUMS}")
    sums = found.pop(SUMS)
    listed = _listed(sums)
    for name in sorted({*listed, *found}):
        if name not in found or hashlib.sha256(found[name]).hexdigest() != listed.get(name):
            shown = name if name in found else repr(name)  # others may be any text
            raise ArchiveError(f"{path}: damaged: {shown} does not fit {SUMS}")
        if any(str(folder) in found for folder in PurePosixPath(name).parents):
            raise ArchiveError(f"{path}: damaged: a folder of {name!r} is a file too")
    return found


class _ForeignError(Exception):
    """The name of an entry that `write` does not write."""


def _members(file):
    """Yield (name, bytes) of each file of a tar, checked before it is read."""
    total = os.fstat(file.fileno()).st_size
    while (header := file.read(tarfile.BLOCKSIZE)).strip(b"\0"):
        given = tarfile.TarInfo.frombuf(header, "utf-8", "strict")
        name = given.name.removeprefix(f"{TOP}/")
        try:
            ours = name != given.name and _is_plain(name) and _header(name, given.size) == header
        except ValueError:  # no number or name of this format
            ours = False
        if not ours:
            raise _ForeignError(f"{given.name!r:.100}")
        if given.size > total - file.tell():
            raise tarfile.TarError(f"{given.name!r} says that it has {given.size:,} bytes")
        yield name, file.read(given.size)
        if file.read(-given.size % tarfile.BLOCKSIZE).strip(b"\0"):
            raise tarfile.TarError(f"there are bytes between {given.name!r} and the next file")
    end = file.tell() - len(header) + 2 * tarfile.BLOCKSIZE
    if total != end + -end % tarfile.RECORDSIZE or file.read().strip(b"\0"):
        raise tarfile.TarError("it is cut off, or there are bytes after its end")


def _is_plain(name):
    """Whether a name from outside is that of a file below the folder it is in."""
    return name.isprintable() and not {"", ".", ".."} & {*name.split("/")}


def _header(name, size):
    """The block before a file in an archive; raises ValueError for what does not fit in."""
    entry = tarfile.TarInfo(f"{TOP}/{name}")
    entry.size, entry.mode = size, 0o644
    return entry.tobuf(tarfile.USTAR_FORMAT, "utf-8", "strict")


def _listed(sums):
    """File -> sha256 of the text of an archive's SHA256SUMS."""
    lines = sums.decode("utf-8", "replace").splitlines()
    return dict(reversed(line.split("  ", 1)) for line in lines if "  " in line)


def read_folder(folder, checked):
    """File -> bytes of another tree, or of an archive that was unpacked, as `contents` has them.

    Raises
    ------
    ArchiveError
        A folder that is neither.
    """
    try:
        manifest.read(folder, PUBLISHED[PAPER])
        found = contents(folder, checked)
        # An archive may have files that this tree's config does not name.
        for name in _listed(read_bytes(folder / SUMS)) if (folder / SUMS).is_file() else ():
            if name not in found and _is_plain(name) and (folder / name).is_file():
                found[name] = read_bytes(folder / name)
    except (ChecksumError, FileError) as error:
        what = "no tree of this project, and no archive of it that was unpacked"
        raise ArchiveError(f"{folder} is {what}: {error}") from None
    del found[SUMS]
    return found


def verify(root, checked, place):
    """Compare this tree file by file with an archive, also unpacked, or with another tree.

    Returns
    -------
    int
        0 where all files are there and alike.

    Raises
    ------
    ArchiveError
        Where `place` is none of these.
    """
    folder = place.is_dir()
    theirs = read_folder(place, checked) if folder else read(place)
    absent = f"not in the {'folder' if folder else 'archive'}"
    ours = contents(root, checked)
    del ours[SUMS]
    theirs.pop(ABOUT, None), ours.pop(ABOUT)  # which says what is there
    counts = dict.fromkeys(("identical", "differs", "missing here", absent), 0)
    width = max(map(len, {*ours, *theirs}))
    with tempfile.TemporaryDirectory() as folder:
        how = _differences(root, checked, ours, theirs, Path(folder))
        for name in sorted({*ours, *theirs}):
            word = "identical" if ours.get(name) == theirs.get(name) else "differs"
            word = absent if name not in theirs else "missing here" if name not in ours else word
            counts[word] += 1
            print(f"{name:{width}}  {word}")
            for layer, words in how(name).items() if word == "differs" else ():
                print(f"{'':{width}}  {layer}: {words}".replace(f"{folder}/", "the other "))
    print("", ", ".join(f"{n} {word}" for word, n in counts.items() if n), sep="\n")
    return int(counts["identical"] < len({*ours, *theirs}))


def _differences(root, checked, ours, theirs, folder):
    """A function: file -> layer -> words, by their manifests and by the files themselves.

    What is compared is copied into `folder` under names that this tree knows.
    """
    for name in ours.keys() & theirs.keys():
        if ours[name] != theirs[name] or name.endswith(f"/{manifest.MANIFEST}"):
            files.write_whole(folder / name, theirs[name])
    known = {}
    for published_set in published_sets.committed_sets(checked):
        with suppress(ChecksumError):
            committed = manifest.read(folder, published_set.folder)
            comparison = Comparison(root, published_set, committed, folder)
            known |= {
                f"{published_set.folder}/{name}": (comparison, name) for name in published_set.drawn
            }

    def layers(path):
        comparison, name = known.get(path, (None, None))
        found = (comparison and comparison.layers(name)) or {}
        layer = "data" if path.endswith(".nc") else "drawing"
        try:
            if path.endswith(".nc"):
                described = {path: manifest.describe_data(load(folder / path))}
                alone = Comparison(root, None, {"data": described}, folder)
                return {"data": alone.differing_data(path, path) or "the same in other bytes"}
            if comparison and not {"drawing", "file"} & {*found}:
                image = root / comparison.published_set.results / "differences" / name
                found[layer] = difference(root / path, folder / path, image)[0]
        except (ArtifactError, PictureError, FileError) as error:
            found[layer] = str(error)
        return found

    return layers
