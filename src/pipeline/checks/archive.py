"""One tar with what this tree publishes and what that was made from; and a tree against such a tar.

The same files give the same bytes: names in order, no times, no owners, one mode, no compression.
"""

import hashlib
import io
import json
import tarfile
import tempfile
from pathlib import Path

from ..config.places import LEDGER
from ..records.files import file_hash, replacing
from ..records.record import SHAPE, read_record, record_path
from . import contracts, manifest
from .currency import MISSING, Currency
from .difference import Comparison
from .sums import SUMS, ContractError, known_sums, read_sums

TOP = "pseudorigid"  # the folder in the tar
ABOUT = "README.txt"
CERTIFICATES = "src/pseudorigid/proofs/certificates"
README = """\
Figures of E. Kanso and P. Papadopoulos, "Dynamics of pseudo-rigid ball impact on rigid foundation",
computed again by pseudorigid, and what they were made from.

  paper_figures/, more_figures/  the figures; beside them SHA256SUMS and MANIFEST.json, with hashes
                                 of config, sources, packages, data, drawing and file
  results/*/*.nc                 data, netCDF-4; each variable says what it is
  results/*/provenance/          what made each file: config, hashes of sources and inputs, packages
  config.yaml                    every parameter of every figure
  CLAIMS.md                      every statement of the paper, with a verdict
  {certificates}
                                 certificates of the theorems that are proved

To check that nothing was damaged, here:

    sha256sum -c SHA256SUMS

To check that it can be made again, in a clone of pseudorigid, after ./reproduce:

    ./reproduce verify --against THIS_FILE.tar

Data in here: {sets}.
"""


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
    if path.is_dir():
        raise ArchiveError(f"{path} is a folder")
    if path.exists():  # another archive may be replaced, anything else is the user's
        read(path)
    for contract in contracts.committed(checked):
        if problem := _problem(root, contract):
            raise ArchiveError(problem)
    files = contents(root, checked)
    with replacing(path) as part, tarfile.open(part, "w", format=tarfile.USTAR_FORMAT) as tar:
        for name, data in files.items():
            entry = tarfile.TarInfo(f"{TOP}/{name}")
            entry.size, entry.mode = len(data), 0o644
            tar.addfile(entry, io.BytesIO(data))
    return file_hash(path)


def contents(root, checked):
    """File -> bytes of all that an archive of this tree has, as far as it is there."""
    found, sets = {}, []
    places = ["config.yaml", "LICENSE", "CITATION.cff", LEDGER]
    places += [str(f.relative_to(root)) for f in (root / CERTIFICATES).glob("*.toml")]
    for contract in contracts.committed(checked):
        if not manifest.there(root, contract):
            continue
        names = [*known_sums(root, contract.folder), SUMS, manifest.MANIFEST]
        places += [f"{contract.folder}/{name}" for name in names]
        data = sorted({path for stages in contract.data.values() for path in stages.values()})
        there = [path for path in data if (root / path).is_file()]
        sets += [f"{len(there)} of {len(data)} datasets of {contract.command}"]
        places += there
        for path in (*there, *contract.drawn.values()):
            if (root / path).is_file():
                found[record_path(path)] = _public_record(root, path)
    for path in places:
        if (root / path).is_file():
            found[path] = (root / path).read_bytes()
    about = README.format(certificates=CERTIFICATES, sets=", ".join(sets))
    found[ABOUT] = about.encode()
    lines = [f"{hashlib.sha256(found[path]).hexdigest()}  {path}\n" for path in sorted(found)]
    return dict(sorted(found.items())) | {SUMS: "".join(lines).encode()}


def _public_record(root, path):
    """The record of a result without what is of one run and machine: commit and Python."""
    try:
        record = read_record(root, path)
    except ValueError:
        return b""
    kept = {name: record[name] for name in SHAPE}
    return (json.dumps(kept, sort_keys=True, indent=1) + "\n").encode()


