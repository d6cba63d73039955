"""How a published file differs from the committed one, layer by layer.

Config, source and environment decide the data; these decide the drawing; the drawing decides the
file. The first layer that differs is the cause of differences in the layers after it.
"""

import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ..config.build_specs import with_dependencies
from ..records.artifacts import ArtifactError, canonical_values, load
from ..records.differences import (
    differing_block,
    differing_files,
    differing_keys,
    differing_package,
)
from ..records.files import FileError, file_hash, obstacle
from ..records.pictures import PictureError, describe, difference
from ..records.record import git, versions
from ..records.sources import syntax_hash
from . import manifest
from .checksums import ChecksumError
from .freshness import Freshness
from .published_sets import PublishedSet

# A difference in these layers alone does not change the committed bytes.
UPSTREAM = {"config", "source", "environment"}
UNEXPLAINED = (
    "differs from the committed one, although its config, sources and packages do not: delete it"
)


def not_as_made(
    root: Path, published_set: PublishedSet, comparison: "Comparison | None" = None
) -> dict[str, str]:
    """Return result -> why, for the results of a set that are not what this tree makes.

    A result's record decides. If the manifest lists the result and all that makes it is as
    committed, the result must be the committed one too, whatever its record says. Without
    `comparison` the committed manifest is read.
    """
    reasons = Freshness(root, published_set.build_specs).outdated()
    if comparison is None:
        try:
            comparison = Comparison(root, published_set, manifest.read(root, published_set.folder))
        except ChecksumError:
            return reasons
    reasons = comparison.unexplained() | reasons
    for path, spec in published_set.build_specs.items():  # inputs come before results
        for used in spec.inputs:
            if used in reasons:
                reasons.setdefault(path, f"made from {used}, which is not current")
    return reasons


class Comparison:
    """A tree's published set, to be compared with the manifest `committed`.

    `other_tree` is a folder with a second copy of the tree. It serves to say how large a
    difference is. `differing_data(path, committed_name)` is cached: it describes the first
    difference between a dataset and the manifest, or returns None.
    """

    def __init__(
        self,
        root: Path,
        published_set: PublishedSet,
        committed: manifest.Manifest,
        other_tree: Path | None = None,
    ) -> None:
        self.root, self.published_set, self.committed = root, published_set, committed
        self.other_tree = other_tree
        self.versions = versions()
        self.file_hash: Callable[[str], str | None] = cache(lambda path: file_hash(root / path))
        self.differing_data = cache(
            lambda path, name: dataset_difference(root, path, committed["data"][name], other_tree)
        )

    def layers(self, name: str) -> dict[str, str] | None:
        """Return differing layer -> words, the cause first; None if the manifest lacks the file."""
        scene = self.published_set.scenes[name]
        entry = self.committed["scenes"].get(scene)
        if entry is None or name not in entry["figures"]:
            return None
        sources = {path: self.committed["sources"].get(path) for path in entry["sources"]}
        here = {path: syntax_hash(self.root / path) for path in self.published_set.sources(scene)}
        blocks, was = (entry["config"], self.published_set.config[scene]), "in the manifest"
        data = (
            self._dataset_difference(stage, path, entry)
            for stage, path in self.published_set.data[scene].items()
        )
        layers = {
            "config": differing_block(*blocks, was, "in config.yaml"),
            "source": differing_files(sources, here),
            "environment": differing_package(self.committed["environment"], self.versions, was),
            "data": next(filter(None, data), None),
        } | self._drawing_or_file(name, entry["figures"][name])
        return {layer: words for layer, words in layers.items() if words}

    def _dataset_difference(self, stage: str, path: str, entry: dict[str, Any]) -> str | None:
        """Describe how a stage's dataset differs from the committed one, if both are there."""
        if entry["data"].get(stage) in self.committed["data"] and self.file_hash(path):
            return self.differing_data(path, entry["data"][stage])
        return None

    def _drawing_or_file(self, name: str, entry: dict[str, Any]) -> dict[str, str]:
        """Return the layer drawing or file, if it differs in the published file or in results."""
        published, drawn = f"{self.published_set.folder}/{name}", self.published_set.drawn[name]
        if self.file_hash(published) is None:
            why = obstacle(self.root / published)
            missing = f"{published} is missing: {self.published_set.command} makes it"
            return {"file": f"{published}: {why}" if why else missing}
        encoding: dict[str, str] = {}
        for path in (published, drawn):
            if self.file_hash(path) in (entry["sha256"], None):
                continue
            try:
                if describe(self.root / path) == entry["drawing"]:
                    encoding = encoding or {"file": f"{path}: the same picture in other bytes"}
                    continue
                reference = drawn if path == published else published
                return {"drawing": f"{path}: {self._how_drawn(path, name, entry, reference)}"}
            except PictureError as error:
                return {"drawing": str(error).replace(f"{self.root}/", "")}
        return encoding

    def _how_drawn(self, path: str, name: str, entry: dict[str, Any], reference: str) -> str:
        """Describe how a picture differs from the committed one, if a copy of that is found."""
        with tempfile.TemporaryDirectory() as folder:
            candidates = [self.root / reference]
            blob = git("show", f"HEAD:./{self.published_set.folder}/{name}", root=self.root)
            if blob is not None:
                candidates.append(Path(folder) / name)
                candidates[-1].write_bytes(blob)
            if self.other_tree is not None:
                drawing = self.published_set.drawn[name]
                candidates += [
                    self.other_tree / self.published_set.folder / name,
                    self.other_tree / drawing,
                ]
            for candidate in candidates:
                if file_hash(candidate) == entry["sha256"]:
                    image = f"{self.published_set.results}/differences/{name}"
                    try:
                        words, saved = difference(self.root / path, candidate, self.root / image)
                    except FileError:
                        return "another picture"  # and no place to show where it differs
                    return f"{words}: see {image}" if saved else words
        return "another picture; no copy of the committed one is at hand to count what differs"

    def unexplained(self) -> dict[str, str]:
        """Return result -> words, if it differs from the committed one and nothing explains that.

        Its record may say that this tree made it. That record is false.
        """
        results = []
        for name, drawing in self.published_set.drawn.items():
            scene = self.published_set.scenes[name]
            entry = self.committed["scenes"].get(scene, {"data": {}, "figures": {}})
            stages = self.published_set.data[scene].items()
            different = [
                path for stage, path in stages if self._dataset_difference(stage, path, entry)
            ]
            figure = entry["figures"].get(name)
            if figure and self.file_hash(drawing) not in (None, figure["sha256"]):
                different.append(drawing)
            results += [path for path in different if not self._explained(path, scene, entry)]
        return dict.fromkeys(results, UNEXPLAINED)

    def _explained(self, path: str, scene: str, entry: dict[str, Any]) -> bool:
        """Return whether what makes a result may differ from what made the committed one."""
        build_specs = self.published_set.build_specs
        specs = [build_specs[each] for each in with_dependencies(build_specs, [path])]
        keys = {key for spec in specs for key in spec.config}
        before, after = (
            {key: block[key] for key in keys & {*block}}
            for block in (entry["config"], self.published_set.config[scene])
        )
        return bool(
            any(used not in build_specs for spec in specs for used in spec.inputs)
            or differing_package(self.committed["environment"], self.versions)
            or differing_block(before, after)
            or any(
                syntax_hash(self.root / file) != self.committed["sources"].get(file)
                for spec in specs
                for file in spec.sources
            )
        )


