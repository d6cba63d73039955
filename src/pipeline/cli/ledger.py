"""What ./reproduce claims needs and writes: datasets by name, the verdicts, CLAIMS.md."""

import re

from pseudorigid.dynamics.ball import Ball

from ..checks import claims
from ..checks.claims import soundness
from ..checks.claims.ledger import NOT_COMPUTED
from ..checks.claims.render import render
from ..checks.currency import Currency
from ..config import expected, places
from ..config.expected import Expected
from ..records import artifacts, sources
from ..records.files import replacing
from ..records.record import begin, finish, record_path
from ..records.sources import ROOT
from .folder import MisuseError, UsageError

DERIVATIONS = "results/claims/derivations.nc"
PROOFS = "pseudorigid.proofs.derivations"


def paths(checked) -> dict[str, str]:
    """Name of each dataset that the checks need -> where it is."""
    serves = places.served(checked["variants"])
    found = {}
    for name in claims.needed():
        *variant, scene, stage = ("paper", *name.split("/"))[-3:] if "/" in name else (name, "", "")
        if name == "derivations":
            found[name] = DERIVATIONS
        elif scene == "atlas":
            found[name] = places.sweep_dataset(stage)
        else:
            owner = variant[0]
            if owner == places.PAPER and scene in checked["variants"]["claims"]:
                owner = "claims"
            try:
                found[name] = serves[owner, scene, stage]
            except KeyError:
                raise UsageError(f"config.yaml: no scene makes {name}, which claims need") from None
    return found


def derive(checked) -> None:
    """Make the dataset of the derivations by computer algebra, where it is not current."""
    ball, energy = checked["ball"], checked["scenes"]["fig2"]["energy"]
    files = [str(f.relative_to(ROOT)) for f in sources.closure(PROOFS)]
    made = Expected({"ball": ball, "energy": energy}, files)
    if not Currency(ROOT, {DERIVATIONS: made}).reason(DERIVATIONS):
        return
    from pseudorigid.proofs.derivations import derivations

    record = begin(config=made.config, inputs=[], sources=files)
    about = {"stage": "derivations", **ball, "energy": float(energy)}
    artifacts.save(derivations(Ball(**ball), energy), DERIVATIONS, made.config, **about)
    finish(record, DERIVATIONS, record_path(DERIVATIONS))


def load(checked, name, path):
    """A dataset of the checks."""
    return _with_gravity(checked, name, artifacts.load(ROOT / path))


def _with_gravity(checked, name, dataset):
    """A dataset of the checks with g among its attributes, where a sweep's block says it."""
    if name.startswith("atlas/"):
        sweep = checked["sweeps"][name.partition("/")[2]]
        return dataset.assign_attrs({key: sweep[key] for key in ("g",) if key in sweep})
    return dataset


def proofs(names) -> dict[str, str]:
    """Theorem -> its verdict, checked now."""
    from pseudorigid.proofs import THEOREMS

    return {name: THEOREMS[name].check().verdict for name in names}


def write(checked) -> dict:
    """Write CLAIMS.md; the verdicts."""
    data = {name: load(checked, name, path) for name, path in paths(checked).items()}
    verdicts = claims.judge(data, proofs(claims.theorems()))
    text = render(verdicts)
    path = ROOT / places.LEDGER
    if not path.is_file() or path.read_text(encoding="utf-8") != text:
        with replacing(path) as part:
            part.write_text(text, encoding="utf-8")
    return verdicts


def check(checked, number, given) -> str:
    """The verdict on one claim, in a line, with a file in the place of one of its datasets.

    `given` is FILE or NAME=FILE; without a name it is the dataset of the file's stage.
    """
    claim = claims.CLAIMS.get(number)
    if claim is None:
        raise MisuseError(f"no claim {number}: they are 1 to {max(claims.CLAIMS)}")
    if not claim.data:
        raise MisuseError(f"claim {number} rests on no dataset")
    name, mark, file = given.rpartition("=")
    other = artifacts.load(file)
    stage = re.sub(r"\d+$", "", str(other.attrs.get("stage", "")))
    fitting = [known for known in claim.data if known.rpartition("/")[2] == stage]
    name = name if mark else (fitting or [claim.data[0]])[0]
    if name not in claim.data:
        raise MisuseError(f"claim {number} rests on {', '.join(claim.data)}, not on {name}")
    wrong = soundness.fault(name.rpartition("/")[2], other)
    if wrong:
        return f"{number}  {NOT_COMPUTED}: {file} is no {name} of its ball and energy: {wrong}"
    data = {name: _with_gravity(checked, name, other)}
    for known in claim.data:
        if known != name:
            data[known] = load(checked, known, paths(checked)[known])
    try:
        verdict = claim.judge(data, proofs(claim.theorems))
    except (KeyError, IndexError, ValueError) as error:  # samples do not show what it lacks
        return f"{number}  {NOT_COMPUTED}: {file} cannot be read as {name}: {error.args[0]}"
    return f"{number}  {verdict.verdict}; {verdict.value}; {verdict.error}; {verdict.evidence}"


def results(checked) -> tuple[dict, list[str]]:
    """(every result that may be needed -> Expected, those that the checks read)."""
    made = expected.of_variants(checked["variants"]) | expected.of_sweeps(checked["sweeps"])
    return made, [path for path in paths(checked).values() if path != DERIVATIONS]
