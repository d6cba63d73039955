"""Comparison of a tree with its committed state; nothing is recomputed.

A tree fails in these cases, and other differences are notes:

- The bytes of a published file or its data differ from the committed ones.
- A result was not made from this tree's config and sources.
- A manifest is broken.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from ..config import Config
from ..records.differences import columns
from ..records.files import file_hash, why_not_a_file
from ..records.provenance import MISSING, Freshness, failure
from . import manifest, published_sets
from .layers import UPSTREAM, Comparison
from .published_sets import MANIFEST, SUMS, PublishedSet, edited_lists

_UNCOMPUTED = "not computed here: run ./reproduce, or verify --committed for committed files alone"
NEW = "new: ./reproduce accept adds it to the manifest"


@dataclass
class Findings:
    """What differs between a tree and the committed state of one published set."""

    published_set: PublishedSet
    committed: manifest.Manifest | None = None  # None if it cannot be read
    # Name of each published file -> layer -> how it differs; None for a new file. Empty without a
    # manifest.
    layers: dict[str, dict[str, str] | None] = field(default_factory=dict)
    stale: dict[str, str] = field(default_factory=dict)  # result -> why this tree makes another
    edited: dict[str, str] = field(default_factory=dict)  # manifest or sums not as committed -> how
    problems: list[str] = field(default_factory=list)  # of manifest, sums, text files, surplus
    # A line about drawings of the paper that were not computed here, if they have to be.
    uncomputed: list[str] = field(default_factory=list)

    @property
    def left_out(self) -> list[str]:
        """Lines about scenes that cannot be made."""
        reasons = self.published_set.impossible.items()
        return [f"{name} is left out, because it cannot exist: {why}" for name, why in reasons]

    @property
    def differences(self) -> dict[str, dict[str, str]]:
        """The differing layers of each published file that is not the committed one."""
        return {n: layers for n, layers in self.layers.items() if layers and not self._harmless(n)}

    @property
    def failures(self) -> list[str]:
        """Lines about what fails besides the published files that differ."""
        words = f": run {self.published_set.command}"
        stale = [(path, why + words) for path, why in self.stale.items() if why != MISSING]
        return [*self.problems, *_grouped(stale), *self.uncomputed]

    @property
    def notes(self) -> list[str]:
        """Lines about differences that leave the committed bytes."""
        notes = [*self.edited.items()]
        for name, layers in self.layers.items():
            if layers is None:
                notes.append((name, NEW))
            elif self._harmless(name):
                notes += [(name, f"{layer}: {words}") for layer, words in layers.items()]
        return [*self.left_out, *_grouped(notes)]

    def fails(self, strict: bool = False) -> bool:
        """Return whether the tree is not as committed; notes count if `strict`."""
        return bool(self.differences or self.failures or (strict and self.notes))

    def why(self, strict: bool = False) -> Iterator[str]:
        """Yield lines that repeat why the tree fails."""
        folder = self.published_set.folder
        if self.differences:
            yield f"exit status 1: {folder}/: {_listed([*self.differences])} differ"
        for line in [*self.failures, *(self.notes if strict else ())]:
            named = "/" in line.partition(":")[0]
            yield f"exit status 1: {line if named else f'{folder}/: {line}'}"

    def _harmless(self, name: str) -> bool:
        """Return whether the layers of a listed file leave its committed bytes."""
        # Another config does not matter once results made with it have the committed bytes.
        published_set = self.published_set
        current = published_set.on_request or published_set.drawn[name] not in self.stale
        return set(self.layers[name] or ()) <= (UPSTREAM if current else UPSTREAM - {"config"})

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
        """Return the lines for the user: those of each published file, then all other findings."""
        notes = [f"note: {line}" for line in self.notes]
        return [*self._lines_of_files(), *self.failures, *notes, *self._unchecked()]

    def _lines_of_files(self) -> list[str]:
        """Return a line for files of a figure that say the same, and one for each further layer."""
        differences, figures = self.differences, dict[tuple[str, ...], list[str]]()
        for name, layers in self.layers.items():
            words = [f"{layer}: {text}" for layer, text in differences.get(name, {}).items()]
            words = words or ["new" if layers is None else "identical"]
            path = Path(name)
            figures.setdefault((path.stem, *words), []).append(path.suffix[1:])
        rows = list[tuple[str, str, str]]()
        for (figure, *words), formats in figures.items():
            rows += [(figure, " ".join(formats), words[0]), *(("", "", w) for w in words[1:])]
        return columns(rows)

    def _unchecked(self) -> Iterator[str]:
        """Yield a line about results that are not here, unless they are findings."""
        missing = [path for path, why in self.stale.items() if why == MISSING]
        if missing and not self.uncomputed:
            if len(missing) == len(self.published_set.build_specs):
                rest = f"{self.published_set.command} makes the rest"
                yield f"no results here: only the committed files were checked ({rest})"
            else:
                yield f"not checked, since not there: {_listed(missing)}"


def summary(findings: Iterable[Findings]) -> str:
    """Return the closing line about all published sets."""
    total = identical = failures = notes = 0
    for each in findings:
        total += len(each.layers)
        identical += len(each.layers) - len(each.differences) - [*each.layers.values()].count(None)
        failures, notes = failures + len(each.failures), notes + len(each.notes)
    counts = {"other finding": failures, "note": notes}
    others = [f"; {n} {noun}{'s' * (n > 1)}" for noun, n in counts.items() if n]
    return f"{identical} of {total} files identical{''.join(others)}"


def verify(root: Path, config: Config, committed: bool = False) -> list[Findings]:
    """Compare each published set of a tree with its committed state, if it has one.

    With `committed`, figures of the paper need not have been computed here.
    """
    return [
        inspect(root, published_set, committed or published_set.on_request)
        for published_set in published_sets.committed_sets(config)
        if not published_set.on_request or published_set.is_committed(root)
    ]


def inspect(root: Path, published_set: PublishedSet, partial: bool = True) -> Findings:
    """Compare one published set of a tree with its committed state.

    Without `partial`, it is a finding that a drawing is missing in results.
    """
    freshness = Freshness(root, published_set.build_specs)
    refused = {
        Path(name).stem: why
        for name, drawing in published_set.drawn.items()
        if (why := freshness.refusal(drawing))
    }
    published_set = published_set.without(refused)
    folder, findings = published_set.folder, Findings(published_set)
    of_set = (f"{folder}/{SUMS}", f"{folder}/{MANIFEST}")
    findings.edited = {f: why for f, why in edited_lists(root).items() if f in of_set}
    try:
        findings.committed = committed = manifest.read(root, folder)
        comparison = Comparison(freshness, published_set, committed)
        findings.layers = {name: comparison.layers(name) for name in published_set.drawn}
        findings.problems += _other_files(root, published_set, committed)
        sums = published_sets.read_published_text(root, f"{folder}/{SUMS}")
        if sums != manifest.files_of(committed)[SUMS]:
            findings.problems.append(f"{folder}/{SUMS}: is not as {MANIFEST} has it")
    except published_sets.ChecksumError as error:
        findings.problems.append(str(error))
    findings.stale = stale = freshness.outdated(published_set.build_specs)
    if not partial:
        missing = [name for name, path in published_set.drawn.items() if stale.get(path) == MISSING]
        findings.uncomputed = _grouped((name, _UNCOMPUTED) for name in missing)
    return findings


def _other_files(
    root: Path, published_set: PublishedSet, committed: manifest.Manifest
) -> Iterator[str]:
    """Yield a line for each file that nothing makes, and for each text that is not as committed."""
    for name in manifest.published(committed):
        if name not in published_set.drawn:
            cannot = Path(name).stem in published_set.impossible
            words = "whose scene cannot exist" if cannot else "which config.yaml does not publish"
            file = f"{published_set.folder}/{MANIFEST}"
            yield f"{file}: lists {name}, {words}: ./reproduce accept takes it out"
    yield from published_set.unlisted(root)
    for path in published_set.text_files:
        if file_hash(root / path) != committed["texts"].get(path):
            yield f"{path}: not the committed one: {published_set.command} writes it"


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
