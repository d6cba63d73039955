"""The form of claims.toml, what a claim and its verdict are, and what the checks share."""

from collections.abc import Callable, Mapping
from typing import Annotated, Any, Literal, NamedTuple, get_args

import numpy as np
import xarray as xr
from pydantic import BaseModel, ConfigDict, Field
from pydantic.dataclasses import dataclass

VerdictWord = Literal["does not hold", "holds with a correction", "undecided", "proved", "holds"]
VERDICT_WORDS = get_args(VerdictWord)
FALSE, CORRECTED, UNDECIDED, PROVED, HOLDS = VERDICT_WORDS

Text = Annotated[str, Field(min_length=1)]


class Outcome(NamedTuple):
    """What a check found: a verdict, the numbers of its sentences, and which sentences apply."""

    verdict: VerdictWord
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
    verdict: VerdictWord
    value: Text
    error: str
    evidence: str
    datasets: list[str]


class _Table(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True)


class Case(_Table):
    """The sentences of another outcome of a claim."""

    value: Text
    error: Text = ""


class Claim(_Table):
    """A table of claims.toml, whose head says what the fields mean.

    `check` names `function`, which takes the datasets and, if theorems are named, a mapping from
    their names to whether they are proved, and returns an Outcome.
    """

    number: int = 0
    place: Text
    quote: str = ""
    paraphrase: str = ""
    data: list[str] = []
    theorems: list[str] = []
    check: str = ""
    function: Callable[..., Outcome] | None = None
    formulas: list[str] = []
    verdict: VerdictWord | None = None
    value: Text
    error: str = ""
    evidence: str = ""
    parts: dict[str, list[str]] = {}
    cases: dict[str, Case] = {}

    @property
    def statement(self) -> str:
        """The paper's words between quotation marks, or the paraphrase."""
        quoted = f"\N{LEFT DOUBLE QUOTATION MARK}{self.quote}\N{RIGHT DOUBLE QUOTATION MARK}"
        return quoted if self.quote else self.paraphrase

    def judge(self, datasets: Mapping[str, xr.Dataset], proofs: Mapping[str, str]) -> Verdict:
        """Return the verdict on the claim; `proofs` maps theorems to "proved" or another word."""
        inputs: list[Any] = [datasets[name] for name in self.data]
        if self.theorems:
            inputs.append({name: proofs.get(name) == PROVED for name in self.theorems})
        if self.function is not None:
            outcome = self.function(*inputs)
        elif self.verdict is not None:
            outcome = Outcome(self.verdict)
        else:
            outcome = derived(*inputs, *self.formulas)
        sentences = self.cases[outcome.case] if outcome.case else self
        numbers = dict(outcome.numbers)
        for name in (name for name in self.parts if name in numbers):
            numbers[name] = _part(self.parts[name], numbers[name], numbers)
        value, error = (text.format_map(numbers) for text in (sentences.value, sentences.error))
        return Verdict(
            self.number, self.place, self.statement, outcome.verdict, value, error, self.evidence,
            self.data,
        )  # fmt: skip


def _part(texts: list[str], number: Any, numbers: dict[str, Any]) -> str:
    """Return one text for each row of a list, or the text for true or false."""
    if isinstance(number, list):
        return "; ".join(texts[0].format_map(row) for row in number)
    return [*texts, ""][0 if number else 1].format_map(numbers)


class Document(_Table):
    """The tables of claims.toml."""

    head: Text
    verdicts: dict[VerdictWord, Text]
    claims: dict[Annotated[int, Field(strict=False)], Claim]


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
