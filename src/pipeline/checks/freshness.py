"""Which results differ from what this tree would make. Records decide that, never times."""

from collections.abc import Iterable
from functools import cache
from pathlib import Path
from typing import Any

from ..config.results import with_dependencies
from ..records.build_spec import BuildSpec
from ..records.differences import differing_layers
from ..records.files import file_hash, why_not_a_file
from ..records.record import RecordError, read_record, record_path, refusal_path, versions
from ..records.sources import syntax_hash

CURRENT = "current"
MISSING = "missing"
REFUSED = "cannot exist: "  # how the reason begins then
_FROM_CONFIG = "made from another config:"
# Differing layer -> the beginning of the reason to recompute a result, the first reason first.
_MADE = {
    "file": "",
    "config": f"{_FROM_CONFIG} ",
    "source": "made by other code than this tree's: ",
    "environment": "made with ",
    "data": "made from another ",
}
_MOST_CAUSES = 4  # in one line


class Freshness:
    """Tells which results of a tree have to be recomputed, and why.

    Three cached methods take a result, and return None if there is no such reason:

    - `reason(path)`: why it has to be recomputed (MISSING if it is not there)
    - `direct_reason(path)`: why it has to be recomputed even if its inputs keep their bytes
    - `refusal(path)`: why it cannot exist
    """

    def __init__(self, root: Path, build_specs: dict[str, BuildSpec]) -> None:
        self.root, self.build_specs = root, build_specs
        self.digest = cache(lambda path: file_hash(root / path))
        self.syntax_hash = cache(lambda path: syntax_hash(root / path))
        self.packages = versions()
        self.direct_reason = cache(self._direct_reason)
        self.reason = cache(self._reason)
        self.refusal = cache(self._refusal)

    def is_current_now(self, path: str) -> bool:
        """Read files afresh, and return whether a result with current inputs is current."""
        return Freshness(self.root, self.build_specs).direct_reason(path) is None

    def outdated(self, paths: Iterable[str] | None = None) -> dict[str, str]:
        """Map each result in `paths` (default: all) that has to be recomputed to the reason."""
        results = self.build_specs if paths is None else paths
        return {path: why for path in results if (why := self.reason(path))}

    def state(self, path: str) -> str:
        """Say whether a result is current, missing, stale and why, or cannot exist and why."""
        reason = self.reason(path) or CURRENT
        if reason in (CURRENT, MISSING) or self.refusal(path):
            return reason
        return f"stale: {self._why(self.outdated(with_dependencies(self.build_specs, [path])))}"

    def plan(self, paths: Iterable[str]) -> list[str]:
        """Return a line for each scene with outdated results: the reasons and the stages to make.

        Stages after `perhaps` are made only if their input data change.
        """
        scenes: dict[str, dict[str, list[str]]] = {}
        for path in self.outdated(paths):
            spec = self.build_specs[path]
            scenes.setdefault(spec.scene, {}).setdefault(spec.step.split()[0], []).append(path)
        lines = []
        for scene, stages in scenes.items():
            reasons = self._why([path for results in stages.values() for path in results])
            certain = [name for name, made in stages.items() if any(map(self.direct_reason, made))]
            perhaps = [name for name in stages if name not in certain]
            parts = [", ".join(certain), f"perhaps {', '.join(perhaps)}" if perhaps else ""]
            lines.append(f"{scene}: {reasons}: {'; '.join(filter(None, parts))}")
        return lines or ["nothing to make"]

    def _why(self, paths: Iterable[str]) -> str:
        """Join the reasons of outdated results, without those that follow from others."""
        paths = list(paths)
        causes = dict.fromkeys(filter(None, map(self.direct_reason, paths)))
        if len(causes) > 1:
            causes.pop(MISSING, None)
        shown = ["not made yet" if cause == MISSING else cause for cause in causes][:_MOST_CAUSES]
        shown = [cause.removeprefix(f"{_FROM_CONFIG} ") for cause in shown]
        more = [f"and {len(causes) - len(shown)} more"] if len(causes) > len(shown) else []
        return "; ".join(shown + more) or str(self.reason(paths[0]))

    def _refusal(self, path: str) -> str | None:
        for used in self.build_specs[path].inputs:
            if used in self.build_specs and (why := self.refusal(used)):
                return why
        try:
            record = read_record(self.root, refusal_path(path))
        except RecordError:
            return None
        refused, here = record["output"], self.here(path)
        return (
            None if _difference(record, here | {"output": refused}) else str(refused.get("refused"))
        )

    def _reason(self, path: str) -> str | None:
        if why := self.refusal(path):
            return REFUSED + why
        if why := self.direct_reason(path):
            return why
        for used in self.build_specs[path].inputs:
            if used in self.build_specs and (why := self.reason(used)):
                return f"made from {used}, which is {MISSING if why == MISSING else 'not current'}"
        return None

    def _direct_reason(self, path: str) -> str | None:
        if self.digest(path) is None:
            return why_not_a_file(self.root / path) or MISSING
        try:
            record = read_record(self.root, record_path(path))
        except RecordError as error:
            return str(error)
        # What was made another way, to the same bytes, says which further sources that has.
        here, way = self.here(path), record["output"].get("way", {})
        now = {"sources": here["sources"] | {file: self.syntax_hash(file) for file in way}}
        return _difference(record | {"sources": record["sources"] | way}, here | now)

    def here(self, path: str) -> dict[str, Any]:
        """Return the record that this tree would write of a result, for the file that is there."""
        spec = self.build_specs[path]
        return {
            "config": spec.config,
            "sources": {file: self.syntax_hash(file) for file in spec.sources},
            "environment": self.packages,
            "inputs": {used: self.digest(used) for used in spec.inputs},
            "output": {"sha256": self.digest(path)},
        }


def _difference(record: dict[str, Any], here: dict[str, Any]) -> str | None:
    """Return the first reason why a record is not the one that this tree would write."""
    layers = differing_layers(record, here)
    return next((begin + layers[name] for name, begin in _MADE.items() if name in layers), None)
