"""./reproduce accept: make the published files as they are now the committed ones."""

from pathlib import Path

from ...checks import manifest
from ...checks.layers import UPSTREAM
from ...checks.published_sets import (
    MANIFEST,
    SUMS,
    ChecksumError,
    committed_sets,
    read_published_text,
)
from ...checks.verify import Findings, inspect
from ...config import Config
from ...records.files import read_bytes, write_whole
from ...records.sources import ROOT
from ..arguments import Arguments
from ..session import interruptible, locked


def run(args: Arguments) -> int:
    """Renew the manifests, and print what changed."""
    with locked(), interruptible():
        return accept(ROOT, args.config)


def accept(root: Path, config: Config) -> int:
    """Renew the manifests of the paper and of other published sets that have results here.

    Measured charts are published too, without a checksum. Returns the exit status, which is 1 if a
    result of the paper is missing or not current.
    """
    for published_set in committed_sets(config):
        results, command = published_set.build_specs, published_set.command
        if published_set.on_request and not any((root / path).exists() for path in results):
            continue
        findings = inspect(root, published_set)
        print(*findings.left_out, sep="\n", end="\n" * bool(findings.left_out))
        problem = findings.not_published(root)
        if problem is None:
            for name in published_set.measured:
                drawing = root / published_set.results / "figures" / name
                if drawing.is_file():
                    write_whole(root / published_set.folder / name, read_bytes(drawing))
            _renew(root, findings)
        elif published_set.on_request:
            print(f"{published_set.folder} stays as it is: {problem}: run {command} first")
        else:
            print(f"reproduce accept: {problem}: run {command} first")
            return 1
    return 0


def _renew(root: Path, findings: Findings) -> None:
    """Write the manifest and checksum list of a set, and print what changed."""
    published_set = findings.published_set
    folder = published_set.folder
    fresh = manifest.build(root, published_set)
    try:
        committed = manifest.read(root, folder)
        listed = read_published_text(root, f"{folder}/{SUMS}")
    except ChecksumError as error:
        changes = [f"a new manifest ({error})"]
    else:
        if fresh == committed and listed == manifest.sums(fresh):
            print(f"{folder}: nothing changed", *published_set.unlisted(root), sep="\n")
            return
        changes = _changes(root, findings, committed) or ["other changes behind the same pictures"]
    manifest.write(root, folder, fresh)
    print(*changes, sep="\n")
    files = f"{folder}/{SUMS} and {folder}/{MANIFEST}"
    print(f"{files} renewed: {len(published_set.drawn)} figures")


def _changes(root: Path, findings: Findings, committed: manifest.Manifest) -> list[str]:
    """Return a line for each difference of a set from its manifest."""
    changes = []
    for name, layers in findings.layers.items():
        if layers is None:
            changes.append(f"{name}  new")
            continue
        changes += [f"{name}  {layer}: {words}" for layer, words in layers.items()]
        if layers and set(layers) <= UPSTREAM:
            changes.append(f"{name}  the file is the same")
    drawn = findings.published_set.drawn
    gone = [f"{name}  gone" for name in manifest.published(committed) if name not in drawn]
    return changes + gone + findings.published_set.unlisted(root)
