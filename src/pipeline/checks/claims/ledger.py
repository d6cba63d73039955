"""What a claim of the paper is, what a verdict on it is, and the list that the claims go into."""

from collections.abc import Callable
from dataclasses import dataclass

HOLDS, CORRECTED, FALSE = "holds", "holds with a correction", "does not hold"
PROVED, OPEN, NOT_COMPUTED = "proved", "open", "not computed"
VERDICTS = (HOLDS, CORRECTED, FALSE, PROVED, OPEN)
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
        One of VERDICTS, or "not computed: " and why.
    value : str
        Our number, rounded so that it does not depend on the machine.
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
        why = self.verdict.removeprefix(f"{NOT_COMPUTED}: ")
        if self.verdict not in VERDICTS and (why == self.verdict or not why):
            raise ValueError(f"verdict {self.verdict!r} is not allowed: {', '.join(VERDICTS)}")


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
        From (datasets, proved) to a Verdict; `datasets` has those named, `proved` is a function
        from a theorem's name to whether it is proved.
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

        def proved(name):
            if name not in self.theorems:
                raise KeyError(f"claim {self.number} does not name the theorem {name}")
            return proofs.get(name) == PROVED

        return self.check({name: datasets[name] for name in self.data}, proved)


def collector(claims):
    """A decorator that adds a claim with the function below it as its check to the list `claims`.

    Its arguments are those of Claim; `quote` gives the paper's words, `words` a paraphrase.
    """

    def claim(number, place, kind, *, quote=None, words=None, data=(), theorems=()):
        if (quote is None) == (words is None):
            raise ValueError(f"claim {number} needs either a quote or words")
        if not kind or set(kind) - set(KINDS):
            raise ValueError(f"claim {number}: kind {kind!r} is not allowed: of {''.join(KINDS)}")

        def add(check):
            said = quote or words
            claims.append(
                Claim(number, place, said, bool(quote), kind, tuple(data), tuple(theorems), check)
            )
            return check

        return add

    return claim


def formula(dataset, *names):
    """(printed, corrected) of formulas of the dataset of derivations, all of them together.

    `corrected` is whether each that does not hold as printed holds when it is corrected.
    """
    known = dataset["formula"].values.tolist()
    rows = [known.index(name) for name in names]
    printed = [int(dataset["printed"].values[row]) for row in rows]
    corrected = [int(dataset["corrected"].values[row]) for row in rows]
    holds = all(p == 1 or (p == -1 and c == 1) for p, c in zip(printed, corrected, strict=True))
    mended = all(p == 1 or c == 1 for p, c in zip(printed, corrected, strict=True))
    return holds, mended


def derived(dataset, *names, value="", remark=""):
    """The Verdict on formulas that computer algebra settles."""
    holds, mended = formula(dataset, *names)
    word = HOLDS if holds else CORRECTED if mended else FALSE
    return Verdict(word, value, remark or "exact", "tests/proofs/test_derivations.py")


def number_of(dataset, name):
    """The number that comes with a formula of the dataset of derivations."""
    row = dataset["formula"].values.tolist().index(name)
    return float(dataset["value"].values[row])
