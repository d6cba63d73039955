"""How a published file differs from the committed one, layer by layer.

The layers are config, source, environment, data, drawing and file. The first three decide the data,
the data decide the drawing, and the drawing decides the file. The first layer that differs is the
cause of differences in the layers after it.
"""

import math
import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

from ..records.artifacts import ArtifactError, load
from ..records.differences import differing_keys, differing_origin
from ..records.files import FileError, file_hash, why_not_a_file
from ..records.pictures import PictureError, describe, picture_difference
from ..records.record import git, versions
from ..records.sources import syntax_hash
from . import manifest
from .published_sets import PublishedSet

# A difference in these layers alone does not change the committed bytes.
UPSTREAM = {"config", "source", "environment"}
_NO_COPY = "no copy of the committed one is at hand to count what differs"


class Comparison:
    """Compares a tree's published set with a committed manifest."""

    def __init__(self, root: Path, published_set: PublishedSet, committed: manifest.Manifest):
        self.root, self.published_set, self.committed = root, published_set, committed
        self.file_hash: Callable[[str], str | None] = cache(lambda path: file_hash(root / path))
        self.differing_data = cache(
            lambda path, name: dataset_difference(root, path, committed["data"][name])
        )

    def layers(self, name: str) -> dict[str, str] | None:
        """Map each layer of a file that differs to the difference, the cause first.

        Returns None if the manifest does not have the file.
        """
        scene, published_set = Path(name).stem, self.published_set
        entry = self.committed["scenes"].get(scene, {"figures": {}})
        if name not in entry["figures"]:
            return None
        committed = {
            "config": entry["config"],
            "sources": {file: self.committed["sources"].get(file) for file in entry["sources"]},
            "environment": self.committed["environment"],
        }
        here = {
            "config": published_set.config[scene],
            "sources": {
                file: syntax_hash(self.root / file) for file in published_set.sources(scene)
            },
            "environment": versions(),
        }
        layers = differing_origin(committed, here, "in the manifest", "in config.yaml")
        if words := self._differing_dataset(scene, entry["data"]):
            layers["data"] = words
        return layers | self._drawing_or_file(name, entry["figures"][name])

    def _differing_dataset(self, scene: str, committed: dict[str, str]) -> str | None:
        """Describe the first dataset of a scene that is here and differs from the committed one."""
        for stage, path in self.published_set.data[scene].items():
            present = committed.get(stage) in self.committed["data"] and self.file_hash(path)
            if present and (words := self.differing_data(path, committed[stage])):
                return words
        return None

    def _drawing_or_file(self, name: str, entry: dict[str, Any]) -> dict[str, str]:
        """Return the layer drawing or file, if it differs in the published file or in results."""
        published, drawn = f"{self.published_set.folder}/{name}", self.published_set.drawn[name]
        if self.file_hash(published) is None:
            why = why_not_a_file(self.root / published)
            missing = f"{published} is missing: {self.published_set.command} makes it"
            return {"file": f"{published}: {why}" if why else missing}
        other_bytes: dict[str, str] = {}
        for path in (published, drawn):
            if self.file_hash(path) in (entry["sha256"], None):
                continue
            try:
                if describe(self.root / path) != entry["drawing"]:
                    return {"drawing": f"{path}: {self._how_drawn(path, name, entry['sha256'])}"}
            except PictureError as error:
                return {"drawing": str(error).replace(f"{self.root}/", "")}
            other_bytes = other_bytes or {"file": f"{path}: the same picture in other bytes"}
        return other_bytes

    def _how_drawn(self, path: str, name: str, digest: str) -> str:
        """Describe how a picture differs from the committed one, if there is a copy of this one."""
        published = f"{self.published_set.folder}/{name}"
        image = f"{self.published_set.results}/differences/{name}"
        with tempfile.TemporaryDirectory() as folder:
            copy = Path(folder) / name
            copy.write_bytes(git("show", f"HEAD:./{published}", root=self.root) or b"")
            candidates = self.root / published, self.root / self.published_set.drawn[name], copy
            reference = next((file for file in candidates if file_hash(file) == digest), None)
            if reference is None:
                return f"another picture; {_NO_COPY}"
            try:
                words, saved = picture_difference(self.root / path, reference, self.root / image)
            except FileError:
                return "another picture"  # and no place to show where it differs
            return f"{words}: see {image}" if saved else words


def dataset_difference(root: Path, path: str, before: dict[str, Any]) -> str | None:
    """Describe the first difference of a dataset from an entry of a manifest; None without one."""
    try:
        after = manifest.describe_data(load(root / path))
    except ArtifactError as error:
        return str(error).replace(f"{root}/", "")
    for name in sorted({*before["variables"], *after["variables"]}):
        if words := _variable_difference(
            before["variables"].get(name), after["variables"].get(name)
        ):
            return f"{path}: variable {name}{words}"
    names = [name for name, *_ in differing_keys(before["attributes"], after["attributes"])]
    verb = "attributes {} differ" if len(names) > 1 else "attribute {} differs"
    return f"{path}: {verb.format(', '.join(names))}" if names else None


def _variable_difference(old: dict[str, Any] | None, new: dict[str, Any] | None) -> str | None:
    """Describe the first difference of two entries for a variable; None without one."""
    if old is None or new is None:
        return f" is {'new' if old is None else 'gone'}"
    for what in ("dims", "dtype", "shape", "attributes"):
        if old[what] != new[what]:
            words = "" if what == "attributes" else f": {old[what]} then, {new[what]} now"
            return f": another {what.removesuffix('s')}{words}"
    if old["sha256"] == new["sha256"]:
        return None
    pairs = zip(old["blocks"].split(), new["blocks"].split(), strict=False)
    block = next((i for i, (a, b) in enumerate(pairs) if a != b), 0)
    first, size = block * manifest.BLOCK, math.prod(new["shape"])
    return f" differs from block {block} on (value {first:,} of {size:,})"