def dataset_difference(
    root: Path, path: str, before: dict[str, Any], other_tree: Path | None
) -> str | None:
    """Describe the first difference between a dataset and its description, or return None.

    `before` is a description by `manifest.describe_data`. The dataset of the same path in
    `other_tree` serves to say how large a difference is.
    """
    try:
        dataset = load(root / path)
    except ArtifactError as error:
        return str(error).replace(f"{root}/", "")
    after = manifest.describe_data(dataset)
    for name in sorted({*before["variables"], *after["variables"]}):
        old, new = before["variables"].get(name), after["variables"].get(name)
        if old is None or new is None:
            return f"{path}: variable {name} is {'new' if old is None else 'gone'}"
        for what in ("dims", "dtype", "shape", "attributes"):
            if old[what] != new[what]:
                words = "" if what == "attributes" else f": {old[what]} then, {new[what]} now"
                return f"{path}: variable {name}: another {what.removesuffix('s')}{words}"
        if old["sha256"] != new["sha256"]:
            pairs = zip(old["blocks"].split(), new["blocks"].split(), strict=False)
            block = next((i for i, (a, b) in enumerate(pairs) if a != b), 0)
            return (
                f"{path}: variable {name} differs from block {block} on "
                f"(value {block * manifest.BLOCK:,} of {int(np.prod(new['shape'])):,})"
                + _size_of_difference(other_tree, path, name, dataset)
            )
    names = [name for name, *_ in differing_keys(before["attributes"], after["attributes"])]
    verb = "attributes {} differ" if len(names) > 1 else "attribute {} differs"
    return f"{path}: {verb.format(', '.join(names))}" if names else None


def _size_of_difference(other_tree: Path | None, path: str, name: str, dataset: xr.Dataset) -> str:
    if other_tree is None:
        return ""
    copy = other_tree / path
    try:
        other = load(copy)
    except ArtifactError as error:
        return f"; {error}"
    if name not in other or other[name].shape != dataset[name].shape:
        return f"; {copy} has another {name}"
    words = _ulps_in_words(dataset.variables[name], other.variables[name])
    return f"; {words}, compared with {copy}"


def ulps(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return how many doubles lie between a and b, as unsigned integers; 0 where both are NaN."""
    a, b = (np.ascontiguousarray(x, dtype="<f8").view("<i8") for x in (a, b))
    # Bit patterns of negative numbers run backwards: map them to the order of the numbers.
    a, b = (np.where(x < 0, np.int64(-(2**63)) - x, x) for x in (a, b))
    return np.asarray(np.maximum(a, b).view("<u8") - np.minimum(a, b).view("<u8"))


def _ulps_in_words(ours: xr.Variable, theirs: xr.Variable) -> str:
    (kind, a), (other, b) = canonical_values(ours), canonical_values(theirs)
    if kind != other:
        return f"{kind} instead of {other}"
    if kind != "<f8":
        return f"{sum(x != y for x, y in zip(a, b, strict=True))} of {len(a)} values differ"
    a, b = np.asarray(a), np.asarray(b)
    one_sided = np.isnan(a) != np.isnan(b)
    if one_sided.any():
        return f"{int(one_sided.sum())} values are NaN on one side only"
    return f"largest difference {int(ulps(a, b).max(initial=0)):,} ulp"
