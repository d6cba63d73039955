"""./reproduce verify and accept: whether this tree has the committed figures, and if not, why.

Nothing is computed again. Both print to stdout and return an exit status.
"""

import argparse
from pathlib import Path

from .. import config
from ..records.provenance import file_hash
from . import contract as contracts
from . import manifest
from .audit import audit
from .layers import Comparison

_UPSTREAM = {"config", "source", "environment"}


def verify(root, arguments, start="."):
    """Compare the tree at `root` with the contract; 0 when every figure is identical.

    A relative folder in the arguments is seen from `start`.
    """
    parser = argparse.ArgumentParser(
        prog="reproduce verify",
        description="Say for each figure whether it is the committed one, or the first layer that "
        "differs: config, source, environment, data, drawing or file.",
    )
    parser.add_argument(
        "--against",
        type=Path,
        metavar="FOLDER",
        help="another tree or its results: how many ulp lie between its data and these",
    )
    against = parser.parse_args(arguments).against
    if against is not None:
        against = Path(start) / against
        if not against.is_dir():
            print(f"reproduce verify: no folder {against}")
            return 1
    status = 0
    for contract in _contracts(root):
        status |= _verify(root, contract, against)
    return status


def _contracts(root):
    """What verify looks at: the study's charts only where their contract is committed."""
    scenes = config.load(root / "config.yaml")["scenes"]
    yield contracts.paper(scenes)
    study = contracts.study(scenes)
    if any((root / study.folder / name).exists() for name in (manifest.MANIFEST, manifest.SUMS)):
        yield study


def _verify(root, contract, against):
    findings = []
    try:
        committed = manifest.read(root, contract.folder)
        verdicts = _by_layers(Comparison(root, contract, committed, against), contract.figures)
        findings += _surplus(root, contract, manifest.figures(committed))
    except manifest.ContractError as error:
        committed = None
        findings.append(f"{error}: the layers cannot be compared")
        verdicts = {}
    findings += _sums(root, contract, committed)
    width = max(len(name) for name in contract.names)
    for path in contract.figures:
        name = Path(path).name
        print(f"{name:{width}}  {verdicts.get(path) or _by_sums(root, path)}")
    problems, missing = audit(root, contract.makers)
    findings += _grouped(problems, verdicts.values())
    identical = sum(verdict == "identical" for verdict in verdicts.values())
    print()
    for finding in findings:
        print(finding)
    _say_what_is_missing(contract, missing)
    print(f"{identical} of {len(contract.figures)} {contract.what} identical", end="")
    print(f"; {len(findings)} other finding{'s' * (len(findings) > 1)}" if findings else "")
    return 0 if identical == len(contract.figures) and not findings else 1


def accept(root, arguments):
    """Renew the contract from complete and current results; 1, and nothing done, without them.

    That of the study is renewed if its results are there, and otherwise stays as it is.
    """
    parser = argparse.ArgumentParser(
        prog="reproduce accept",
        description="Make the figures, and the study's charts where they were made, as they are "
        "now the committed ones, and say what changed.",
    )
    parser.parse_args(arguments)
    scenes = config.load(root / "config.yaml")["scenes"]
    paper, study = contracts.paper(scenes), contracts.study(scenes)
    problem = _not_ready(root, paper)
    if problem:
        print(f"reproduce accept: {problem}: run ./reproduce first")
        return 1
    _accept(root, paper)
    if any((root / path).exists() for path in study.makers):
        problem = _not_ready(root, study)
        if problem:
            print(f"{study.folder} stays as it is: {problem}: run ./reproduce study first")
        else:
            _accept(root, study)
    return 0


