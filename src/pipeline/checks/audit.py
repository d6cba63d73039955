"""Whether results are what their records say, and made by this tree: nothing is run again."""

import json
from typing import NamedTuple

from .. import config
from ..records.provenance import file_hash, record_path, versions


class Maker(NamedTuple):
    """What a result should have been made from."""

    config: dict
    sources: list


def makers(scenes):
    """Each result of the scenes, from the root -> what should have made it."""
    serves = config.served({config.PAPER: scenes})
    found = {}
    for scene, block in scenes.items():
        for stage, parameters in config.stages(block).items():
            path = serves[config.PAPER, scene, stage]
            found[path] = Maker(parameters, config.stage_code(stage))
        drawn = Maker(config.drawing(block), config.drawing_code(block["picture"]))
        for extension in block["formats"]:
            found[config.drawn(scene, extension)] = drawn
    return found


def audit(root, makers):
    """(problems, missing): each result that is not as it should be -> why; those not there.

    `makers` has the Maker of every result.
    """
    problems, missing = {}, []
    for path, maker in makers.items():
        if file_hash(root / path) is None:
            missing.append(path)
            continue
        problem = _problem(root, path, maker)
        if problem:
            problems[path] = problem
    # What was made from a result that has a problem shares it.
    for path in makers:
        if path not in problems and path not in missing:
            try:
                inputs = _record(root, path)["inputs"]
            except (OSError, ValueError, KeyError):  # a run is writing here just now
                problems[path] = "changed while it was looked at"
                continue
            for used, digest in inputs.items():
                if used not in problems and file_hash(root / used) != digest:
                    problems[path] = f"made from another {used}"
    return problems, missing


def differing_key(before, after):
    """(dotted key, value before, value after) of the first difference of two blocks, or None."""
    return next(differing_keys(before, after), None)


def differing_keys(before, after, place=""):
    """Yield (dotted key, value before, value after) for each difference of two blocks."""
    if isinstance(before, dict) and isinstance(after, dict):
        for key in sorted({*before, *after}):
            where = f"{place}.{key}" if place else key
            if key not in before or key not in after:
                yield where, before.get(key, "nothing"), after.get(key, "nothing")
            else:
                yield from differing_keys(before[key], after[key], where)
    # 1 and 1.0 differ as text and as data, true and 1 too.
    elif json.dumps(before) != json.dumps(after):
        yield place, before, after


def differing_files(before, after):
    """Words about the first file whose hash differs between two mappings, or None."""
    different = [path for path in sorted({*before, *after}) if before.get(path) != after.get(path)]
    if not different:
        return None
    path = different[0]
    verb = "is new" if path not in before else "is gone" if after.get(path) is None else "differs"
    more = f" (and {len(different) - 1} more)" if len(different) > 1 else ""
    return f"{path} {verb}{more}"


def differing_package(before, after):
    """(package, version before, version after) of the first difference, or None."""
    for package in sorted({*before, *after}):
        if before.get(package) != after.get(package):
            return package, before.get(package), after.get(package)
    return None


def brief(value):
    """A value as JSON, shortened to a part of a line."""
    text = json.dumps(value)
    return text if len(text) <= 40 else text[:37] + "..."


def _record(root, path):
    return json.loads((root / record_path(path)).read_text(encoding="utf-8"))


def _problem(root, path, maker):
    """Why a result cannot be trusted, or None; its inputs are not looked at."""
    try:
        record = _record(root, path)
        digest, made_by = record["output"]["sha256"], dict(record["sources"])
        environment, _ = dict(record["environment"]), dict(record["inputs"])
        key = differing_key(record["config"], maker.config)
    except FileNotFoundError:
        return "no record of what made it"
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return f"its record {record_path(path)} is broken"
    if file_hash(root / path) != digest:
        return "changed after it was made"
    if key:
        name, before, after = key
        return f"made from another config: {name}: {brief(before)} then, {brief(after)} now"
    now = {file: file_hash(root / file) for file in maker.sources}
    files = differing_files(made_by, now)
    if files:
        return f"made by other code than this tree's: {files}"
    package = differing_package(environment, versions())
    if package:
        name, before, after = package
        return f"made with {name} {before}, here is {after or 'none'}"
    return None