def _problem(root, contract):
    """Why a contract's files cannot be archived, in a line with what to run, or None."""
    if contract.on_request and not manifest.there(root, contract):
        return None
    try:
        committed = manifest.read(root, contract.folder)
        sums = read_sums(root, contract.folder)
    except ContractError as error:
        return f"{error}: run ./reproduce accept"
    for path, why in Currency(root, contract.expected).outdated().items():
        if why != MISSING:
            return f"{path}: {why}: run {contract.command}"
        if not contract.on_request:
            return f"{path} is missing: run {contract.command}"
    for name in sorted({*contract.drawn, *sums}):
        path = f"{contract.folder}/{name}"
        drawn = file_hash(root / contract.drawn.get(name, path))
        if file_hash(root / path) is None or drawn not in (None, file_hash(root / path)):
            return f"{path} is not the one that was drawn: run {contract.command}"
        if file_hash(root / path) != sums.get(name):
            return f"{path} is not as in {contract.folder}/{SUMS}: run ./reproduce accept"
    for path, digest in committed.get("texts", {}).items():
        if file_hash(root / path) != digest:
            return (
                f"{path} is not as in {contract.folder}/{manifest.MANIFEST}: run {contract.command}"
            )
    return None


def read(path):
    """File -> bytes of an archive, each checked by its sum; raises ArchiveError."""
    found = {}
    try:
        with tarfile.open(path, "r:") as tar:
            for entry in tar:
                inside = entry.isfile() and entry.name.removeprefix(f"{TOP}/") != entry.name
                if not inside or ".." in Path(entry.name).parts:
                    raise ArchiveError(f"{path}: not made by ./reproduce archive: {entry.name}")
                found[entry.name.removeprefix(f"{TOP}/")] = tar.extractfile(entry).read()
    except (tarfile.TarError, OSError, EOFError) as error:
        raise ArchiveError(f"{path}: no archive, or damaged: {error}") from None
    if SUMS not in found:
        raise ArchiveError(f"{path}: not made by ./reproduce archive, or damaged: no {SUMS}")
    sums = found.pop(SUMS).decode("utf-8", "replace").splitlines()
    listed = dict(reversed(line.split("  ", 1)) for line in sums if "  " in line)
    for name in sorted({*listed, *found}):
        if name not in found or hashlib.sha256(found[name]).hexdigest() != listed.get(name):
            raise ArchiveError(f"{path}: damaged: {name} does not fit {SUMS}")
    return found


def verify(root, checked, path):
    """Print of each file of this tree and of the archive at `path` how they compare; 0 if alike."""
    theirs = read(path)
    ours = contents(root, checked)
    del ours[SUMS]
    theirs.pop(ABOUT, None), ours.pop(ABOUT)  # which says what is there
    counts = {"identical": 0, "differs": 0, "missing here": 0, "not in the archive": 0}
    width = max(map(len, {*ours, *theirs}))
    with tempfile.TemporaryDirectory() as folder:
        layers = _layers(root, checked, theirs, Path(folder))
        for name in sorted({*ours, *theirs}):
            if name not in theirs:
                word = "not in the archive"
            elif name not in ours:
                word = "missing here"
            else:
                word = "identical" if ours[name] == theirs[name] else "differs"
            counts[word] += 1
            print(f"{name:{width}}  {word}")
            for layer, words in (layers(name) or {}).items() if word == "differs" else ():
                print(f"{'':{width}}  {layer}: {words}".replace(f"{folder}/", ""))
    print("", ", ".join(f"{n} {word}" for word, n in counts.items() if n), sep="\n")
    return int(counts["identical"] < len({*ours, *theirs}))


def _layers(root, checked, theirs, folder):
    """Published file -> the layers that differ, named by the archive's own manifests."""
    for name, data in theirs.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(data)
    known = {}
    for contract in contracts.committed(checked):
        try:
            committed = manifest.read(folder, contract.folder)
        except ContractError:
            continue
        comparison = Comparison(root, contract, committed, folder)
        known |= {f"{contract.folder}/{name}": (comparison, name) for name in contract.drawn}

    def layers(path):
        comparison, name = known.get(path, (None, None))
        return comparison and comparison.layers(name)

    return layers
