"""Compare published files with the committed ones and with what this tree would make."""

from collections.abc import Iterable

from ...checks.checksums import ChecksumError, known_sums
from ...checks.freshness import MISSING, Freshness
from ...checks.published_sets import PublishedSet
from ...records.files import file_hash
from ...records.sources import ROOT
from .plan import changes, why

Row = tuple[str, str, str]  # scene, file, state
IDENTICAL, DIFFERS, NEW = "identical", "differs", "not committed"
_LISTED = {IDENTICAL: "identical to the committed one", DIFFERS: "not the committed one"}


def committed(folder: str, paths: Iterable[str]) -> dict[str, str]:
    """Map each of the paths that lie in a published folder to how it compares with the commit."""
    sums, states = known_sums(ROOT, folder), {}
    for path in (path for path in paths if path.startswith(f"{folder}/")):
        name, digest = path.removeprefix(f"{folder}/"), file_hash(ROOT / path)
        if digest is None:
            states[path] = MISSING
        elif name not in sums:
            states[path] = NEW
        else:
            states[path] = IDENTICAL if digest == sums[name] else DIFFERS
    return states


def states(published_set: PublishedSet) -> list[Row]:
    """State of each file of a published set.

    Whether a file is stale follows from its drawing's record or, without one, from the manifest.
    """
    from ...checks import manifest  # takes long to import

    folder, freshness = published_set.folder, Freshness(ROOT, published_set.build_specs)
    as_committed = committed(folder, [f"{folder}/{name}" for name in published_set.drawn])
    try:
        scenes = manifest.read(ROOT, folder)["scenes"]
    except ChecksumError:
        scenes = {}
    rows = []
    for name, drawing in published_set.drawn.items():
        scene, path = published_set.scenes[name], f"{folder}/{name}"
        state, stale = as_committed[path], None
        if file_hash(ROOT / drawing):
            outdated = list(freshness.outdated([*published_set.data[scene].values(), drawing]))
            stale = why(freshness, outdated) if outdated else None
        elif scene in scenes:
            stale = changes(scenes[scene]["config"], published_set.config[scene])
        text = f"stale: {stale}" if stale and state != MISSING else _LISTED.get(state, state)
        rows.append((scene, path, text))
    return rows
