"""./reproduce list: what there can be, and the state of each file."""

from pathlib import PurePath

from ...checks import contracts
from ...checks.currency import MISSING, Currency
from ...config import PUBLISHED, expected, places
from ...config.declared import study as parts
from ...records.differences import columns
from ...records.sources import ROOT
from .. import figures
from ..telling.plan import why
from ..telling.states import states


def run(given) -> int:
    """Print every figure, chart and dataset under the command that makes it."""
    variants, sweeps = given.checked["variants"], given.checked["sweeps"]
    currency = Currency(ROOT, expected.of_all(given.checked))
    for contract in contracts.committed(given.checked):
        _print(contract.command, states(contract))
    measured = [parts.drawn(c) for c in parts.CHARTS if parts.CHARTS[c][0] in parts.MEASURED]
    _print("./reproduce study, measured", _states(currency, measured))
    _print("./reproduce sweep", _states(currency, map(places.sweep_dataset, sweeps)))
    rows = []
    for name in (name for name in variants if name not in PUBLISHED):
        drawn = [behind[-1] for _, behind in places.figures(variants, name).values()]
        found = _states(currency, drawn, figures.known_absent(currency, variants, name))
        for kind in dict.fromkeys(state for *_, state in found):
            files = [PurePath(path).name for _, path, state in found if state == kind]
            rows.append((name, kind, " ".join(files)))
    _print("./reproduce variant NAME", rows)
    return 0


def _states(currency, paths, absent=()):
    """(scene, file, state) of results that are not published."""
    rows = []
    for path in paths:
        scene, state = PurePath(path).stem, "current"
        if scene in absent:
            state = f"cannot exist: {absent[scene]}"
        elif not (ROOT / path).is_file():
            state = MISSING
        elif currency.reason(path):
            outdated = currency.outdated(expected.needed(currency.expected, [path]))
            state = f"stale: {why(currency, list(outdated))}"
        rows.append((scene, path, state))
    return rows


def _print(title, rows):
    if rows:
        print(title, *(f"  {line}" for line in columns(rows)), "", sep="\n")
