"""./reproduce list: show what can be made and the state of each file."""

from collections.abc import Iterator, Sequence
from pathlib import PurePath

from ...checks.freshness import CURRENT, MISSING, Freshness
from ...checks.published_sets import ChecksumError, PublishedSet, committed_sets, committed_state
from ...config.results import drawn, is_measured
from ...config.schema.sets import SETS
from ...records.differences import columns, differing_layers
from ...records.sources import ROOT
from ..arguments import Arguments


def run(args: Arguments) -> int:
    """Print every figure, chart and dataset below the command that makes it."""
    config = args.config
    own: list[Sequence[str]] = []  # rows on the variants of the paper
    freshness = Freshness(ROOT, config.build_specs())
    for published_set in committed_sets(config):
        _print(published_set.command, [*_published(freshness, published_set)])
    # What is not published: charts of times of this machine, and the data of scenes without one.
    for group, scenes in SETS.items():
        blocks = config.variants[group].items()
        charts = [scene for scene, block in blocks if is_measured(block) and block.formats]
        measured = [drawn(scene, "png", group) for scene in charts]
        for kind, results in (("measured", measured), ("data", config.data_only(group))):
            rows = [(PurePath(path).stem, path, freshness.state(path)) for path in results]
            _print(f"{scenes.command}, {kind}", rows)
    for name in config.own_variants:
        files: dict[str, list[str]] = {}  # state -> the variant's files that have it
        for _, drawing in config.figures(name).values():
            files.setdefault(freshness.state(drawing), []).append(PurePath(drawing).name)
        for scene, reason in config.left_out[name].items():
            files.setdefault(reason, []).append(f"{scene}.png")
        own += [(name, state, " ".join(names)) for state, names in files.items()]
    _print("./reproduce variant NAME", own)
    return 0


def _published(freshness: Freshness, published_set: PublishedSet) -> Iterator[Sequence[str]]:
    """Yield scene, file and state of each file of a published set.

    The state says how the file compares with the committed one or, if it is stale, why. That it is
    stale follows from the record of its drawing or, without a drawing, from the manifest's config.
    """
    from ...checks import manifest  # takes long to import

    try:
        committed = manifest.read(ROOT, published_set.folder)
    except ChecksumError:
        committed = {"results": {}}
    for name, drawing in published_set.drawn.items():
        scene, path = PurePath(name).stem, f"{published_set.folder}/{name}"
        state, made = committed_state(ROOT, path), freshness.state(drawing)
        if made == MISSING and drawing in committed["results"]:
            record = manifest.record_of(committed, drawing)
            words = differing_layers(record, freshness.here(drawing)).get("config")
            made = f"stale: {words}" if words else MISSING
        known = state == MISSING or made in (CURRENT, MISSING)
        yield scene, path, state if known else made


def _print(title: str, rows: Sequence[Sequence[str]]) -> None:
    """Print rows below a title, nothing without rows."""
    if rows:
        print(title, *(f"  {line}" for line in columns(rows)), "", sep="\n")
