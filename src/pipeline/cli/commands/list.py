"""./reproduce list [NAME ...]: show what can be made and the state of each file."""

import json
from collections.abc import Collection, Iterator
from itertools import groupby
from pathlib import PurePath

from ...checks.published_sets import PublishedSet, committed_sets, committed_state
from ...config import Config
from ...config.results import drawn
from ...config.schema.parts import SETS
from ...records.differences import differing_layers
from ...records.files import FileError
from ...records.provenance import CURRENT, MISSING, Freshness
from ...records.sources import ROOT
from ..arguments import Arguments, hint
from ..errors import CommandLineError
from ..table import print_files, print_lines, wrapped

# The fields of a file that --json prints. The kind is figure, data, or variant (a figure of a
# variant); `variant` may be a set of scenes.
_KEYS = ("command", "kind", "variant", "scene", "path", "state")
_File = tuple[str, str, str, str, str, str]


def run(args: Arguments) -> int:
    """Print every figure, chart and dataset, or the named ones, below the command that makes it."""
    config, wanted = args.config, args.name
    scenes = {scene for group in config.variants.values() for scene in group}
    for name in wanted:
        if name not in (known := [*config.variants, *config.ranges, *sorted(scenes)]):
            raise CommandLineError(f"no figure, set or variant {name}{hint(name, known)}")
    wanted = [each for name in wanted for each in (name, *config.members(name))]
    files = [each for each in _files(config, wanted) if not wanted or {*each[2:4]} & {*wanted}]
    if args.json:
        print(json.dumps([dict(zip(_KEYS, each, strict=True)) for each in files], indent=1))
        return 0
    own = dict[tuple[str, str], dict[str, None]]()  # variant of the paper, state -> its scenes
    for (command, kind), group in groupby(files, lambda file: file[:2]):
        if kind != "variant":
            title = command if kind == "figure" else f"{command}, {kind}"
            print_files(f"{title}: ", ((path, "", (state,)) for *_, path, state in group))
            continue
        for _, _, variant, scene, _, state in group:
            own.setdefault((variant, state), {})[scene] = None
    if own:
        print("\n./reproduce variant NAME")
        lines = (f"{name}: {' '.join(names)}: {state}" for (name, state), names in own.items())
        print_lines(line for text in lines for line in wrapped(text))
    return 0


def _files(config: Config, wanted: Collection[str]) -> Iterator[_File]:
    """Yield every file that is published, and some that are not.

    These are the data of scenes without a picture or of the `wanted` ones, and the figures of
    variants.
    """
    freshness = Freshness(ROOT, config.build_specs())
    for each in committed_sets(config):
        for path, state in _published(freshness, each):
            yield each.command, "figure", each.group, PurePath(path).stem, path, state
    for group, declared in SETS.items():
        for scene, block in config.variants[group].items():
            if not block.formats or scene in wanted:
                for path in config.data_of(group, scene).values():
                    yield declared.command, "data", group, scene, path, freshness.state(path)
    for name in config.own_variants:
        states = {path: (s, freshness.state(path)) for s, path in config.figures(name).values()}
        states |= {drawn(s, "png", name): (s, why) for s, why in config.left_out[name].items()}
        for path, (scene, state) in states.items():
            yield f"./reproduce variant {name}", "variant", name, scene, path, state


def _published(freshness: Freshness, published_set: PublishedSet) -> Iterator[tuple[str, str]]:
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
        yield path, state if known else made
