"""Describe what a run would make and why."""

import os
from collections.abc import Iterable
from typing import Any

from ...checks.freshness import DAMAGED, MISSING, Freshness
from ...records.differences import brief, differing_keys
from ...records.record import RecordError, read_record, record_path

NOT_YET = "not made yet"


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
        parts = [", ".join(certain)] if certain else []
        parts += [f"perhaps {', '.join(perhaps)}"] if perhaps else []
        lines.append(f"{scene}: {reasons}: {'; '.join(parts)}")
    return lines or ["nothing to make"]


def why(freshness: Freshness, paths: list[str]) -> str:
    """Say why outdated results must be made: key, old -> new, or what else differs."""
    own = [path for path in paths if freshness.own_reason(path)]
    causes = dict.fromkeys(_cause(freshness, path) for path in own)
    if len(causes) > 1:
        causes.pop(NOT_YET, None)
    return "; ".join(causes) or str(freshness.reason(paths[0]))


def changes(before: dict[str, Any], after: dict[str, Any]) -> str:
    """Say which keys of two blocks of config differ: `key old -> new` for each."""
    keys = differing_keys(before, after)
    return ", ".join(f"{key} {brief(old)} -> {brief(new)}" for key, old, new in keys)


def _cause(freshness: Freshness, path: str) -> str:
    spec, reason = freshness.build_specs[path], str(freshness.reason(path))
    if reason == MISSING:
        return NOT_YET
    if reason == DAMAGED:
        return f"{path} was {reason}"
    try:
        record = read_record(freshness.root, record_path(path))
    except RecordError as error:
        return f"{path}: {error}"
    if changed_keys := changes(record["config"], spec.config):
        return changed_keys
    before, after = record["sources"], {file: freshness.syntax_hash(file) for file in spec.sources}
    files = [f for f in sorted({*before, *after}) if before.get(f) != after.get(f)]
    if files:
        others = f" and {len(files) - 1} more" if len(files) > 1 else ""
        return f"its source changed: {os.path.basename(files[0])}{others}"
    return reason
