"""./reproduce list: show what can be made and the state of each file."""

from collections.abc import Iterable, Sequence
from pathlib import PurePath

from ...checks import published_sets
from ...checks.freshness import MISSING, Freshness
from ...config import PUBLISHED, build_specs, paths
from ...config.schema import study as parts
from ...records.differences import columns
from ...records.sources import ROOT
from .. import figures
from ..arguments import Arguments
from ..progress import Row, staleness, states


def run(args: Arguments) -> int:
    """Print every figure, chart and dataset below the command that makes it."""
    variants, sweeps = args.checked["variants"], args.checked["sweeps"]
    freshness = Freshness(ROOT, build_specs.of_all(args.checked))
    for published_set in published_sets.committed_sets(args.checked):
        _print(published_set.command, states(published_set))
    measured = [parts.drawn(c) for c in parts.CHARTS if parts.CHARTS[c][0] in parts.MEASURED]
    _print("./reproduce study, measured", _states(freshness, measured, {}))
    _print("./reproduce sweep", _states(freshness, map(paths.sweep_dataset, sweeps), {}))
    rows = []
    for name in (name for name in variants if name not in PUBLISHED):
        drawings = [upstream[-1] for _, upstream in paths.figures(variants, name).values()]
        absent = figures.absent(args.checked, name, freshness)
        files: dict[str, list[str]] = {}
        for _, path, state in _states(freshness, drawings, absent):
            files.setdefault(state, []).append(PurePath(path).name)
        rows += [(name, state, " ".join(files[state])) for state in files]
    _print("./reproduce variant NAME", rows)
    return 0


def _states(freshness: Freshness, results: Iterable[str], absent: dict[str, str]) -> list[Row]:
    """Return (scene, file, state) of results that are not published."""
    rows = []
    for path in results:
        scene = PurePath(path).stem
        state = f"cannot exist: {absent[scene]}" if scene in absent else MISSING
        if scene not in absent and (ROOT / path).is_file():
            state = staleness(freshness, path) or "current"
        rows.append((scene, path, state))
    return rows


def _print(title: str, rows: Sequence[Row]) -> None:
    """Print rows below a title, nothing without rows."""
    if rows:
        print(title, *(f"  {line}" for line in columns(rows)), "", sep="\n")
