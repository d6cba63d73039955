"""./reproduce claims: every statement of the paper, checked, in CLAIMS.json and CLAIMS.md."""

from collections import Counter
from collections.abc import Sequence
from typing import Any

from ...checks import claims
from ...checks.claims.schema import Verdict
from ...config import PAPER, paths
from ...records import artifacts
from ...records.files import write_whole
from ...records.names import suggestion
from ...records.sources import ROOT
from .. import figures
from ..arguments import Arguments
from ..session import UsageError, interruptible, locked


def run(args: Arguments) -> int:
    """Compute missing data, draw the pictures and write the verdicts."""
    checked = args.checked
    with locked():
        files = figures.of_scenes(checked, "claims")
        data = [*dataset_paths(checked, claims.required_datasets()).values()]
        data += map(paths.theorem, claims.required_theorems())
        status = figures.make(checked, "claims", files, args, data)
        if status or args.makes_nothing:
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


def write(checked: dict[str, Any]) -> list[Verdict]:
    """Judge all claims, and write CLAIMS.json and then CLAIMS.md.

    A sweep's dataset gets the g of its block, if there is one, as an attribute.
    """
    datasets = {}
    for name, path in dataset_paths(checked, claims.required_datasets()).items():
        folder, _, sweep = name.partition("/")
        block = checked["sweeps"][sweep] if folder == "atlas" else {}
        more = {"g": block["g"]} if "g" in block else {}
        datasets[name] = artifacts.load(ROOT / path).assign_attrs(more)
    proofs = {
        name: artifacts.load(ROOT / paths.theorem(name)).attrs["verdict"]
        for name in claims.required_theorems()
    }
    data = claims.to_json(claims.judge_claims(datasets, proofs))
    verdicts = claims.read_json(data)
    for name, text in {paths.LEDGER_DATA: data, paths.LEDGER: claims.render(verdicts)}.items():
        write_whole(ROOT / name, text)
    return verdicts
