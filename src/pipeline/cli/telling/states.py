"""How published files stand to the committed ones and to what this tree would make."""

from ...checks.currency import MISSING, Currency
from ...checks.sums import ContractError, known_sums
from ...records.files import file_hash
from ...records.sources import ROOT
from .plan import changes, why

IDENTICAL, DIFFERS, NEW = "identical", "differs", "not committed"
_LISTED = {IDENTICAL: "identical to the committed one", DIFFERS: "not the committed one"}


def committed(folder, paths) -> dict[str, str]:
    """Each of the files in the folder of a contract -> whether it is the committed one."""
    sums, found = known_sums(ROOT, folder), {}
    for path in (path for path in paths if path.startswith(f"{folder}/")):
        name, digest = path.removeprefix(f"{folder}/"), file_hash(ROOT / path)
        same = IDENTICAL if digest == sums.get(name) else DIFFERS
        found[path] = MISSING if digest is None else same if name in sums else NEW
    return found


def states(contract) -> list[tuple[str, str, str]]:
    """(scene, file, state) of each file of a contract.

    What is stale is told by the record of its drawing, and where there is none by the manifest.
    """
    from ...checks import manifest  # takes a while

    currency, files = Currency(ROOT, contract.expected), contract.drawn
    as_committed = committed(contract.folder, [f"{contract.folder}/{name}" for name in files])
    try:
        scenes = manifest.read(ROOT, contract.folder)["scenes"]
    except ContractError:
        scenes = {}
    rows = []
    for name, drawing in contract.drawn.items():
        scene, path = contract.scenes[name], f"{contract.folder}/{name}"
        state, stale = as_committed[path], None
        if file_hash(ROOT / drawing):
            outdated = list(currency.outdated([*contract.data[scene].values(), drawing]))
            stale = why(currency, outdated) if outdated else None
        elif scene in scenes:
            stale = changes(scenes[scene]["config"], contract.config[scene])
        told = f"stale: {stale}" if stale and state != MISSING else _LISTED.get(state, state)
        rows.append((scene, path, told))
    return rows
