"""The form of claims.toml, what a claim and its verdict are, and what the checks share."""

import tomllib
from collections.abc import Callable, Iterator, Mapping
from typing import Annotated, Any, Literal, NamedTuple, get_args

import numpy as np
import xarray as xr
from pydantic import Field
from pydantic.dataclasses import dataclass

from pseudorigid.proofs.derivations import FORMULAS

from ...config import ConfigError, paths
from ...config.schema.fields import Block
from ...config.schema.stages import STAGES
from ...config.validation.mistakes import mistakes
from ...config.validation.words import meant

_Words = Literal["does not hold", "holds with a correction", "undecided", "proved", "holds"]
VERDICT_WORDS = get_args(_Words)
FALSE, CORRECTED, UNDECIDED, PROVED, HOLDS = VERDICT_WORDS

_EXPECTED = Field(description=f"one of {', '.join(VERDICT_WORDS)}")
VerdictWord = Annotated[_Words, _EXPECTED]
Text = Annotated[str, Field(min_length=1, description="a text")]
Texts = Annotated[list[Text], Field(min_length=1, description="a list of texts")]
Number = Annotated[str, Field(pattern=r"^[1-9]\d*$", description="a number")]


class Outcome(NamedTuple):
    """What a check found: a verdict, the numbers of its sentences, and which sentences apply."""

    verdict: str
    numbers: dict[str, Any] = {}  # noqa: RUF012  (never changed)
    case: str = ""  # a key of the claim's `cases`; empty for `value` and `error`


class Series(tuple[Any, ...]):
    """Numbers that a template formats one by one: "{ends:.2f}" gives "0.23, 0.24"."""

    def __format__(self, spec: str) -> str:
        return ", ".join(format(number, spec) for number in self)


@dataclass(frozen=True)
class Verdict:
    """A row of CLAIMS.json: a claim and what became of it.

    `value` is our number, rounded so that it does not depend on the machine, or the reason why
    nothing is decided. `error` is its error, `evidence` what to look at. `datasets` are names as in
    claims.toml.
    """

    number: int
    place: str
    statement: str
    verdict: Annotated[str, Field(pattern=f"^({'|'.join(VERDICT_WORDS)})$")]
    value: Text
    error: str
    evidence: str
    datasets: list[str]


class Case(Block):
    """a mapping with the keys value and error"""

    value: Text
    error: Text = ""


Part = Annotated[list[str], Field(min_length=1, max_length=2, description="one or two texts")]
Parts = Annotated[dict[str, Part], Field(description="a mapping to lists of texts")]
Cases = Annotated[dict[str, Case], Field(description="a mapping to values and errors")]


class Row(Block):
    """a mapping with the keys of a claim"""

    place: Text
    quote: Text = ""
    paraphrase: Text = ""
    data: Texts = Field(default=[])
    theorems: Texts = Field(default=[])
    check: Text = ""
    formulas: Texts = Field(default=[])
    verdict: Annotated[Literal["", _Words], _EXPECTED] = ""
    value: Text = ""
    error: Text = ""
    evidence: Text = ""
    parts: Parts = Field(default={})
    cases: Cases = Field(default={})

    @property
    def statement(self) -> str:
        """The paper's words between quotation marks, or the paraphrase."""
        quoted = f"\N{LEFT DOUBLE QUOTATION MARK}{self.quote}\N{RIGHT DOUBLE QUOTATION MARK}"
        return quoted if self.quote else self.paraphrase


class Claim(Row):
    """A row of claims.toml with its number and its check, unless it has formulas or a verdict.

    The check is a function of the datasets and, if theorems are named, of a mapping from their
    names to whether they are proved. It returns an Outcome.
    """

    number: int
    function: Callable[..., Outcome] | None

    def judge(self, datasets: Mapping[str, xr.Dataset], proofs: Mapping[str, str]) -> Verdict:
        """Return the verdict on the claim; `proofs` maps theorems to "proved" or another word.

        Raises ValueError if a dataset is missing, and ConfigError if a sentence asks for a number
        that the check does not give.
        """
        missing = [name for name in self.data if name not in datasets]
        if missing:
            raise ValueError(f"claim {self.number} needs {', '.join(missing)}")
        inputs: list[Any] = [datasets[name] for name in self.data]
        if self.theorems:
            inputs.append({name: proofs.get(name) == PROVED for name in self.theorems})
        if self.function is not None:
            outcome = self.function(*inputs)
        else:
            outcome = derived(*inputs, *self.formulas) if self.formulas else Outcome(self.verdict)
        sentences = self.cases[outcome.case] if outcome.case else self
        numbers = dict(outcome.numbers)
        try:
            for name in (name for name in self.parts if name in numbers):
                numbers[name] = _part(self.parts[name], numbers[name], numbers)
            value, error = (s.format_map(numbers) for s in (sentences.value, sentences.error))
        except (LookupError, ValueError) as mistake:
            wrong = f"no number {mistake}" if isinstance(mistake, KeyError) else str(mistake)
            raise ConfigError(f"claims.toml: claims.{self.number}: {wrong}") from None
        return Verdict(
            self.number, self.place, self.statement, outcome.verdict, value, error, self.evidence,
            self.data,
        )  # fmt: skip


