"""./reproduce list [NAME ...]: show what can be made and the state of each file."""

from collections.abc import Iterator
from pathlib import PurePath

from ...checks.published_sets import PublishedSet, committed_sets, committed_state
from ...config.results import drawn, is_measured
from ...config.schema.parts import SETS
from ...records.differences import differing_layers
from ...records.files import FileError
from ...records.provenance import CURRENT, MISSING, Freshness
from ...records.sources import ROOT
from ..arguments import Arguments, hint
from ..errors import CommandLineError
from ..table import FileRow, print_files, print_lines, wrapped


def run(args: Arguments) -> int:
    """Print every figure, chart and dataset, or the named ones, below the command that makes it."""
    config, wanted = args.config, args.name
    scenes = {scene for group in config.variants.values() for scene in group}
    for name in wanted:
        if name not in (known := [*config.variants, *config.ranges, *sorted(scenes)]):
            raise CommandLineError(f"no figure, set or variant {name}{hint(name, known)}")
    wanted = [each for name in wanted for each in (name, *config.members(name))]

    def is_wanted(group: str, scene: str) -> bool:
        return not wanted or group in wanted or scene in wanted

    freshness = Freshness(ROOT, config.build_specs())
    for each in committed_sets(config):
        rows = _published(freshness, each)
        rows = (row for row in rows if is_wanted(each.group, PurePath(row[0]).stem))
        print_files(f"{each.command}: ", rows)
    # What is not published: charts of times of this machine, and the data of scenes without one, or
    # of named scenes.
    for group, declared in SETS.items():
        blocks = {s: b for s, b in config.variants[group].items() if is_wanted(group, s)}
        charts = [scene for scene, block in blocks.items() if is_measured(block) and block.formats]
        measured = [drawn(scene, "png", group) for scene in charts]
        with_data = [s for s, block in blocks.items() if not block.formats or s in wanted]
        data = [path for scene in with_data for path in config.data_of(group, scene).values()]
        for kind, results in (("measured", measured), ("data", data)):
            rows = ((path, "", (freshness.state(path),)) for path in results)
            print_files(f"{declared.command}, {kind}: ", rows)
    own = list[str]()  # lines about the variants of the paper
    for name in config.own_variants:
        scenes_by = dict[str, dict[str, None]]()  # state -> the variant's scenes that have it
        states = {s: freshness.state(path) for s, path in config.figures(name).values()}
        for scene, state in (states | config.left_out[name]).items():
            if is_wanted(name, scene):
                scenes_by.setdefault(state, {})[scene] = None
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
    except FileError:
        committed = {"results": {}}
    for name, drawing in published_set.drawn.items():
        path = f"{published_set.folder}/{name}"
        state, made = committed_state(ROOT, path), freshness.state(drawing)
        if made == MISSING and drawing in committed["results"]:
            record = manifest.record_of(committed, drawing)
            words = differing_layers(record, freshness.build_specs[drawing]._asdict()).get("config")
            made = f"stale: {words}" if words else MISSING
        known = state == MISSING or made in (CURRENT, MISSING)
        yield path, "", (state if known else made,)
