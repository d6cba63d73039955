"""./reproduce list: show what can be made and the state of each file."""

from collections.abc import Iterator, Sequence
from pathlib import PurePath

from ...checks.freshness import CURRENT, MISSING, Freshness
from ...checks.published_sets import ChecksumError, PublishedSet, committed_sets, committed_state
from ...config import paths
from ...config.build_specs import build_specs
from ...config.schema.sets import SETS
from ...records.differences import columns, differing_block
from ...records.sources import ROOT
from ..arguments import Arguments


def run(args: Arguments) -> int:
    """Print every figure, chart and dataset below the command that makes it."""
    variants = args.checked.variants
    freshness = Freshness(ROOT, build_specs(args.checked))
    for published_set in committed_sets(args.checked):
        _print(published_set.command, [*_published(freshness, published_set)])
    for group, scenes in SETS.items():
        apart = [s for s, block in variants[group].items() if paths.is_measured(block)]
        measured = [paths.drawn(s, "png", group) for s in apart if variants[group][s].formats]
        data = [path for found in paths.data_only(variants, group).values() for path in found]
        for kind, results in (("measured", measured), ("data", data)):
            rows = [(PurePath(path).stem, path, freshness.state(path)) for path in results]
            _print(f"{scenes.command}, {kind}", rows)
    rows = []
    for name in args.checked.own_variants:
        files: dict[str, list[str]] = {}
        for _, upstream in paths.figures(variants, name).values():
            files.setdefault(freshness.state(upstream[-1]), []).append(PurePath(upstream[-1]).name)
        for scene, reason in args.checked.left_out[name].items():
            files.setdefault(reason, []).append(f"{scene}.png")
        rows += [(name, state, " ".join(files[state])) for state in files]
    _print("./reproduce variant NAME", rows)
    return 0


def _published(freshness: Freshness, published_set: PublishedSet) -> Iterator[Sequence[str]]:
    """Yield scene, file and state of each file of a published set.

    Whether a file is stale follows from its drawing's record or, without one, from the manifest.
    """
    from ...checks import manifest  # takes long to import

    try:
        scenes = manifest.read(ROOT, published_set.folder)["scenes"]
    except ChecksumError:
        scenes = {}
    for name, drawing in published_set.drawn.items():
        scene, path = PurePath(name).stem, f"{published_set.folder}/{name}"
        state, made = committed_state(ROOT, path), freshness.state(drawing)
        if made == MISSING and scene in scenes:
            blocks = scenes[scene]["config"], published_set.config[scene]
            made = f"stale: {words}" if (words := differing_block(*blocks)) else MISSING
        known = state == MISSING or made in (CURRENT, MISSING)
        yield scene, path, state if known else made


def _print(title: str, rows: Sequence[Sequence[str]]) -> None:
    """Print rows below a title, nothing without rows."""
    if rows:
        print(title, *(f"  {line}" for line in columns(rows)), "", sep="\n")
