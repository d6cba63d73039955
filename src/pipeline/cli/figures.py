"""The figures of the paper or of a variant: what is missing of them is made, then published."""

import filecmp
import json
import shutil

from .. import config
from ..checks.currency import Currency
from ..config import expected
from ..config.expected import Expected
from ..records.files import replacing
from ..records.record import begin, finish, record_path
from ..records.sources import ROOT
from . import running
from .folder import say


def make(checked, variant, arguments, named=None, others=()) -> int:
    """Make the figures of a variant, or those of its files that are `named`, and say what became
    of them; the exit status.

    `others` are further results to make. A figure whose periodic orbit does not exist is left out,
    and the rest is made.
    """
    variants = checked["variants"]
    figures = config.figures(variants, variant)
    wanted = {path: figures[path] for path in (figures if named is None else named)}
    results = expected.of_variants(variants)
    says = running.only_says(arguments)
    since = running.now()
    if says:
        missing = known_absent(variant)
        drawings = [behind[-1] for scene, behind in wanted.values() if scene not in missing]
        return running.make(results, [*drawings, *others], arguments)
    before = {path: _identity(behind[-1]) for path, (_, behind) in wanted.items()}
    status, absent = _find_absent(variants, variant, wanted, results, arguments)
    if status != running.INTERRUPTED:
        drawings = [behind[-1] for scene, behind in wanted.values() if scene not in absent]
        status = running.make(results, [*drawings, *others], arguments)
    if status == running.INTERRUPTED:
        return status
    outdated = Currency(ROOT, results).outdated([behind[-1] for _, behind in wanted.values()])
    good = {path: made for path, made in wanted.items() if made[1][-1] not in outdated}
    if variant in config.PUBLISHED:
        publish({path: behind[-1] for path, (_, behind) in good.items() if "results/" not in path})
    for line in running.last_words(since) if status else ():
        say(line.removeprefix("pseudorigid: "))
    if wanted:
        _table(wanted, good, absent, before)
        for line in _missed_impacts(variants, variant, {scene for scene, _ in good.values()}):
            print(line)
    if variant in config.PUBLISHED and any(scene in absent for scene, _ in wanted.values()):
        return status or 1
    return status


def publish(drawings) -> None:
    """Copy each finished drawing to where users look for it, in one step, where it is another."""
    for path, drawing in drawings.items():
        published = ROOT / path
        if not (published.is_file() and filecmp.cmp(published, ROOT / drawing, shallow=False)):
            with replacing(published) as part:
                shutil.copyfile(ROOT / drawing, part)


def _orbits(variants, variant, wanted):
    """Scene -> (type, dataset) of the periodic orbit that it cannot do without."""
    serves = config.served(variants)
    scenes = {scene for scene, _ in wanted.values()}
    return {
        scene: (kind, serves[variant, scene, "periodic"])
        for scene, kind in config.wanted_orbits(variants[variant]).items()
        if scene in scenes
    }


def _find_absent(variants, variant, wanted, results, arguments):
    """(exit status, scene -> why its figure cannot exist), once the periodic orbits are known."""
    orbits = _orbits(variants, variant, wanted)
    datasets = sorted({path for _, path in orbits.values()})
    status = 0
    if Currency(ROOT, results).outdated(datasets):
        drawings = [behind[-1] for scene, behind in wanted.values() if scene not in orbits]
        status = running.make(results, [*datasets, *drawings], arguments)
        if status == running.INTERRUPTED:
            return status, {}
    path = config.absent_file(variant)
    made = Expected({scene: list(orbit) for scene, orbit in orbits.items()}, [], datasets)
    currency = Currency(ROOT, results | {path: made})
    if currency.outdated(datasets) or not orbits:
        return status, {}
    if currency.reason(path):
        _write_absent(path, made, variant)
    return status, json.loads((ROOT / path).read_text(encoding="utf-8"))


def _write_absent(path, made, variant) -> None:
    from pseudorigid.dynamics.variables import of_type

    from ..records.artifacts import load

    found = {}
    for scene, (kind, dataset) in made.config.items():
        try:
            of_type(load(ROOT / dataset), kind)
        except ValueError as error:
            found[scene] = str(error)
    folder = ROOT / "results" / variant
    for scene in found:
        for old in (*folder.glob(f"figures/{scene}.*"), *folder.glob(f"provenance/{scene}.*")):
            old.unlink()
    record = begin(config=made.config, inputs=made.inputs, sources=[])
    with replacing(ROOT / path) as part:
        part.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    finish(record, path, record_path(path))


def known_absent(variant) -> dict[str, str]:
    """Scene -> why its figure cannot exist, as the last run of a variant found."""
    try:
        return json.loads((ROOT / config.absent_file(variant)).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}


def _identity(file):
    """Changes whenever the file is written anew; None where there is none."""
    try:
        status = (ROOT / file).stat()
    except OSError:
        return None
    return status.st_ino, status.st_mtime_ns


def _table(wanted, good, absent, before) -> None:
    """Print the figures of this run, one a line: figure, file, size, what became of it."""
    rows = [("figure", "file", "size", "state")]
    for path, (scene, behind) in wanted.items():
        if path in good:
            state = "current" if _identity(behind[-1]) == before[path] else "recomputed"
            rows.append((scene, path, f"{(ROOT / path).stat().st_size / 1000:,.0f} kB", state))
        elif scene in absent:
            rows.append((scene, path, "", f"cannot exist: {absent[scene]}"))
        else:
            rows.append((scene, path, "", "not made"))
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    print()
    for scene, path, size, state in rows:
        print(f"{scene:{widths[0]}}  {path:{widths[1]}}  {size:>{widths[2]}}  {state}")


def _missed_impacts(variants, variant, scenes):
    """Of each of these scenes with a `method`: how many impacts it missed, one line a scene."""
    serves = config.served(variants)
    for scene in variants[variant]:
        block = variants[variant][scene]
        if "method" not in block or scene not in scenes:
            continue
        from ..records.artifacts import load  # takes a while

        found = [
            load(ROOT / serves[variant, scene, stage]).attrs
            for stage, parameters in config.stages(block).items()
            if "method" in parameters
        ]
        missed, impacts = (sum(a[n] for a in found) for n in ("impacts_missed", "impacts"))
        how = ", ".join(f"{key} {value:g}" for key, value in block["method"].items())
        yield f"{scene}: {missed:,} of {impacts:,} impacts fell through the floor ({how})"
