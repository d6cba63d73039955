"""Make what is here the committed state: renew the contracts from complete and current results."""

import shutil

from ..records.files import file_hash, obstacle, replacing
from . import contracts, manifest
from .currency import MISSING
from .difference import UPSTREAM, Comparison, not_as_made
from .sums import SUMS, ContractError, left_over, read_sums


def accept(root, checked):
    """Renew the contract of the paper, and those of other results that are here.

    Charts that are measured are published too, without a contract. 1 is returned where the
    results of the paper are not all there and current.
    """
    for contract in contracts.committed(checked):
        if contract.on_request and not any((root / p).exists() for p in contract.expected):
            continue
        problem = _not_ready(root, contract)
        if problem is None:
            _publish_measured(root, contract)
            _renew(root, contract)
        elif contract.on_request:
            print(f"{contract.folder} stays as it is: {problem}: run {contract.command} first")
        else:
            print(f"reproduce accept: {problem}: run {contract.command} first")
            return 1
    return 0


def _not_ready(root, contract):
    """Why the results cannot be accepted, or None."""
    for path, why in not_as_made(root, contract).items():
        return f"{path} is missing" if why == MISSING else f"{path}: {why}"
    for name, drawing in contract.drawn.items():
        if words := obstacle(root / contract.folder / name):
            return f"{contract.folder}/{name}: {words}"
        if file_hash(root / contract.folder / name) != file_hash(root / drawing):
            return f"{contract.folder}/{name} is not {drawing}"
    return None


def _publish_measured(root, contract):
    for name in contract.measured:
        drawing = root / contract.results / "figures" / name
        if drawing.is_file():
            with replacing(root / contract.folder / name) as part:
                shutil.copyfile(drawing, part)


def _renew(root, contract):
    folder = contract.folder
    try:
        committed = manifest.read(root, folder)
        sums = read_sums(root, folder)
    except ContractError as error:
        committed = sums = None
        changes = [f"a new contract ({error})"]
    else:
        changes = _changes(Comparison(root, contract, committed), contract, committed)
    fresh = manifest.build(root, contract)
    if fresh == committed and sums == manifest.sums(fresh):
        print(f"{folder}: nothing changed")
        return
    manifest.write(root, folder, fresh)
    print(*(changes or [f"other changes behind the same {contract.what}"]), sep="\n")
    renewed = f"{folder}/{SUMS} and {folder}/{manifest.MANIFEST} renewed"
    print(f"{renewed}: {len(contract.drawn)} {contract.what}")


def _changes(comparison, contract, committed):
    changes = []
    for name in contract.drawn:
        layers = comparison.layers(name)
        if layers is None:
            changes.append(f"{name}  new")
            continue
        changes += [f"{name}  {layer}: {words}" for layer, words in layers.items()]
        if layers and set(layers) <= UPSTREAM:
            changes.append(f"{name}  the file is the same")
    gone = sorted(set(manifest.figures(committed)) - set(contract.drawn))
    left = left_over(comparison.root, contract.folder, {*contract.drawn, *contract.measured})
    return changes + [f"{name}  gone" for name in gone] + left