def _accept(root, contract):
    folder, files = contract.folder, contract.figures
    try:
        committed = manifest.read(root, folder)
        sums = manifest.read_sums(root, folder)
    except manifest.ContractError as error:
        committed = sums = None
        changes = [f"a new contract ({error})"]
    else:
        comparison = Comparison(root, contract, committed)
        changes = []
        for path, scene in files.items():
            name = Path(path).name
            layers = list(comparison.findings(scene, name))
            changes += [f"{name}  {layer}: {words}" for layer, words in layers]
            if layers and {layer for layer, _ in layers} <= _UPSTREAM:
                changes.append(f"{name}  the file is the same")
        changes += _surplus(root, contract, manifest.figures(committed))
    fresh = manifest.build(root, contract)
    if fresh == committed and sums == manifest.sums(fresh):
        print("nothing changed" if folder == manifest.FOLDER else f"{folder}: nothing changed")
        return
    manifest.write(root, folder, fresh)
    for change in changes or [f"other changes behind the same {contract.what}"]:
        print(change)
    renewed = f"{folder}/{manifest.SUMS} and {folder}/{manifest.MANIFEST} renewed"
    print(f"{renewed}: {len(files)} {contract.what}")


def _by_layers(comparison, files):
    """Each figure -> `identical`, or the first layer that differs and how."""
    verdicts = {}
    for path, scene in files.items():
        layers = list(comparison.findings(scene, Path(path).name))
        if not layers:
            verdicts[path] = "identical"
            continue
        layer, words = layers[0]
        verdicts[path] = f"{layer}: {words}"
        if {layer for layer, _ in layers} <= _UPSTREAM and comparison.file_hash(path):
            verdicts[path] += " (the file is as committed)"
    return verdicts


def _by_sums(root, path):
    """The verdict where there is no manifest to ask."""
    try:
        wanted = manifest.read_sums(root, Path(path).parent).get(Path(path).name)
    except manifest.ContractError:
        wanted = None
    digest = file_hash(root / path)
    if digest is None:
        return "file: missing"
    if wanted is None:
        return "file: nothing to compare it with"
    return "file: as in SHA256SUMS" if digest == wanted else "file: differs from SHA256SUMS"


def _sums(root, contract, committed):
    """What is wrong with SHA256SUMS, the files apart."""
    try:
        sums = manifest.read_sums(root, contract.folder)
    except manifest.ContractError as error:
        return [str(error)]
    path = f"{contract.folder}/{manifest.SUMS}"
    found = [f"{path}: no line for {name}" for name in sorted(contract.names - set(sums))]
    found += [
        f"{path}: a line for {name}, which config.yaml does not publish"
        for name in sorted(set(sums) - contract.names)
    ]
    if committed is not None:
        for name, entry in manifest.figures(committed).items():
            if sums.get(name, entry["sha256"]) != entry["sha256"]:
                found.append(f"{path}: not the hash of {name} that MANIFEST.json has")
    return found


def _surplus(root, contract, listed):
    """Files that are there or in the manifest but that nothing makes."""
    folder, names = contract.folder, contract.names
    found = [
        f"{folder}/{manifest.MANIFEST}: lists {name}, which config.yaml does not publish"
        for name in sorted(set(listed) - names)
    ]
    there = {path.name for path in (root / folder).glob("[!.]*") if path.suffix[1:] in config.SHOWN}
    return found + [
        f"{folder}/{name}: no scene of config.yaml makes it"
        for name in sorted(there - names - set(listed) - set(contract.measured))
    ]


def _grouped(problems, verdicts):
    """One line for each kind of problem, without the results that a figure's verdict names."""
    kinds = {}
    for path, problem in problems.items():
        if not any(f"{path}:" in verdict for verdict in verdicts):
            kinds.setdefault(problem, []).append(path)
    return [f"{_listed(paths)}: {problem}" for problem, paths in kinds.items()]


def _listed(paths):
    more = f" and {len(paths) - 4} more" if len(paths) > 5 else ""
    return ", ".join(paths[:4] if more else paths) + more


def _say_what_is_missing(contract, missing):
    if set(missing) == set(contract.makers):
        how = contract.command.format("").strip()
        print(f"no results here: only the committed files were checked ({how} makes the rest)")
    elif missing:
        print(f"not checked, since not there: {_listed(missing)}")


def _not_ready(root, contract):
    """Why the results cannot be accepted, or None."""
    problems, missing = audit(root, contract.makers)
    if missing:
        return f"{missing[0]} is missing"
    for path, problem in problems.items():
        return f"{path}: {problem}"
    for path in contract.figures:
        drawing = contract.drawn[Path(path).name]
        if file_hash(root / path) != file_hash(root / drawing):
            return f"{path} is not {drawing}"
    return None
