"""What a run would make and why, in words."""

import os

from ...checks.freshness import DAMAGED, MISSING
from ...records.differences import brief, differing_keys
from ...records.record import RecordError, read_record, record_path

NOT_YET = "not made yet"


def plan(freshness, paths) -> list[str]:
    """A line for each scene of the outdated results among `paths`: why, and its stages.

    Stages after `perhaps` are made again only if the data behind them change.
    """
    scenes = {}
    for path in freshness.outdated(paths):
        made = freshness.build_specs[path]
        scenes.setdefault(made.scene, {}).setdefault(made.step.split()[0], []).append(path)
    lines = []
    for scene, stages in scenes.items():
        words = why(freshness, [path for made in stages.values() for path in made])
        certain = [name for name, made in stages.items() if any(map(freshness.own_reason, made))]
        perhaps = [name for name in stages if name not in certain]
        told = [", ".join(certain)] if certain else []
        told += [f"perhaps {', '.join(perhaps)}"] if perhaps else []
        lines.append(f"{scene}: {words}: {'; '.join(told)}")
    return lines or ["nothing to make"]


def why(freshness, paths) -> str:
    """Why some outdated results have to be made again: key, old -> new, or what else differs."""
    own = [path for path in paths if freshness.own_reason(path)]
    causes = dict.fromkeys(_cause(freshness, path) for path in own)
    if len(causes) > 1:
        causes.pop(NOT_YET, None)
    return "; ".join(causes) or freshness.reason(paths[0])


def changes(before, after) -> str:
    """What differs between two blocks of config: `key old -> new` for each key."""
    keys = differing_keys(before, after)
    return ", ".join(f"{key} {brief(old)} -> {brief(new)}" for key, old, new in keys)


def _cause(freshness, path):
    made, words = freshness.build_specs[path], freshness.reason(path)
    if words in (MISSING, DAMAGED):
        return NOT_YET if words == MISSING else f"{path} was {words}"
    try:
        record = read_record(freshness.root, record_path(path))
    except RecordError as error:
        return f"{path}: {error}"
    if told := changes(record["config"], made.config):
        return told
    before, after = record["sources"], {file: freshness.syntax_hash(file) for file in made.sources}
    files = [f for f in sorted({*before, *after}) if before.get(f) != after.get(f)]
    if files:
        more = f" and {len(files) - 1} more" if len(files) > 1 else ""
        return f"its source changed: {os.path.basename(files[0])}{more}"
    return words
