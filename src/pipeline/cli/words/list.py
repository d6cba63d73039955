"""./reproduce list: what there can be, and the state of each file."""

from ...checks import contracts
from ...checks.currency import MISSING, Currency
from ...config import PUBLISHED, expected, places
from ...config import figures as figures_of
from ...config.checking.reading import load
from ...config.declared import study as parts
from ...records.differences import columns
from ...records.sources import ROOT
from .. import figures, running
from ..telling.plan import why
from ..telling.states import states


def run(given) -> int:
    """Print every figure, chart and dataset under the command that makes it."""
    checked = load(ROOT / "config.yaml")
    variants, sweeps = checked["variants"], checked["sweeps"]
    for contract in contracts.committed(checked):
        _print(contract.command, states(contract))
    measured = [parts.drawn(c) for c in parts.CHARTS if parts.CHARTS[c][0] in parts.MEASURED]
    _print("./reproduce study, measured", _results(expected.of_study(variants), measured))
    datasets = [places.sweep_dataset(name) for name in sweeps]
    _print("./reproduce sweep", _results(expected.of_sweeps(sweeps), datasets))
    made, rows = expected.of_variants(variants), []
    for name in variants:
        if name not in PUBLISHED:
            drawn = {behind[-1]: s for s, behind in figures_of(variants, name).values()}
            found = _results(made, drawn, figures.known_absent(name), drawn)
            kinds = dict.fromkeys(state for *_, state in found)
            for kind in kinds:
                files = [path.rpartition("/")[2] for _, path, state in found if state == kind]
                rows.append((name, kind, " ".join(files)))
    _print("./reproduce variant NAME", rows)
    return 0


def _results(made, paths, absent=(), scenes=None):
    """(scene, file, state) of results that are not published."""
    currency, rows = Currency(ROOT, made), []
    for path in paths:
        scene = (scenes or {}).get(path, path.rpartition("/")[2].partition(".")[0])
        state = "current"
        if scene in absent:
            state = f"cannot exist: {absent[scene]}"
        elif not (ROOT / path).is_file():
            state = MISSING
        elif currency.reason(path):
            behind = [p for p in running.needed(made, [path]) if p in made]
            state = f"stale: {why(currency, list(currency.outdated(behind)))}"
        rows.append((scene, path, state))
    return rows


def _print(title, rows):
    if rows:
        print(title, *(f"  {line}" for line in columns(rows)), "", sep="\n")
