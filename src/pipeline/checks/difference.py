"""What differs between a published file as committed and as it is here, layer by layer.

A tree's config, source and environment decide its data, these the drawing, and that the file: the
first layer that differs is the cause of those after it.
"""

import tempfile
from functools import cache
from pathlib import Path

import numpy as np

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

# A difference in one of these alone leaves the committed bytes.
UPSTREAM = {"config", "source", "environment"}
UNEXPLAINED = (
    "differs from the committed one, although its config, sources and packages do not: delete it"
)


def not_as_made(root, published_set, comparison=None):
    """Which results of a contract are not what this tree makes: one answer for every command.

    A result's record decides. Where the manifest lists the result, and all that makes it is as
    committed, it must be the committed one too, whatever its record says.
    The manifest is read where no `comparison` with it is given.

    Returns
    -------
    dict of str to str
        Result -> why, in words.
    """
    found = Freshness(root, published_set.build_specs).outdated()
    if comparison is None:
        try:
            comparison = Comparison(root, published_set, manifest.read(root, published_set.folder))
        except ChecksumError:
            return found
    found = comparison.unexplained() | found
    for path in published_set.build_specs:  # each after its inputs
        for used in published_set.build_specs[path].inputs:
            if used in found:
                found.setdefault(path, f"made from {used}, which is not current")
    return found


