"""./reproduce accept: make the published files as they are now the committed ones."""

import hashlib
from collections.abc import Iterator
from pathlib import Path

from ...checks import manifest
from ...checks.layers import UPSTREAM
from ...checks.published_sets import MANIFEST, SUMS, committed_sets, is_left_over
from ...checks.verify import Findings
from ...config import Config
from ...records.files import file_hash, write_whole
from ...records.sources import ROOT
from ..arguments import Arguments
from ..lock import locked
from ..running import interruptible


def run(args: Arguments) -> int:
    """Renew the manifests, and print what changed."""
    with locked(), interruptible():
        return accept(ROOT, args.config)


def accept(root: Path, config: Config) -> int:
    """Renew the manifests of the paper and of other published sets that have results here.

    Pictures that no scene makes any more are removed if this tree published them and git does not
    track them. Returns the exit status, which is 1 if a result of the paper is missing or not
    current.
    """
    for published_set in committed_sets(config):
        results, command = published_set.build_specs, published_set.command
        if published_set.on_request and not any((root / path).exists() for path in results):
            continue
        findings = Findings(root, published_set)
        print(*findings.left_out, sep="\n", end="\n" * bool(findings.left_out))
        problem = findings.not_published(root)
        if problem is None:
            _remove_left_over(root, findings)
            _renew(root, findings)
        elif published_set.on_request:
            print(f"{published_set.folder} stays as it is: {problem}: run {command} first")
        else:
            print(f"reproduce accept: {problem}: run {command} first")
            return 1
    return 0


def _remove_left_over(root: Path, findings: Findings) -> None:
    """Remove pictures that this tree published, that no scene makes and git does not track."""
    for path in [*findings.unlisted]:
        if is_left_over(root, findings.published_set.group, Path(path).name):
            (root / path).unlink()
            findings.problems.remove(findings.unlisted.pop(path))
            print(f"{path}: removed: no scene makes it")


def _renew(root: Path, findings: Findings) -> None:
    """Write the manifest and checksum list of a set, and print what changed."""
    published_set, folder = findings.published_set, findings.published_set.folder
    texts = manifest.files_of(manifest.build(root, published_set))
    files = {root / folder / name: text.encode() for name, text in texts.items()}
    if all(file_hash(file) == hashlib.sha256(text).hexdigest() for file, text in files.items()):
        print(f"{folder}: nothing changed", *findings.unlisted.values(), sep="\n")
        return
    changes = [*_changes(findings), *findings.unlisted.values()] or findings.problems
    for file, text in files.items():
        write_whole(file, text)
    print(*(changes or ["other changes behind the same pictures"]), sep="\n")
    print(f"{folder}/{SUMS} and {folder}/{MANIFEST} renewed: {len(published_set.drawn)} figures")


def _changes(findings: Findings) -> Iterator[str]:
    """Yield a line for each difference of a set from its manifest."""
    if findings.committed is None:
        yield f"a new manifest ({findings.problems[-1]})"
        return
    for name, layers in findings.layers.items():
        if layers is None:
            yield f"{name}  new"
            continue
        yield from (f"{name}  {layer}: {words}" for layer, words in layers.items())
        if layers and layers.keys() <= UPSTREAM:
            yield f"{name}  the file is the same"
    drawn = findings.published_set.drawn
    yield from (f"{n}  gone" for n in manifest.published(findings.committed) if n not in drawn)
