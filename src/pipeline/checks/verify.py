"""Comparison of a tree with its committed state; nothing is recomputed.

A tree fails in these cases, and other differences are notes:

- The bytes of a published file or its data differ from the committed ones.
- A result was not made from this tree's config and sources.
- A manifest is broken.
"""

import hashlib
from collections.abc import Collection, Iterable, Iterator
from pathlib import Path

from ..config import Config
from ..records.differences import columns
from ..records.files import FileError, file_hash, why_not_a_file
from ..records.provenance import MISSING, Freshness, failure
from . import manifest, published_sets
from .layers import UPSTREAM, Comparison
from .published_sets import MANIFEST, SUMS, PublishedSet, edited_lists, unlisted_files

_UNCOMPUTED = "not computed here: run ./reproduce, or verify --committed for committed files alone"


class Findings:
    """What differs between a tree and the committed state of one published set.

    Without `partial`, it is a finding that a drawing is missing in results.
    """

    def __init__(self, root: Path, published_set: PublishedSet, partial: bool = True) -> None:
        freshness = Freshness(root, published_set.build_specs)
        refused = dict[str, str]()  # scene that cannot be made -> why
        for name, drawing in published_set.drawn.items():
            if why := freshness.refusal(drawing):
                refused[Path(name).stem] = why
        self.published_set = published_set = published_set.without(refused)
        self.left_out = [
            f"{scene} is left out, because it cannot exist: {why}" for scene, why in refused.items()
        ]
        self.unlisted = unlisted_files(root, published_set.group, published_set.drawn, refused)
        self.stale = freshness.outdated(published_set.build_specs)
        self.committed: manifest.Manifest | None = None  # if it cannot be read
        # Name of each published file -> layer -> how it differs; None for a new file. Empty without
        # a manifest.
        self.layers: dict[str, dict[str, str] | None] = {}
        # Lines about manifest, checksum list, text files and surplus files.
        self.problems = [*self.unlisted.values()]
        try:
            self.committed = manifest.read(root, published_set.folder)
        except FileError as error:
            self.problems = [str(error)]
        else:
            comparison = Comparison(freshness, published_set, self.committed)
            self.layers = {name: comparison.layers(name) for name in published_set.drawn}
            self.problems += _other_files(root, published_set, self.committed, refused)
        self._sort_layers(edited_lists(root))
        self._sort_results(partial)

    def _sort_layers(self, edited: dict[str, str]) -> None:
        """Set the layers of files that are not the committed ones, and the notes on all others."""
        published_set, self.differences = self.published_set, dict[str, dict[str, str]]()
        notes = [each for each in edited.items() if each[0].startswith(f"{published_set.folder}/")]
        for name, layers in self.layers.items():
            # Another config does not matter once results made with it have the committed bytes.
            current = published_set.on_request or published_set.drawn[name] not in self.stale
            if layers is None:
                notes.append((name, "new: ./reproduce accept adds it to the manifest"))
            elif layers.keys() <= (UPSTREAM if current else UPSTREAM - {"config"}):
                notes += [(name, f"{layer}: {words}") for layer, words in layers.items()]
            else:
                self.differences[name] = layers
        self.notes = [*self.left_out, *_grouped(notes)]

    def _sort_results(self, partial: bool) -> None:
        """Set lines about what fails besides files, and about what could not be checked."""
        drawn, run = self.published_set.drawn, self.published_set.command
        missing = [path for path, why in self.stale.items() if why == MISSING]
        stale = ((p, f"{why}: run {run}") for p, why in self.stale.items() if why != MISSING)
        self.failures, self.unchecked = [*self.problems, *_grouped(stale)], list[str]()
        uncomputed = [name for name in drawn if not partial and drawn[name] in missing]
        if uncomputed:
            self.failures += _grouped((name, _UNCOMPUTED) for name in uncomputed)
        elif missing and len(missing) == len(self.published_set.build_specs):
            words = f"only the committed files were checked ({run} makes the rest)"
            self.unchecked.append(f"no results here: {words}")
        elif missing:
            self.unchecked.append(f"not checked, since not there: {_listed(missing)}")

    def why(self, strict: bool = False) -> Iterator[str]:
        """Yield lines that repeat why the tree fails, if it does; notes count if `strict`."""
        folder = self.published_set.folder
        if self.differences:
            yield f"exit status 1: {folder}/: {_listed([*self.differences])} differ"
        for line in [*self.failures, *(self.notes if strict else ())]:
            named = "/" in line.partition(":")[0]
            yield f"exit status 1: {line if named else f'{folder}/: {line}'}"

    def not_published(self, root: Path, partial: bool = False) -> str | None:
        """Name the first result that is not current or not published; None if there is none.

        With `partial`, results may be missing.
        """
        for path, why in self.stale.items():
            if why != MISSING:
                return f"{path}: {why}"
            if not partial:
                return ": ".join(filter(None, [f"{path} is missing", failure(path)]))
        for name, drawing in self.published_set.drawn.items():
            published, drawn = f"{self.published_set.folder}/{name}", file_hash(root / drawing)
            if words := why_not_a_file(root / published):
                return f"{published}: {words}"
            if drawn != file_hash(root / published) and not (partial and drawn is None):
                return f"{published} is not {drawing}"
        return None

    def report(self) -> list[str]:
        """Return the lines for the user: those of published files, then all other findings.

        Formats of a figure that differ in the same way share a line for each layer.
        """
        figures = dict[tuple[str, ...], list[str]]()
        for name, layers in self.layers.items():
            words = [f"{layer}: {text}" for layer, text in self.differences.get(name, {}).items()]
            words = words or ["new" if layers is None else "identical"]
            path = Path(name)
            figures.setdefault((path.stem, *words), []).append(path.suffix[1:])
        rows = list[tuple[str, str, str]]()
        for (figure, *words), formats in figures.items():
            rows += [(figure, " ".join(formats), words[0]), *(("", "", w) for w in words[1:])]
        notes = [f"note: {line}" for line in self.notes]
        return [*columns(rows), *self.failures, *notes, *self.unchecked]


