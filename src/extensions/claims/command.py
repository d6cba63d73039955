"""./reproduce claims: every statement of the paper, checked, in CLAIMS.json and CLAIMS.md."""

from collections import Counter
from collections.abc import Sequence

from pipeline.cli import publishing
from pipeline.cli.arguments import Arguments
from pipeline.cli.errors import UsageError
from pipeline.cli.lock import locked
from pipeline.cli.running import INTERRUPTED, interruptible
from pipeline.cli.table import wrapped
from pipeline.config import MAIN, Config
from pipeline.records import artifacts
from pipeline.records.files import write_whole
from pipeline.records.sources import ROOT
from pipeline.spelling import suggestion

from . import ledger as claims
from .ledger.schema import Verdict


def run(args: Arguments) -> int:
    """Compute missing data, draw the pictures and write the verdicts.

    The verdicts stay as they are if config.yaml lacks scenes that they need.
    """
    config, lacking, data = args.config, "", list[str]()
    try:
        data += dataset_paths(config, claims.required_datasets()).values()
        data += theorem_paths(config, claims.required_theorems()).values()
    except UsageError as error:
        data, lacking = [], str(error)
    with locked():
        files = publishing.drawings_of(config, "claims")
        if lacking and not files:
            raise UsageError(lacking)
        status = publishing.make(config, {"claims": files}, args, data)
        if lacking and status != INTERRUPTED:
            print(f"\n{claims.FILE} stays as it is: {lacking}")
        if status or lacking or args.makes_nothing:
            return status
        with interruptible():
            verdicts = write(config)
    counts = Counter(verdict.verdict for verdict in verdicts)
    counted = ", ".join(f"{n} {word}" for word, n in counts.items())
    print("", *wrapped(f"{claims.FILE}: {counted}"), sep="\n")
    return 0


def dataset_paths(config: Config, names: Sequence[str]) -> dict[str, str]:
    """Return name -> path of datasets that checks need; raises UsageError for an unknown name."""
    known = {}
    for (variant, scene, stage), path in config.datasets.items():
        own = variant in (MAIN, "claims")
        known[f"{scene}/{stage}" if own else f"{variant}/{scene}/{stage}"] = path
        if stage == "sweep":
            known[f"atlas/{scene}"] = path
        if stage == "derivations":
            known[stage] = path
    for name in names:
        if name not in known:
            numbers = [number for number, claim in claims.CLAIMS.items() if name in claim.data]
            needs = f"no scene of config.yaml makes {name}, which claim {numbers[0]} needs"
            raise UsageError(": ".join([needs, *filter(None, [suggestion(name, known)])]))
    return {name: known[name] for name in names}


def theorem_paths(config: Config, names: Sequence[str]) -> dict[str, str]:
    """Return name -> path of the verdicts on theorems; raises UsageError for a missing one."""
    known = {s: path for (group, s, _), path in config.datasets.items() if group == "theorems"}
    for name in names:
        if name not in known:
            raise UsageError(f"there is no certificate of the theorem {name}")
    return {name: known[name] for name in names}


def write(config: Config) -> list[Verdict]:
    """Judge all claims, and write CLAIMS.json and then CLAIMS.md.

    A sweep's dataset gets the g of its block, if there is one, as an attribute.
    """
    datasets = {}
    for name, path in dataset_paths(config, claims.required_datasets()).items():
        folder, _, sweep = name.partition("/")
        block = config.variants["atlas"][sweep].as_mapping() if folder == "atlas" else {}
        more = {"g": block["g"]} if "g" in block else {}
        datasets[name] = artifacts.load(ROOT / path).assign_attrs(more)
    proofs = {
        name: artifacts.load(ROOT / path).attrs["verdict"]
        for name, path in theorem_paths(config, claims.required_theorems()).items()
    }
    data = claims.to_json(claims.judge_claims(datasets, proofs))
    verdicts = claims.read_json(data)
    for name, text in {claims.DATA: data, claims.FILE: claims.render(verdicts)}.items():
        write_whole(ROOT / name, text)
    return verdicts
