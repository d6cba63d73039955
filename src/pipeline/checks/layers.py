"""How a published file of a tree differs from the committed one, layer by layer.

The layers config, source and environment decide the data, the data decide the drawing, and the
drawing decides the file: the first layer that differs is the cause of differences in later ones.
"""

import tempfile
from functools import cache
from pathlib import Path
from typing import Any

from ..records.differences import differing_layers
from ..records.files import FileError, file_hash, why_not_a_file
from ..records.pictures import picture_difference
from ..records.provenance import Freshness, git
from . import manifest
from .published_sets import PublishedSet

# A difference in these layers alone does not change the committed bytes.
UPSTREAM = {"config", "source", "environment"}
_COMPARED = "drawing", "sha256"
_NO_COPY = "no copy of the committed one is at hand to count what differs"


class Comparison:
    """Compares the published set of a tree with a committed manifest."""

    def __init__(
        self, freshness: Freshness, published_set: PublishedSet, committed: manifest.Manifest
    ) -> None:
        self.freshness, self.published_set, self.committed = freshness, published_set, committed
        self.root, self.results = freshness.root, committed["results"]
        self.present = cache(self._present)

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
        after = _joined([self.freshness.here(path) for path in (drawing, *data)])
        known = [path for path in data if path in self.results]
        before["inputs"] = {path: self.results[path]["output"] for path in known}
        after["inputs"] = {path: self.present(path, path) for path in known}
        after["output"] = output = self._output(name, drawing)
        layers = differing_layers(before, after, "in the manifest", "in config.yaml")
        if "drawing" in layers and "drawing" in output:
            words = self._how_drawn(output["file"], name, before["output"]["sha256"])
            layers["drawing"] = f"{output['file']}: {words}"
        return layers

    def _published(self, name: str) -> str:
        return f"{self.published_set.folder}/{name}"

    def _present(self, path: str, result: str) -> dict[str, Any]:
        """Describe a file; without the file, or if it has the committed bytes, as committed."""
        committed, digest = self.results[result]["output"], self.freshness.digest(path)
        if digest in (committed["sha256"], None):
            return dict(committed)
        return {"file": path, "sha256": digest} | manifest.describe(self.root, path)

    def _output(self, name: str, drawing: str) -> dict[str, Any]:
        """Describe a published file or its drawing, whichever is less like the committed one."""
        published, committed = self._published(name), self.results[drawing]["output"]
        if self.freshness.digest(published) is None:
            why = why_not_a_file(self.root / published)
            missing = f"{published} is missing: {self.published_set.command} makes it"
            return {"sha256": None, "error": f"{published}: {why}" if why else missing}
        outputs = [self.present(path, drawing) for path in (published, drawing)]
        return max(outputs, key=lambda each: [each.get(k) != committed.get(k) for k in _COMPARED])

    def _how_drawn(self, path: str, name: str, digest: str) -> str:
        """Describe how a picture differs from the committed one, if there is a copy of this one."""
        published = self._published(name)
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


def _joined(records: list[dict[str, Any]]) -> dict[str, Any]:
    """Return the first of some records with the sources of all."""
    sources = {file: digest for each in records for file, digest in each["sources"].items()}
    return records[0] | {"sources": sources}