def summary(findings: list[Findings]) -> str:
    """Return the closing line about all published sets."""
    files = [layers for each in findings for layers in each.layers.values()]
    others = files.count(None) + sum(len(each.differences) for each in findings)
    failures = sum(len(each.failures) for each in findings)
    notes = sum(len(each.notes) for each in findings)
    counts = {"other finding": failures, "note": notes}
    words = [f"; {n} {noun}{'s' * (n > 1)}" for noun, n in counts.items() if n]
    return f"{len(files) - others} of {len(files)} files identical{''.join(words)}"


def verify(root: Path, config: Config, committed: bool = False) -> list[Findings]:
    """Compare each published set of a tree with its committed state, if it has one.

    With `committed`, figures of the paper need not have been computed here.
    """
    return [
        Findings(root, published_set, committed or published_set.on_request)
        for published_set in published_sets.committed_sets(config)
        if not published_set.on_request or published_set.is_committed(root)
    ]


def _other_files(
    root: Path, published_set: PublishedSet, committed: manifest.Manifest, refused: Collection[str]
) -> Iterator[str]:
    """Yield a line for each name in the manifest, list or text that is not as it should be."""
    folder = published_set.folder
    for name in manifest.published(committed):
        if name not in published_set.drawn:
            cannot = Path(name).stem in refused
            words = "whose scene cannot exist" if cannot else "which config.yaml does not publish"
            yield f"{folder}/{MANIFEST}: lists {name}, {words}: ./reproduce accept takes it out"
    for path in published_set.text_files:
        if file_hash(root / path) != committed["texts"].get(path):
            yield f"{path}: not the committed one: {published_set.command} writes it"
    sums = root / folder / SUMS
    expected = manifest.files_of(committed)[SUMS].encode()
    if file_hash(sums) != hashlib.sha256(expected).hexdigest():
        other = f"is not as {MANIFEST} has it" if sums.exists() else "missing"
        yield f"{folder}/{SUMS}: {why_not_a_file(sums) or other}"


def _grouped(pairs: Iterable[tuple[str, str]]) -> list[str]:
    """Join pairs of a subject and words that have the same words to one line each."""
    subjects: dict[str, list[str]] = {}
    for subject, words in pairs:
        subjects.setdefault(words, []).append(subject)
    return [f"{_listed(names)}: {words}" for words, names in subjects.items()]


def _listed(names: list[str]) -> str:
    """Join names, the first four of more than five."""
    more = f" and {len(names) - 4} more" if len(names) > 5 else ""
    return ", ".join(names[:4] if more else names) + more
