"""How a published file of a tree differs from the committed one, layer by layer.

The layers config, source and environment decide the data, the data decide the drawing, and the
drawing decides the file: the first layer that differs is the cause of differences in later ones.
"""

import tempfile
from pathlib import Path
from typing import Any

from ..records.artifacts import ArtifactError, load
from ..records.differences import differing_data, differing_layers
from ..records.files import FileError, file_hash, why_not_a_file
from ..records.pictures import drawing_hash, picture_difference
from ..records.provenance import Freshness, git
from . import manifest
from .published_sets import PublishedSet

# A difference in these layers alone does not change the committed bytes.
UPSTREAM = {"config", "source", "environment"}
_NO_COPY = "no copy of the committed one is at hand to count what differs"


class Comparison:
    """Compares the published set of a tree with a committed manifest."""

    def __init__(
        self, freshness: Freshness, published_set: PublishedSet, committed: manifest.Manifest
    ) -> None:
        self.freshness, self.published_set, self.committed = freshness, published_set, committed
        self.root, self.results = freshness.root, committed["results"]

    def layers(self, name: str) -> dict[str, str] | None:
        """Map each layer of a file that differs to the difference, the cause first.

        Sources and data are those of all results behind the file. Returns None if the manifest does
        not have the file.
        """
        drawing = self.published_set.drawn[name]
        if drawing not in self.results:
            return None
        data = [*self.published_set.data[Path(name).stem].values()]
        chain = manifest.upstream(self.committed, drawing)
        before = _joined([manifest.record_of(self.committed, path) for path in chain])
        specs = self.freshness.build_specs
        after = _joined([specs[path]._asdict() for path in (drawing, *data)])
        layers = differing_layers(before, after, "in the manifest", "in config.yaml")
        for path in data:
            if path in self.results and (words := self._data_difference(path)):
                layers.setdefault("data", words)
        return layers | self._picture_difference(name, drawing)

    def _data_difference(self, path: str) -> str | None:
        """Describe how a dataset, if it is here, differs from the committed one."""
        committed = self.results[path]["output"]
        if self.freshness.digest(path) in (committed["sha256"], None):
            return None
        try:
            here = manifest.describe_data(load(self.root / path))
        except ArtifactError as error:
            return str(error).replace(f"{self.root}/", "")
        words = differing_data(committed, here)
        return words and f"{path}: {words}"

    def _picture_difference(self, name: str, drawing: str) -> dict[str, str]:
        """Return the layer in which a published file differs, or in which its drawing does more."""
        published = f"{self.published_set.folder}/{name}"
        committed = self.results[drawing]["output"]
        if self.freshness.digest(published) is None:
            why = why_not_a_file(self.root / published)
            missing = f"{published} is missing: {self.published_set.command} makes it"
            return {"file": f"{published}: {why}" if why else missing}
        layers = dict[str, str]()
        for path in (published, drawing):
            if self.freshness.digest(path) in (committed["sha256"], None):
                continue
            try:
                same = drawing_hash(self.root / path) == committed["drawing"]
            except FileError as error:
                return {"drawing": str(error).replace(f"{self.root}/", "")}
            if not same:
                return {"drawing": f"{path}: {self._how_drawn(path, name, committed['sha256'])}"}
            layers.setdefault("file", f"{path}: the same picture in other bytes")
        return layers

    def _how_drawn(self, path: str, name: str, digest: str) -> str:
        """Describe how a picture differs from the committed one, if there is a copy of this one."""
        published = f"{self.published_set.folder}/{name}"
        image = f"results/{self.published_set.group}/differences/{name}"
        with tempfile.TemporaryDirectory() as folder:
            copy = Path(folder) / name
            copy.write_bytes(git("show", f"HEAD:./{published}", root=self.root) or b"")
            candidates = self.root / published, self.root / self.published_set.drawn[name], copy
            reference = next((file for file in candidates if file_hash(file) == digest), None)
            if reference is None:
                return f"another picture; {_NO_COPY}"
            try:
                words = picture_difference(self.root / path, reference, self.root / image)
            except FileError:
                return "another picture"  # and no place to show where it differs
            return words.replace(f"{self.root}/", "")


def _joined(records: list[dict[str, Any]]) -> dict[str, Any]:
    """Return the first of some records with the sources of all."""
    sources = {file: digest for each in records for file, digest in each["sources"].items()}
    return records[0] | {"sources": sources}
