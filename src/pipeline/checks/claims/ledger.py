"""What a claim of the paper is, what a verdict on it is, and the list that the claims go into."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

HOLDS, CORRECTED, FALSE = "holds", "holds with a correction", "does not hold"
PROVED, UNDECIDED = "proved", "undecided"
# The verdicts, and what each of them needs.
VERDICTS = {
    FALSE: "A case at the paper's own numbers, computed or proved, contradicts the statement as it "
    "stands.",
    CORRECTED: "As it stands the statement is wrong in a part, or says more than was shown. What "
    "of it is true stands under *our value*, on the same evidence as *proved* or *holds* need.",
    UNDECIDED: "Nothing here settles it, and the row says why: part of it was not or cannot be "
    "computed, or a theorem's proof was not accepted.",
    PROVED: "It follows from theorems whose hypotheses were checked in ball arithmetic "
    "(`./reproduce prove`), or from identities that computer algebra verifies for all values of "
    "their symbols (`tests/proofs/test_derivations.py`). Of a question that the paper leaves open: "
    "what it misses is proved here. Numbers beside it are computed unless the row says otherwise.",
    HOLDS: "Our numbers agree with it within the error given, or an argument by hand that the row "
    "gives; no proof. Where the statement is a "
    "judgement (*appreciable*, *similar*), so is the verdict, and the numbers behind it are given.",
}
DERIVED = "tests/proofs/test_derivations.py"  # the evidence for what computer algebra settles
CLAIMS = {}  # number -> Claim
KINDS = {
    "E": "equation",
    "N": "number",
    "F": "figure",
    "T": "theorem-like",
    "Q": "qualitative",
    "P": "physical",
    "O": "left open by the paper",
}


@dataclass(frozen=True)
class Verdict:
    """What became of a claim.

    Parameters
    ----------
    verdict : str
        One of VERDICTS.
    value : str
        Our number, rounded so that it does not depend on the machine; of what is undecided, why.
    error : str
        Its error, or how far it can be trusted.
    evidence : str
        What to look at.
    """

    verdict: str
    value: str
    error: str
    evidence: str

    def __post_init__(self):
        if self.verdict not in VERDICTS:
            raise ValueError(f"verdict {self.verdict!r} is not allowed: {', '.join(VERDICTS)}")
        if not self.value:
            raise ValueError(f"a verdict without a value is not allowed: {self}")


@dataclass(frozen=True)
class Claim:
    """A statement of the paper and its check.

    Parameters
    ----------
    number : int
    place : str
        Where it is in the paper.
    words : str
        The paper's own, or a paraphrase.
    quoted : bool
        Whether they are the paper's own.
    kind : str
        Letters of KINDS.
    data : tuple of str
        Names of the datasets that the check needs.
    theorems : tuple of str
        Names of theorems whose proofs it asks for.
    check : callable
        From the datasets, in that order, to a Verdict; where theorems are named its last argument
        is `proved`, a function from names of some to whether all of these are proved.
    """

    number: int
    place: str
    words: str
    quoted: bool
    kind: str
    data: tuple
    theorems: tuple
    check: Callable

    def judge(self, datasets, proofs):
        """The Verdict on it.

        Parameters
        ----------
        datasets : mapping from name to Dataset
        proofs : mapping from a theorem's name to "proved" or another word

        Raises
        ------
        ValueError
            A dataset that it needs is not there.
        """
        missing = [name for name in self.data if name not in datasets]
        if missing:
            raise ValueError(f"claim {self.number} needs {', '.join(missing)}")

        def proved(*names):
            for name in names:
                if name not in self.theorems:
                    raise KeyError(f"claim {self.number} does not name the theorem {name}")
            return all(proofs.get(name) == PROVED for name in names)

        given = [datasets[name] for name in self.data]
        return self.check(*given, proved) if self.theorems else self.check(*given)


def claim(number, place, kind, *data, theorems=()):
    """A decorator that adds a claim, with the function below it as its check, to CLAIMS.

    The function's docstring is the statement: the paper's own words in quotation marks, “ and ”,
    or else a paraphrase. The arguments are those of Claim.
    """
    if not kind or set(kind) - set(KINDS):
        raise ValueError(f"claim {number}: kind {kind!r} is not allowed: of {''.join(KINDS)}")

    def add(check):
        said = " ".join((check.__doc__ or "").split())
        quoted = said.startswith("“") and said.endswith("”")
        words = said[1:-1] if quoted else said
        if not words or number in CLAIMS:
            raise ValueError(f"claim {number} has no words, or is there twice")
        CLAIMS[number] = Claim(number, place, words, quoted, kind, data, tuple(theorems), check)
        return check

    return add


def decided(holds, value, error, evidence, proved=False):
    """The Verdict on a statement that holds or does not, and if it holds may be proved."""
    word = FALSE if not holds else PROVED if proved else HOLDS
    return Verdict(word, value, error, evidence)


def formula(dataset, *names):
    """(printed, corrected) of formulas of the dataset of derivations, all of them together.

    `corrected` is whether each that does not hold as printed holds when it is corrected.
    """
    found = dataset.sel(formula=list(names))
    printed, corrected = found["printed"].values, found["corrected"].values
    holds = (printed == 1) | ((printed == -1) & (corrected == 1))
    return bool(np.all(holds)), bool(np.all((printed == 1) | (corrected == 1)))


def derived(dataset, *names, value, remark="exact", proved=True):
    """The Verdict on formulas that computer algebra settles; not `proved` where by some values."""
    holds, mended = formula(dataset, *names)
    if mended and not holds:
        return Verdict(CORRECTED, value, remark, DERIVED)
    return decided(holds, value, remark, DERIVED, proved)


def number_of(dataset, name):
    """The number that comes with a formula of the dataset of derivations."""
    return float(dataset["value"].sel(formula=name))