class Comparison:
    """A tree at `root` with its `contract` against the manifest `committed`.

    `against` is a folder with a second copy of the tree, or None: it serves to say how large a
    difference is.
    """

    def __init__(self, root, published_set, committed, against=None):
        self.root, self.published_set, self.committed = root, published_set, committed
        self.against = against
        self.versions = versions()
        self.file_hash = cache(lambda path: file_hash(root / path))
        self.differing_data = cache(self._differing_data)

    def layers(self, name) -> dict[str, str] | None:
        """Layer -> words, for each that differs, the cause first; None for a file that is new."""
        scene = self.published_set.scenes[name]
        entry = self.committed["scenes"].get(scene)
        if entry is None or name not in entry["figures"]:
            return None
        sources = {path: self.committed["sources"].get(path) for path in entry["sources"]}
        here = {path: syntax_hash(self.root / path) for path in self.published_set.sources(scene)}
        blocks, was = (entry["config"], self.published_set.config[scene]), "in the manifest"
        data = (self._dataset(*each, entry) for each in self.published_set.data[scene].items())
        layers = {
            "config": differing_block(*blocks, was, "in config.yaml"),
            "source": differing_files(sources, here),
            "environment": differing_package(self.committed["environment"], self.versions, was),
            "data": next(filter(None, data), None),
        } | self._drawing_or_file(name, entry["figures"][name])
        return {layer: words for layer, words in layers.items() if words}

    def _dataset(self, stage, path, entry):
        """How the dataset of a stage differs from the committed one, or None."""
        if entry["data"].get(stage) in self.committed["data"] and self.file_hash(path):
            return self.differing_data(path, entry["data"][stage])
        return None

    def _differing_data(self, path, committed_name):
        """Words about the first variable of an artifact that differs from the manifest, or None."""
        try:
            dataset = load(self.root / path)
        except ArtifactError as error:
            return str(error).replace(f"{self.root}/", "")
        before, after = self.committed["data"][committed_name], manifest.describe_data(dataset)
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
                    + self._size_of_difference(path, name, dataset)
                )
        names = [name for name, *_ in differing_keys(before["attributes"], after["attributes"])]
        verb = "attributes {} differ" if len(names) > 1 else "attribute {} differs"
        return f"{path}: {verb.format(', '.join(names))}" if names else None

    def _size_of_difference(self, path, name, dataset):
        if self.against is None:
            return ""
        copy = self.against / path
        try:
            other = load(copy)
        except ArtifactError as error:
            return f"; {error}"
        if name not in other or other[name].shape != dataset[name].shape:
            return f"; {copy} has another {name}"
        words = _ulps_in_words(dataset.variables[name], other.variables[name])
        return f"; {words}, compared with {copy}"

    def _drawing_or_file(self, name, entry):
        """{"drawing": words} or {"file": words}, of the published file or the one in results."""
        published, drawn = f"{self.published_set.folder}/{name}", self.published_set.drawn[name]
        if self.file_hash(published) is None:
            why = obstacle(self.root / published)
            missing = f"{published} is missing: {self.published_set.command} makes it"
            return {"file": f"{published}: {why}" if why else missing}
        encoding = {}
        for path in (published, drawn):
            if self.file_hash(path) in (entry["sha256"], None):
                continue
            try:
                if describe(self.root / path) == entry["drawing"]:
                    encoding = encoding or {"file": f"{path}: the same picture in other bytes"}
                    continue
                reference = [other for other in (published, drawn) if other != path]
                return {"drawing": f"{path}: {self._how_drawn(path, name, entry, reference)}"}
            except PictureError as error:
                return {"drawing": str(error).replace(f"{self.root}/", "")}
        return encoding

    def _how_drawn(self, path, name, entry, others):
        with tempfile.TemporaryDirectory() as folder:
            candidates = [self.root / other for other in others]
            blob = git("show", f"HEAD:./{self.published_set.folder}/{name}", root=self.root)
            if blob is not None:
                candidates.append(Path(folder) / name)
                candidates[-1].write_bytes(blob)
            if self.against is not None:
                drawing = self.published_set.drawn[name]
                candidates += [
                    self.against / self.published_set.folder / name,
                    self.against / drawing,
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
        """Result -> words, where it differs from the committed one and nothing that makes it does.

        Its record may say that this tree made it: then the record says something untrue.
        """
        found = []
        for name, drawing in self.published_set.drawn.items():
            scene = self.published_set.scenes[name]
            entry = self.committed["scenes"].get(scene, {"data": {}, "figures": {}})
            stages = self.published_set.data[scene].items()
            different = [path for stage, path in stages if self._dataset(stage, path, entry)]
            figure = entry["figures"].get(name)
            if figure and self.file_hash(drawing) not in (None, figure["sha256"]):
                different.append(drawing)
            found += [path for path in different if not self._explained(path, scene, entry)]
        return dict.fromkeys(found, UNEXPLAINED)

    def _explained(self, path, scene, entry):
        """Whether what makes a result may differ from what made the committed one."""
        build_specs = self.published_set.build_specs
        made = [build_specs[each] for each in with_dependencies(build_specs, [path])]
        keys = {key for each in made for key in each.config}
        blocks = (entry["config"], self.published_set.config[scene])
        return bool(
            any(used not in build_specs for each in made for used in each.inputs)
            or differing_package(self.committed["environment"], self.versions)
            or differing_block(*({k: block[k] for k in keys & {*block}} for block in blocks))
            or any(
                syntax_hash(self.root / file) != self.committed["sources"].get(file)
                for each in made
                for file in each.sources
            )
        )


def ulps(a, b):
    """How many doubles lie between each a and b, as unsigned integers; 0 where both are NaN."""
    a, b = (np.ascontiguousarray(x, dtype="<f8").view("<i8") for x in (a, b))
    # Bit patterns of negative numbers run backwards; afterwards all are in the numbers' order.
    a, b = (np.where(x < 0, np.int64(-(2**63)) - x, x) for x in (a, b))
    return np.maximum(a, b).view("<u8") - np.minimum(a, b).view("<u8")


def _ulps_in_words(ours, theirs):
    (kind, a), (other, b) = canonical_values(ours), canonical_values(theirs)
    if kind != other:
        return f"{kind} instead of {other}"
    if kind != "<f8":
        return f"{sum(x != y for x, y in zip(a, b, strict=True))} of {len(a)} values differ"
    lonely = np.isnan(a) != np.isnan(b)
    if lonely.any():
        return f"{int(lonely.sum())} values are NaN on one side only"
    return f"largest difference {int(ulps(a, b).max(initial=0)):,} ulp"
