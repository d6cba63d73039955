"""Make what is here the committed state: renew the contracts from complete and current results."""

import shutil

from ..records.files import file_hash, obstacle, replacing
from . import manifest, published_sets
from .checksums import SUMS, ChecksumError, read_sums, unlisted_files
from .difference import UPSTREAM, Comparison, not_as_made
from .freshness import MISSING


def accept(root, checked):
    """Renew the contract of the paper, and those of other results that are here.

    Charts that are measured are published too, without a contract. 1 is returned where the
    results of the paper are not all there and current.
    """
    for published_set in published_sets.committed_sets(checked):
        if published_set.on_request and not any(
            (root / p).exists() for p in published_set.build_specs
        ):
            continue
        problem = _not_ready(root, published_set)
        if problem is None:
            _publish_measured(root, published_set)
            _renew(root, published_set)
        elif published_set.on_request:
            command = published_set.command
            print(f"{published_set.folder} stays as it is: {problem}: run {command} first")
        else:
            print(f"reproduce accept: {problem}: run {published_set.command} first")
            return 1
    return 0


def _not_ready(root, published_set):
    """Why the results cannot be accepted, or None."""
    for path, why in not_as_made(root, published_set).items():
        return f"{path} is missing" if why == MISSING else f"{path}: {why}"
    for name, drawing in published_set.drawn.items():
        if words := obstacle(root / published_set.folder / name):
            return f"{published_set.folder}/{name}: {words}"
        if file_hash(root / published_set.folder / name) != file_hash(root / drawing):
            return f"{published_set.folder}/{name} is not {drawing}"
    return None


def _publish_measured(root, published_set):
    for name in published_set.measured:
        drawing = root / published_set.results / "figures" / name
        if drawing.is_file():
            with replacing(root / published_set.folder / name) as part:
                shutil.copyfile(drawing, part)


def _renew(root, published_set):
    folder = published_set.folder
    try:
        committed = manifest.read(root, folder)
        sums = read_sums(root, folder)
    except ChecksumError as error:
        committed = sums = None
        changes = [f"a new contract ({error})"]
    else:
        changes = _changes(Comparison(root, published_set, committed), published_set, committed)
    fresh = manifest.build(root, published_set)
    if fresh == committed and sums == manifest.sums(fresh):
        print(f"{folder}: nothing changed")
        return
    manifest.write(root, folder, fresh)
    print(*(changes or [f"other changes behind the same {published_set.what}"]), sep="\n")
    renewed = f"{folder}/{SUMS} and {folder}/{manifest.MANIFEST} renewed"
    print(f"{renewed}: {len(published_set.drawn)} {published_set.what}")


def _changes(comparison, published_set, committed):
    changes = []
    for name in published_set.drawn:
        layers = comparison.layers(name)
        if layers is None:
            changes.append(f"{name}  new")
            continue
        changes += [f"{name}  {layer}: {words}" for layer, words in layers.items()]
        if layers and set(layers) <= UPSTREAM:
            changes.append(f"{name}  the file is the same")
    gone = sorted(set(manifest.figures(committed)) - set(published_set.drawn))
    left = unlisted_files(
        comparison.root, published_set.folder, {*published_set.drawn, *published_set.measured}
    )
    return changes + [f"{name}  gone" for name in gone] + left