def _part(texts: list[str], number: Any, numbers: dict[str, Any]) -> str:
    """Return one text for each row of a list, or the text for true or false."""
    if isinstance(number, list):
        return "; ".join(texts[0].format_map(row) for row in number)
    return [*texts, ""][0 if number else 1].format_map(numbers)


class Document(Block):
    """a mapping with the keys head, verdicts and claims"""

    head: Text
    verdicts: Annotated[dict[VerdictWord, Text], Field(description="a mapping from verdicts")]
    claims: Annotated[dict[Number, Row], Field(description="a mapping from numbers to claims")]


def load(text: str, checks: Mapping[str, Callable[..., Outcome]]) -> tuple[Document, list[Claim]]:
    """Read claims.toml; `checks` are the functions by name, and the claims come by number.

    Raises ConfigError with a line for each mistake.
    """
    try:
        given = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise ConfigError(f"claims.toml: {error}") from None
    lines = mistakes(Document, given, ())
    if not lines:
        document = Document(**given)
        for number, row in document.claims.items():
            lines += _mistakes_of(row, f"claims.{number}", checks)
    if lines:
        raise ConfigError(*(f"claims.toml: {line}" for line in lines))
    claims = [
        Claim(
            number=int(number), function=checks.get(row.check), **row.model_dump(exclude_unset=True)
        )
        for number, row in document.claims.items()
    ]
    return document, sorted(claims, key=lambda claim: claim.number)


def _mistakes_of(row: Row, key: str, checks: Mapping[str, Callable[..., Outcome]]) -> Iterator[str]:
    """Yield a line for each mistake in a claim whose fields have the right types."""
    if bool(row.quote) == bool(row.paraphrase):
        yield f"{key}: expected either quote or paraphrase"
    if sum(map(bool, (row.check, row.formulas, row.verdict))) != 1:
        yield f"{key}: expected one of check, formulas and verdict"
    if row.formulas and row.data != ["derivations"]:
        yield f'{key}: formulas are in one dataset: expected data = ["derivations"]'
    stages = [name.rpartition("/")[2] for name in row.data if not name.startswith("atlas/")]
    named = {
        "data": (stages, (*STAGES, "derivations")),
        "theorems": (row.theorems, paths.THEOREMS),
        "formulas": (row.formulas, [name for names in FORMULAS.values() for name in names]),
        "check": ([row.check] * bool(row.check), [*checks]),
    }
    for field, (names, known) in named.items():
        for name in names:
            if name not in known:
                (hint,) = meant(name, known) or [f"known are {', '.join(known)}"]
                yield f"{key}.{field}: {name!r} is not known: {hint}"


def outcome_of(holds: object, proved: bool = False, /, **numbers: Any) -> Outcome:
    """Return the outcome for a statement that does or does not hold, and then may be proved."""
    return Outcome(FALSE if not holds else PROVED if proved else HOLDS, numbers)


def formula(algebra: xr.Dataset, *names: str) -> tuple[bool, bool]:
    """Return whether formulas of the derivations all hold as printed, and when corrected."""
    rows = algebra.sel(formula=list(names))
    printed, corrected = rows["printed"].values, rows["corrected"].values
    holds = (printed == 1) | ((printed == -1) & (corrected == 1))
    return bool(np.all(holds)), bool(np.all((printed == 1) | (corrected == 1)))


def derived(algebra: xr.Dataset, *names: str) -> Outcome:
    """Return the outcome for formulas that computer algebra settles, with all formulas' numbers."""
    holds, mended = formula(algebra, *names)
    return Outcome(PROVED if holds else CORRECTED if mended else FALSE, numbers_of(algebra))


def numbers_of(algebra: xr.Dataset) -> dict[str, float]:
    """Return formula -> the number that comes with it."""
    return dict(zip(algebra["formula"].values.tolist(), algebra["value"].values, strict=True))


def enclosed(proved: Mapping[str, bool]) -> list[dict[str, Any]]:
    """Return what the invariant curves among the proved theorems enclose, one row for each.

    `share` is a lower bound, of the section, that the theorem states for the disc inside one curve;
    `period` is the number of such discs.
    """
    from pseudorigid.proofs import THEOREMS

    bounds = [THEOREMS[name].bounds for name, known in proved.items() if known]
    return [
        {"share": float(b["share"]), "energy": float(b["surface"].energy), "period": b["period"]}
        for b in bounds
        if "share" in b
    ]


def regular_share(sweep: xr.Dataset, row: int, energy: float) -> dict[str, float]:
    """Return the regular share of a sweep's row, and its interval, at the nearest E/g^2."""
    cell = sweep.isel(k=row).sel(energy=energy, method="nearest")
    names = {"regular": "share", "regular_low": "low", "regular_high": "high"}
    return {names.get(n, n): float(cell[n]) for n in (*names, "k", "energy")}
