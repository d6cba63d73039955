"""How published files stand to the committed ones and to what this tree would make."""

from ...checks.checksums import ChecksumError, known_sums
from ...checks.freshness import MISSING, Freshness
from ...records.files import file_hash
from ...records.sources import ROOT
from .plan import changes, why

IDENTICAL, DIFFERS, NEW = "identical", "differs", "not committed"
_LISTED = {IDENTICAL: "identical to the committed one", DIFFERS: "not the committed one"}


def committed(folder, paths) -> dict[str, str]:
    """Each of the files in the folder of a contract -> whether it is the committed one."""
    sums, found = known_sums(ROOT, folder), {}
    for path in (path for path in paths if path.startswith(f"{folder}/")):
        name, digest = path.removeprefix(f"{folder}/"), file_hash(ROOT / path)
        same = IDENTICAL if digest == sums.get(name) else DIFFERS
        found[path] = MISSING if digest is None else same if name in sums else NEW
    return found


def states(published_set) -> list[tuple[str, str, str]]:
    """(scene, file, state) of each file of a contract.

    What is stale is told by the record of its drawing, and where there is none by the manifest.
    """
    from ...checks import manifest  # takes a while

    freshness, files = Freshness(ROOT, published_set.build_specs), published_set.drawn
    as_committed = committed(
        published_set.folder, [f"{published_set.folder}/{name}" for name in files]
    )
    try:
        scenes = manifest.read(ROOT, published_set.folder)["scenes"]
    except ChecksumError:
        scenes = {}
    rows = []
    for name, drawing in published_set.drawn.items():
        scene, path = published_set.scenes[name], f"{published_set.folder}/{name}"
        state, stale = as_committed[path], None
        if file_hash(ROOT / drawing):
            outdated = list(freshness.outdated([*published_set.data[scene].values(), drawing]))
            stale = why(freshness, outdated) if outdated else None
        elif scene in scenes:
            stale = changes(scenes[scene]["config"], published_set.config[scene])
        told = f"stale: {stale}" if stale and state != MISSING else _LISTED.get(state, state)
        rows.append((scene, path, told))
    return rows
