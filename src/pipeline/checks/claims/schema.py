"""What claims.toml may say, what a claim and a verdict on it are, and what the checks share."""

import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from importlib import resources
from typing import Annotated

import numpy as np
from pydantic import Field

from pseudorigid.proofs.derivations import FORMULAS

from ...config import ConfigError
from ...config.schema.fields import Block, listed, one_of
from ...config.schema.stages import STAGES
from ...config.validation.mistakes import mistakes
from ...config.validation.words import meant, refusal

HOLDS, CORRECTED, FALSE = "holds", "holds with a correction", "does not hold"
PROVED, UNDECIDED = "proved", "undecided"
VERDICT_WORDS = (FALSE, CORRECTED, UNDECIDED, PROVED, HOLDS)
_CERTIFICATES = resources.files("pseudorigid.proofs") / "certificates"
THEOREMS = sorted(file.name.removesuffix(".toml") for file in _CERTIFICATES.iterdir())

Text = Annotated[str, Field(min_length=1, description="a text")]
Texts = listed(Text, "a list of texts")


@dataclass(frozen=True)
class Verdict:
    """What became of a claim.

    Parameters
    ----------
    verdict : str
        One of WORDS.
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
        if self.verdict not in VERDICT_WORDS:
            raise ValueError(f"verdict {self.verdict!r} is not allowed: {', '.join(VERDICT_WORDS)}")
        if not self.value:
            raise ValueError(f"a verdict without a value is not allowed: {self}")


class Row(Block):
    """a mapping with the keys of a claim"""

    place: Text
    kind: Text
    quote: Text = ""
    paraphrase: Text = ""
    data: Texts = ()
    theorems: Texts = ()
    check: Text = ""
    formulas: Texts = ()
    verdict: one_of(*VERDICT_WORDS) = ""
    value: Text = ""
    error: Text = ""
    evidence: Text = ""


class Claim(Row):
    """A row, its number, and its check.

    The check is a function of the datasets and, where theorems are named, of a mapping from their
    names to whether they are proved. It returns a verdict and the numbers in `value` and `error`;
    or, where the sentences depend on what was found, a verdict, a value and an error.
    """

    number: int
    function: Callable

    def judge(self, datasets, proofs):
        """The Verdict on it.

        Parameters
        ----------
        datasets : mapping from name to Dataset
        proofs : mapping from a theorem's name to "proved" or another word

        Raises
        ------
        ValueError
            A dataset is missing.
        ConfigError
            `value` or `error` asks for a number that the check does not give.
        """
        missing = [name for name in self.data if name not in datasets]
        if missing:
            raise ValueError(f"claim {self.number} needs {', '.join(missing)}")
        given = [datasets[name] for name in self.data]
        if self.theorems:
            proved = {name: proofs.get(name) == PROVED for name in self.theorems}
            given.append(_Proved(proved, number=self.number))
        word, *said = self.function(*given)
        if len(said) == 1:
            try:
                said = [text.format_map(said[0]) for text in (self.value, self.error)]
            except (LookupError, ValueError) as error:
                wrong = f"no number {error}" if isinstance(error, KeyError) else str(error)
                raise ConfigError(f"claims.toml: claims.{self.number}: {wrong}") from None
        return Verdict(word, *said, self.evidence)


class _Proved(dict):
    """Theorem that a claim names -> whether it is proved."""

    def __init__(self, proved, number):
        super().__init__(proved)
        self.number = number

    def __missing__(self, name):
        raise KeyError(f"claim {self.number} does not name the theorem {name}")


class Document(Block):
    """a mapping with the keys head, verdicts, kinds and claims"""

    head: Text
    verdicts: Annotated[
        dict[one_of(*VERDICT_WORDS), Text], Field(description="a mapping from verdicts")
    ]
    kinds: Annotated[dict[str, Text], Field(description="a mapping from letters")]
    claims: Annotated[
        dict[Annotated[str, Field(pattern=r"^[1-9]\d*$", description="a number")], Row],
        Field(description="a mapping from numbers to claims"),
    ]


def load(text, checks):
    """The contents of claims.toml.

    Parameters
    ----------
    text : str
    checks : mapping from name to function

    Returns
    -------
    (Document, dict from number to Claim)

    Raises
    ------
    ConfigError
        With a line for each mistake.
    """
    try:
        given = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise ConfigError(f"claims.toml: {error}") from None
    lines = mistakes(Document, given, ())
    if not lines:
        document = Document(**given)
        lines += [
            f"verdicts: missing: {word}" for word in VERDICT_WORDS if word not in document.verdicts
        ]
        for number, row in document.claims.items():
            lines += _mistakes_of(row, f"claims.{number}", "".join(document.kinds), checks)
        unused = checks.keys() - {row.check for row in document.claims.values()}
        lines += [f"no claim has the check {name}" for name in sorted(unused)]
    if lines:
        raise ConfigError(*(f"claims.toml: {line}" for line in lines))
    claims = {}
    for number, row in sorted((int(number), row) for number, row in document.claims.items()):
        function = checks.get(row.check) or _without_a_function(row)
        claims[number] = Claim(
            number=number, function=function, **row.model_dump(exclude_unset=True)
        )
    return document, claims


def _mistakes_of(row, place, kinds, checks):
    """Yield a line for each mistake in a claim whose fields have the right types."""
    if set(row.kind) - set(kinds):
        yield refusal((place, "kind"), row.kind, f"letters of {kinds}")
    if bool(row.quote) == bool(row.paraphrase):
        yield f"{place}: expected either quote or paraphrase"
    if sum(map(bool, (row.check, row.formulas, row.verdict))) != 1:
        yield f"{place}: expected one of check, formulas and verdict"
    if row.formulas and row.data != ["derivations"]:
        yield f'{place}: expected data = ["derivations"], which formulas are of'
    stages = [name.rpartition("/")[2] for name in row.data if not name.startswith("atlas/")]
    named = {
        "data": (stages, (*STAGES, "derivations")),
        "theorems": (row.theorems, THEOREMS),
        "formulas": (row.formulas, [name for names in FORMULAS.values() for name in names]),
        "check": ([row.check] * bool(row.check), checks),
    }
    for key, (names, known) in named.items():
        for name in names:
            if name not in known:
                (hint,) = meant(name, known) or [f"known are {', '.join(known)}"]
                yield f"{place}.{key}: {name!r} is not known: {hint}"


def _without_a_function(row):
    """The check of a claim that has formulas, or a verdict of its own."""
    if row.formulas:
        return lambda algebra: derived(algebra, *row.formulas)
    return lambda: (row.verdict, {})


def verdict_of(holds, proved=False, **numbers):
    """The verdict on a statement that holds or does not, and if it holds may be proved."""
    return FALSE if not holds else PROVED if proved else HOLDS, numbers


def formula(algebra, *names):
    """(printed, corrected) of formulas of the dataset of derivations, all of them together.

    `corrected` is whether each that does not hold as printed holds when it is corrected.
    """
    found = algebra.sel(formula=list(names))
    printed, corrected = found["printed"].values, found["corrected"].values
    holds = (printed == 1) | ((printed == -1) & (corrected == 1))
    return bool(np.all(holds)), bool(np.all((printed == 1) | (corrected == 1)))


def derived(algebra, *names):
    """The verdict on formulas that computer algebra settles, and the numbers of all formulas."""
    holds, mended = formula(algebra, *names)
    word = PROVED if holds else CORRECTED if mended else FALSE
    return word, numbers_of(algebra)


def numbers_of(algebra):
    """The number that comes with each formula of the dataset of derivations."""
    return dict(zip(algebra["formula"].values.tolist(), algebra["value"].values, strict=True))
