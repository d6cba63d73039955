"""./reproduce claims: every statement of the paper, checked, in CLAIMS.json and CLAIMS.md."""

import re
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import xarray as xr

from ...checks import claims
from ...checks.claims import soundness
from ...checks.claims.schema import UNDECIDED, Verdict
from ...config import PAPER, paths
from ...records import artifacts
from ...records.files import write_whole
from ...records.names import suggestion
from ...records.sources import ROOT
from .. import figures, running
from ..arguments import Arguments
from ..session import CommandLineError, UsageError, interruptible, locked, one_line


def run(args: Arguments) -> int:
    """Compute missing data, draw the pictures and write the verdicts; or judge one claim."""
    if (args.check is None) != (args.data is None):
        raise CommandLineError("claims: --check ID and --data FILE go together")
    checked = args.checked
    if args.check is not None:
        name, _, file = args.data.rpartition("=")
        with one_line(kind=artifacts.ArtifactError):
            print(check(checked, args.check, name, args.start / file))
        return 0
    with locked():
        files = figures.of_scenes(checked, "claims")
        data = [*dataset_paths(checked, claims.required_datasets()).values()]
        data += map(paths.theorem, claims.required_theorems())
        status = figures.make(checked, "claims", files, args.options, data)
        if status or running.is_dry_run(args.options):
            return status
        with interruptible():
            verdicts = write(checked)
    counts = Counter(verdict.verdict for verdict in verdicts)
    print(f"\n{paths.LEDGER}: " + ", ".join(f"{n} {word}" for word, n in counts.items()))
    return 0


def dataset_paths(checked: dict[str, Any], names: Sequence[str]) -> dict[str, str]:
    """Return name -> path of datasets that checks need; raises UsageError for an unknown name."""
    known = {"derivations": paths.DERIVATIONS}
    known |= {f"atlas/{name}": paths.sweep_dataset(name) for name in checked["sweeps"]}
    for (variant, scene, stage), path in paths.artifact_paths(checked["variants"]).items():
        own = variant in (PAPER, "claims")
        known[f"{scene}/{stage}" if own else f"{variant}/{scene}/{stage}"] = path
    for name in names:
        if name not in known:
            numbers = [number for number, claim in claims.CLAIMS.items() if name in claim.data]
            needs = f"no scene of config.yaml makes {name}, which claim {numbers[0]} needs"
            raise UsageError(": ".join([needs, *filter(None, [suggestion(name, known)])]))
    return {name: known[name] for name in names}


def _load(
    checked: dict[str, Any], names: Sequence[str], given: dict[str, xr.Dataset]
) -> dict[str, xr.Dataset]:
    """Return datasets by their names, those that are not given from their files.

    A sweep's dataset gets the g of its block, if there is one, as an attribute.
    """
    datasets, files = {}, dataset_paths(checked, names)
    for name in names:
        if name not in given and not (ROOT / files[name]).exists():
            raise UsageError(f"{files[name]}: missing: ./reproduce claims makes it")
        dataset = given[name] if name in given else artifacts.load(ROOT / files[name])
        folder, _, sweep = name.partition("/")
        block = checked["sweeps"].get(sweep, {}) if folder == "atlas" else {}
        datasets[name] = dataset.assign_attrs({"g": block["g"]} if "g" in block else {})
    return datasets


def write(checked: dict[str, Any]) -> list[Verdict]:
    """Judge all claims, and write CLAIMS.json and then CLAIMS.md."""
    datasets = _load(checked, claims.required_datasets(), {})
    proofs = {
        name: artifacts.load(ROOT / paths.theorem(name)).attrs["verdict"]
        for name in claims.required_theorems()
    }
    data = claims.to_json(claims.judge_claims(datasets, proofs))
    verdicts = claims.read_json(data)
    for name, text in {paths.LEDGER_DATA: data, paths.LEDGER: claims.render(verdicts)}.items():
        write_whole(ROOT / name, text)
    return verdicts


def check(checked: dict[str, Any], number: int, name: str, file: Path) -> str:
    """Return the verdict on one claim, in a line, with a file instead of its dataset `name`.

    Without a name, the file's stage decides which dataset it is.
    """
    claim = claims.CLAIMS.get(number)
    if claim is None:
        raise CommandLineError(f"no claim {number}: they are 1 to {max(claims.CLAIMS)}")
    if not claim.data:
        raise CommandLineError(f"claim {number} rests on no dataset")
    dataset = artifacts.load(file)
    if not name:
        stage = re.sub(r"\d+$", "", str(dataset.attrs.get("stage", "")))
        fitting = [known for known in claim.data if known.rpartition("/")[2] == stage]
        name = (fitting or claim.data)[0]
    if name not in claim.data:
        raise CommandLineError(f"claim {number} rests on {', '.join(claim.data)}, not on {name}")
    if wrong := soundness.dataset_error(name.rpartition("/")[2], dataset):
        return f"{number}  {UNDECIDED}: {file} is no {name} of its ball and energy: {wrong}"
    from pseudorigid.proofs import THEOREMS

    datasets = _load(checked, claim.data, {name: dataset})
    proofs = {theorem: THEOREMS[theorem].check().verdict for theorem in claim.theorems}
    try:
        verdict = claim.judge(datasets, proofs)
    except (KeyError, IndexError, ValueError) as error:  # soundness checks only a sample
        return f"{number}  {UNDECIDED}: {file} cannot be read as {name}: {error.args[0]}"
    return f"{number}  {verdict.verdict}; {verdict.value}; {verdict.error}; {verdict.evidence}"
