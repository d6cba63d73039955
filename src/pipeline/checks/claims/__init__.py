"""Every checkable statement of the paper, with a check in code that gives a verdict on it."""

from . import chaos, closure, impacts, ledger, model, periodic  # noqa: F401  (each adds its own)

CLAIMS = dict(sorted(ledger.CLAIMS.items()))


def needed():
    """Names of all datasets that the checks need, in order."""
    return sorted({name for claim in CLAIMS.values() for name in claim.data})


def theorems():
    """Names of all theorems whose proofs the checks ask for, in order."""
    return sorted({name for claim in CLAIMS.values() for name in claim.theorems})


def judge(datasets, proofs):
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
