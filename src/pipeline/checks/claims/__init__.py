"""Every checkable statement of the paper (claims.toml), with a check that gives a verdict on it."""

from inspect import getmembers, isfunction
from pathlib import Path

from . import chaos, closure, impacts, model, periodic, schema

# MODULE.FUNCTION -> the public functions of the modules with checks.
CHECKS = {
    f"{module.__name__.rpartition('.')[2]}.{name}": function
    for module in (model, impacts, periodic, chaos, closure)
    for name, function in getmembers(module, isfunction)
    if function.__module__ == module.__name__ and not name.startswith("_")
}
TEXT = Path(__file__).with_name("claims.toml").read_text(encoding="utf-8")
DOCUMENT, CLAIMS = schema.load(TEXT, CHECKS)
VERDICTS = DOCUMENT.verdicts


def required_datasets():
    """Names of all datasets that the checks need, in order."""
    return sorted({name for claim in CLAIMS.values() for name in claim.data})


def required_theorems():
    """Names of all theorems whose proofs the checks ask for, in order."""
    return sorted({name for claim in CLAIMS.values() for name in claim.theorems})


def judge_claims(datasets, proofs):
    """The verdicts on all claims.

    Parameters
    ----------
    datasets : mapping from name to Dataset
        All of `needed()`.
    proofs : mapping from a theorem's name to "proved" or another word
        A theorem that is not named counts as not proved.

    Returns
    -------
    dict from number to Verdict
    """
    return {number: claim.judge(datasets, proofs) for number, claim in CLAIMS.items()}
