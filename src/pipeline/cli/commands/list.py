"""./reproduce list: what there can be, and the state of each file."""

from pathlib import PurePath

from ...checks import published_sets
from ...checks.freshness import MISSING, Freshness
from ...config import PUBLISHED, build_specs, paths
from ...config.schema import study as parts
from ...records.differences import columns
from ...records.sources import ROOT
from .. import figures
from ..progress.plan import why
from ..progress.states import states


def run(args) -> int:
    """Print every figure, chart and dataset under the command that makes it."""
    variants, sweeps = args.checked["variants"], args.checked["sweeps"]
    freshness = Freshness(ROOT, build_specs.of_all(args.checked))
    for published_set in published_sets.committed_sets(args.checked):
        _print(published_set.command, states(published_set))
    measured = [parts.drawn(c) for c in parts.CHARTS if parts.CHARTS[c][0] in parts.MEASURED]
    _print("./reproduce study, measured", _states(freshness, measured))
    _print("./reproduce sweep", _states(freshness, map(paths.sweep_dataset, sweeps)))
    rows = []
    for name in (name for name in variants if name not in PUBLISHED):
        drawn = [behind[-1] for _, behind in paths.figures(variants, name).values()]
        found = _states(freshness, drawn, figures.known_absent(freshness, variants, name))
        for kind in dict.fromkeys(state for *_, state in found):
            files = [PurePath(path).name for _, path, state in found if state == kind]
            rows.append((name, kind, " ".join(files)))
    _print("./reproduce variant NAME", rows)
    return 0


def _states(freshness, results, absent=()):
    """(scene, file, state) of results that are not published."""
    rows = []
    for path in results:
        scene, state = PurePath(path).stem, "current"
        if scene in absent:
            state = f"cannot exist: {absent[scene]}"
        elif not (ROOT / path).is_file():
            state = MISSING
        elif freshness.reason(path):
            outdated = freshness.outdated(
                build_specs.with_dependencies(freshness.build_specs, [path])
            )
            state = f"stale: {why(freshness, list(outdated))}"
        rows.append((scene, path, state))
    return rows


def _print(title, rows):
    if rows:
        print(title, *(f"  {line}" for line in columns(rows)), "", sep="\n")
