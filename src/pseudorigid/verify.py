"""./reproduce verify and accept: whether this tree has the committed figures, and if not, why.

Nothing is computed again. Both print to stdout and return an exit status.
"""

import argparse
from pathlib import Path

from . import config, manifest
from .audit import audit
from .layers import Comparison
from .provenance import file_hash

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
    scenes = config.load(root / "config.yaml")["scenes"]
    files = manifest.published(scenes)
    findings = []
    try:
        committed = manifest.read(root)
        verdicts = _by_layers(Comparison(root, scenes, committed, against), files)
        findings += _surplus(root, files, manifest.figures(committed))
    except manifest.ContractError as error:
        committed = None
        findings.append(f"{error}: the layers cannot be compared")
        verdicts = {}
    findings += _sums(root, files, committed)
    width = max(len(Path(path).name) for path in files)
    for path in files:
        name = Path(path).name
        print(f"{name:{width}}  {verdicts.get(path) or _by_sums(root, path)}")
    problems, missing = audit(root, scenes)
    findings += _grouped(problems, verdicts.values())
    identical = sum(verdict == "identical" for verdict in verdicts.values())
    print()
    for finding in findings:
        print(finding)
    _say_what_is_missing(scenes, missing)
    print(f"{identical} of {len(files)} figures identical", end="")
    print(f"; {len(findings)} other finding{'s' * (len(findings) > 1)}" if findings else "")
    return 0 if identical == len(files) and not findings else 1


def accept(root, arguments):
    """Renew the contract from complete and current results; 1, and nothing done, without them."""
    parser = argparse.ArgumentParser(
        prog="reproduce accept",
        description="Make the figures as they are now the committed ones, and say what changed.",
    )
    parser.parse_args(arguments)
    scenes = config.load(root / "config.yaml")["scenes"]
    problem = _not_ready(root, scenes)
    if problem:
        print(f"reproduce accept: {problem}: run ./reproduce first")
        return 1
    files = manifest.published(scenes)
    try:
        committed = manifest.read(root)
        sums = manifest.read_sums(root)
    except manifest.ContractError as error:
        committed = sums = None
        changes = [f"a new contract ({error})"]
    else:
        comparison = Comparison(root, scenes, committed)
        changes = []
        for path, scene in files.items():
            name = Path(path).name
            layers = list(comparison.findings(scene, name))
            changes += [f"{name}  {layer}: {words}" for layer, words in layers]
            if layers and {layer for layer, _ in layers} <= _UPSTREAM:
                changes.append(f"{name}  the file is the same")
        changes += _surplus(root, files, manifest.figures(committed))
    fresh = manifest.build(root, scenes)
    if fresh == committed and sums == manifest.sums(fresh):
        print("nothing changed")
        return 0
    manifest.write(root, fresh)
    for change in changes or ["other changes behind the same figures"]:
        print(change)
    print(f"{manifest.SUMS} and {manifest.MANIFEST} renewed: {len(files)} figures")
    return 0


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
        wanted = manifest.read_sums(root).get(Path(path).name)
    except manifest.ContractError:
        wanted = None
    digest = file_hash(root / path)
    if digest is None:
        return "file: missing"
    if wanted is None:
        return "file: nothing to compare it with"
    return "file: as in SHA256SUMS" if digest == wanted else "file: differs from SHA256SUMS"


def _sums(root, files, committed):
    """What is wrong with SHA256SUMS, figures apart."""
    try:
        sums = manifest.read_sums(root)
    except manifest.ContractError as error:
        return [str(error)]
    names = {Path(path).name for path in files}
    found = [f"{manifest.SUMS}: no line for {name}" for name in sorted(names - set(sums))]
    found += [
        f"{manifest.SUMS}: a line for {name}, which config.yaml does not publish"
        for name in sorted(set(sums) - names)
    ]
    if committed is not None:
        for name, entry in manifest.figures(committed).items():
            if sums.get(name, entry["sha256"]) != entry["sha256"]:
                found.append(f"{manifest.SUMS}: not the hash of {name} that MANIFEST.json has")
    return found


def _surplus(root, files, listed):
    """Figures that are there or in the manifest but not in the config."""
    names = {Path(path).name for path in files}
    found = [
        f"{manifest.MANIFEST}: lists {name}, which config.yaml does not publish"
        for name in sorted(set(listed) - names)
    ]
    there = {
        path.name
        for path in (root / manifest.FOLDER).glob("[!.]*")
        if path.suffix[1:] in config.SHOWN
    }
    return found + [
        f"{manifest.FOLDER}/{name}: no scene of config.yaml makes it"
        for name in sorted(there - names - set(listed))
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


def _say_what_is_missing(scenes, missing):
    everything = {
        path for _, behind in config.figures({config.PAPER: scenes}).values() for path in behind
    }
    if set(missing) == everything:
        print("no results here: only the committed files were checked (./reproduce makes the rest)")
    elif missing:
        print(f"not checked, since not there: {_listed(missing)}")


def _not_ready(root, scenes):
    """Why the results cannot be accepted, or None."""
    problems, missing = audit(root, scenes)
    if missing:
        return f"{missing[0]} is missing"
    for path, problem in problems.items():
        return f"{path}: {problem}"
    for path, (_, behind) in config.figures({config.PAPER: scenes}).items():
        if file_hash(root / path) != file_hash(root / behind[-1]):
            return f"{path} is not {behind[-1]}"
    return None
