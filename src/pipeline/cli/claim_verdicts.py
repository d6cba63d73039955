"""What ./reproduce claims needs and writes: datasets by name, the verdicts, CLAIMS.md."""

import re

from ..checks import claims
from ..checks.claims import soundness
from ..checks.claims.render import render
from ..checks.claims.schema import UNDECIDED
from ..config import paths
from ..records import artifacts
from ..records.files import write_whole
from ..records.sources import ROOT
from .session import CommandLineError, UsageError


def dataset_paths(checked) -> dict[str, str]:
    """Name of each dataset that the checks need -> where it is."""
    known = {"derivations": paths.DERIVATIONS}
    known |= {f"atlas/{name}": paths.sweep_dataset(name) for name in checked["sweeps"]}
    for (variant, scene, stage), path in paths.artifact_paths(checked["variants"]).items():
        own = variant in (paths.PAPER, "claims")
        known[f"{scene}/{stage}" if own else f"{variant}/{scene}/{stage}"] = path
    for name in claims.required_datasets():
        if name not in known:
            raise UsageError(f"config.yaml: no scene makes {name}, which claims need")
    return {name: known[name] for name in claims.required_datasets()}


def load(checked, name, path):
    """A dataset of the checks."""
    return _with_gravity(checked, name, artifacts.load(ROOT / path))


def _with_gravity(checked, name, dataset):
    """A dataset of the checks with g among its attributes, where a sweep's block says it."""
    if name.startswith("atlas/"):
        sweep = checked["sweeps"].get(name.partition("/")[2], {})
        return dataset.assign_attrs({key: sweep[key] for key in ("g",) if key in sweep})
    return dataset


def proofs(names) -> dict[str, str]:
    """Theorem -> its verdict, checked now."""
    from pseudorigid.proofs import THEOREMS

    return {name: THEOREMS[name].check().verdict for name in names}


def write(checked) -> dict:
    """Write CLAIMS.md; the verdicts."""
    data = {name: load(checked, name, path) for name, path in dataset_paths(checked).items()}
    verdicts = claims.judge_claims(data, proofs(claims.required_theorems()))
    text = render(verdicts)
    path = ROOT / paths.LEDGER
    if not path.is_file() or path.read_text(encoding="utf-8") != text:
        write_whole(path, text)
    return verdicts


def check(checked, number, given) -> str:
    """The verdict on one claim, in a line, with a file in the place of one of its datasets.

    `given` is FILE or NAME=FILE; without a name it is the dataset of the file's stage.
    """
    claim = claims.CLAIMS.get(number)
    if claim is None:
        raise CommandLineError(f"no claim {number}: they are 1 to {max(claims.CLAIMS)}")
    if not claim.data:
        raise CommandLineError(f"claim {number} rests on no dataset")
    name, mark, file = given.rpartition("=")
    other = artifacts.load(file)
    stage = re.sub(r"\d+$", "", str(other.attrs.get("stage", "")))
    fitting = [known for known in claim.data if known.rpartition("/")[2] == stage]
    name = name if mark else (fitting or [claim.data[0]])[0]
    if name not in claim.data:
        raise CommandLineError(f"claim {number} rests on {', '.join(claim.data)}, not on {name}")
    wrong = soundness.dataset_error(name.rpartition("/")[2], other)
    if wrong:
        return f"{number}  {UNDECIDED}: {file} is no {name} of its ball and energy: {wrong}"
    others = [known for known in claim.data if known != name]
    data = {known: load(checked, known, dataset_paths(checked)[known]) for known in others}
    data[name] = _with_gravity(checked, name, other)
    try:
        verdict = claim.judge(data, proofs(claim.theorems))
    except (KeyError, IndexError, ValueError) as error:  # samples do not show what it lacks
        return f"{number}  {UNDECIDED}: {file} cannot be read as {name}: {error.args[0]}"
    return f"{number}  {verdict.verdict}; {verdict.value}; {verdict.error}; {verdict.evidence}"
