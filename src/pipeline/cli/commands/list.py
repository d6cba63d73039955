"""./reproduce list: show what can be made and the state of each file."""

from collections.abc import Iterator

from ...checks.published_sets import ChecksumError, PublishedSet, committed_sets, committed_state
from ...config.results import drawn, is_measured
from ...config.schema.sets import SETS
from ...records.differences import differing_layers
from ...records.provenance import CURRENT, MISSING, Freshness
from ...records.sources import ROOT
from ..arguments import Arguments
from ..table import FileRow, print_files, print_lines, wrapped


def run(args: Arguments) -> int:
    """Print every figure, chart and dataset below the command that makes it."""
    config = args.config
    own = list[str]()  # lines about the variants of the paper
    freshness = Freshness(ROOT, config.build_specs())
    for published_set in committed_sets(config):
        print_files(f"{published_set.command}: ", _published(freshness, published_set))
    # What is not published: charts of times of this machine, and the data of scenes without one.
    for group, scenes in SETS.items():
        blocks = config.variants[group].items()
        charts = [scene for scene, block in blocks if is_measured(block) and block.formats]
        measured = [drawn(scene, "png", group) for scene in charts]
        for kind, results in (("measured", measured), ("data", config.data_only(group))):
            rows = [(path, "", (freshness.state(path),)) for path in results]
            print_files(f"{scenes.command}, {kind}: ", rows)
    for name in config.own_variants:
        scenes_by = dict[str, dict[str, None]]()  # state -> the variant's scenes that have it
        for scene, drawing in config.figures(name).values():
            scenes_by.setdefault(freshness.state(drawing), {})[scene] = None
        for scene, reason in config.left_out[name].items():
            scenes_by.setdefault(reason, {})[scene] = None
        own += [f"{name}: {' '.join(names)}: {state}" for state, names in scenes_by.items()]
    if own:
        print("\n./reproduce variant NAME")
        print_lines(line for text in own for line in wrapped(text))
    return 0


def _published(freshness: Freshness, published_set: PublishedSet) -> Iterator[FileRow]:
    """Yield path and state of each file of a published set.

    The state says how the file compares with the committed one or, if it is stale, why. That it is
    stale follows from the record of its drawing or, without a drawing, from the manifest's config.
    """
    from ...checks import manifest  # takes long to import

    try:
        committed = manifest.read(ROOT, published_set.folder)
    except ChecksumError:
        committed = {"results": {}}
    for name, drawing in published_set.drawn.items():
        path = f"{published_set.folder}/{name}"
        state, made = committed_state(ROOT, path), freshness.state(drawing)
        if made == MISSING and drawing in committed["results"]:
            record = manifest.record_of(committed, drawing)
            words = differing_layers(record, freshness.here(drawing)).get("config")
            made = f"stale: {words}" if words else MISSING
        known = state == MISSING or made in (CURRENT, MISSING)
        yield path, "", (state if known else made,)
