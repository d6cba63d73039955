"""Describe to a user what a run would make and why, and the state of files."""

from collections.abc import Iterable
from pathlib import PurePath

from ..checks.checksums import ChecksumError, read_sums
from ..checks.freshness import FROM_CONFIG, MISSING, Freshness
from ..checks.published_sets import PublishedSet
from ..config.build_specs import with_dependencies
from ..records.differences import differing_block
from ..records.files import file_hash
from ..records.sources import ROOT

NOT_YET = "not made yet"
_MOST_CAUSES = 4  # in a line: the blocks of a sweep may differ each in another way
Row = tuple[str, str, str]  # scene, file, state
IDENTICAL, DIFFERS, NEW = "identical", "differs", "not committed"
_LISTED = {IDENTICAL: "identical to the committed one", DIFFERS: "not the committed one"}


def plan(freshness: Freshness, paths: Iterable[str]) -> list[str]:
    """Return a line for each scene with outdated results: the reasons and the stages to make.

    Stages after `perhaps` are made only if their input data change.
    """
    scenes: dict[str, dict[str, list[str]]] = {}
    for path in freshness.outdated(paths):
        spec = freshness.build_specs[path]
        scenes.setdefault(spec.scene, {}).setdefault(spec.step.split()[0], []).append(path)
    lines = []
    for scene, stages in scenes.items():
        reasons = why(freshness, [path for results in stages.values() for path in results])
        certain = [name for name, made in stages.items() if any(map(freshness.own_reason, made))]
        perhaps = [name for name in stages if name not in certain]
        parts = [", ".join(certain), f"perhaps {', '.join(perhaps)}" if perhaps else ""]
        lines.append(f"{scene}: {reasons}: {'; '.join(filter(None, parts))}")
    return lines or ["nothing to make"]


def why(freshness: Freshness, paths: list[str]) -> str:
    """Say why outdated results must be made."""
    causes = dict.fromkeys(filter(None, map(freshness.own_reason, paths)))
    if len(causes) > 1:
        causes.pop(MISSING, None)
    shown = [NOT_YET if cause == MISSING else cause for cause in [*causes][:_MOST_CAUSES]]
    shown = [cause.removeprefix(f"{FROM_CONFIG} ") for cause in shown]
    more = [f"and {len(causes) - len(shown)} more"] if len(causes) > len(shown) else []
    return "; ".join(shown + more) or str(freshness.reason(paths[0]))


def committed(folder: str, paths: Iterable[str]) -> dict[str, str]:
    """Map each of the paths that lie in a published folder to how it compares with the commit."""
    sums, states = read_sums(ROOT, folder), {}
    for path in (path for path in paths if path.startswith(f"{folder}/")):
        name, digest = path.removeprefix(f"{folder}/"), file_hash(ROOT / path)
        if digest is None:
            states[path] = MISSING
        elif name not in sums:
            states[path] = NEW
        else:
            states[path] = IDENTICAL if digest == sums[name] else DIFFERS
    return states


def staleness(freshness: Freshness, path: str) -> str:
    """Say why a result is outdated, or return an empty text."""
    outdated = freshness.outdated(with_dependencies(freshness.build_specs, [path]))
    return f"stale: {why(freshness, [*outdated])}" if outdated else ""


def states(published_set: PublishedSet) -> list[Row]:
    """State of each file of a published set.

    Whether a file is stale follows from its drawing's record or, without one, from the manifest.
    """
    from ..checks import manifest  # takes long to import

    folder, freshness = published_set.folder, Freshness(ROOT, published_set.build_specs)
    as_committed = committed(folder, [f"{folder}/{name}" for name in published_set.drawn])
    try:
        scenes = manifest.read(ROOT, folder)["scenes"]
    except ChecksumError:
        scenes = {}
    rows = []
    for name, drawing in published_set.drawn.items():
        scene, path, stale = PurePath(name).stem, f"{folder}/{name}", ""
        if file_hash(ROOT / drawing):
            stale = staleness(freshness, drawing)
        elif scene in scenes:
            blocks = scenes[scene]["config"], published_set.config[scene]
            stale = f"stale: {words}" if (words := differing_block(*blocks)) else ""
        state = as_committed[path]
        rows.append(
            (scene, path, stale if stale and state != MISSING else _LISTED.get(state, state))
        )
    return rows
