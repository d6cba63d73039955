"""The form of claims.toml, and what a claim and its verdict are."""

import tomllib
from collections.abc import Callable, Iterable, Mapping
from inspect import signature
from typing import Annotated, Any, Self

import numpy as np
import xarray as xr
from pydantic import AfterValidator, BaseModel, ConfigDict, Field, ValidationError, model_validator
from pydantic.dataclasses import dataclass

from extensions.proofs.derivations import FORMULAS
from extensions.proofs.kinds import theorems
from pipeline.config import ConfigError
from pipeline.config.schema.parts import STAGES
from pipeline.config.validation.mistakes import dotted
from pipeline.spelling import suggestion

from .lookup import derived
from .outcomes import PROVED, Outcome, VerdictWord

Text = Annotated[str, Field(min_length=1)]


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


def _hint(name: str, known: Iterable[str]) -> str:
    """Return a message on an unknown name, with the nearest known one or all."""
    hint = suggestion(name, known) or f"known are {', '.join(known)}"
    return f"{name!r} is not known: {hint}"


def _one_of(known: Iterable[str]) -> AfterValidator:
    """Return a validator of names. In the name of a dataset, only the stage counts."""
    names = [*known]

    def known_name(name: str) -> str:
        folder, _, own = name.rpartition("/")
        if own not in names and folder != "atlas":
            raise ValueError(_hint(own, names))
        return name

    return AfterValidator(known_name)


_Dataset = Annotated[str, _one_of(STAGES)]
_Theorem = Annotated[str, _one_of(theorems())]
_Formula = Annotated[str, _one_of(name for names in FORMULAS.values() for name in names)]
_Part = Annotated[list[str], Field(min_length=1, max_length=2)]


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
    quote: Text = ""
    paraphrase: Text = ""
    data: list[_Dataset] = []
    theorems: list[_Theorem] = []
    check: Text = ""
    function: Callable[..., Outcome] | None = None
    formulas: list[_Formula] = []
    verdict: VerdictWord | None = None
    value: Text = ""
    error: Text = ""
    evidence: Text = ""
    parts: dict[str, _Part] = {}
    cases: dict[str, Case] = {}

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        if bool(self.quote) == bool(self.paraphrase):
            raise ValueError("expected either quote or paraphrase")
        if sum(map(bool, (self.check, self.formulas, self.verdict))) != 1:
            raise ValueError("expected one of check, formulas and verdict")
        if self.formulas and self.data != ["derivations"]:
            raise ValueError('formulas are in one dataset: expected data = ["derivations"]')
        return self

    @property
    def statement(self) -> str:
        """The paper's words between quotation marks, or the paraphrase."""
        quoted = f"\N{LEFT DOUBLE QUOTATION MARK}{self.quote}\N{RIGHT DOUBLE QUOTATION MARK}"
        return quoted if self.quote else self.paraphrase

    def judge(self, datasets: Mapping[str, xr.Dataset], proofs: Mapping[str, str]) -> Verdict:
        """Return the verdict on the claim; `proofs` maps theorems to "proved" or another word.

        Raises ConfigError if a sentence asks for a number that the check does not give.
        """
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
        # True and false choose a text of `parts`, and have none of their own.
        texts = {n: v for n, v in outcome.numbers.items() if not isinstance(v, bool | np.bool_)}
        try:
            for name in (name for name in self.parts if name in outcome.numbers):
                texts[name] = _part(self.parts[name], outcome.numbers[name], texts)
            value, error = (s.format_map(texts) for s in (sentences.value, sentences.error))
        except (LookupError, ValueError, AttributeError, TypeError) as mistake:
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


class Document(_Table):
    """The tables of claims.toml."""

    head: Text
    verdicts: dict[VerdictWord, Text]
    claims: dict[Annotated[int, Field(strict=False)], Claim]


def _check_function(claim: Claim, place: str, checks: Mapping[str, Callable[..., Outcome]]) -> None:
    """Raise ValueError if a claim's check does not exist or takes other arguments."""
    if claim.function is None:
        raise ValueError(f"{place}: {_hint(claim.check, checks)}")
    arguments = [*claim.data, *(["a mapping of theorems"] if claim.theorems else [])]
    try:
        signature(claim.function).bind(*arguments)
    except TypeError:
        takes = f"{claim.check} does not take {len(arguments)} arguments: {', '.join(arguments)}"
        raise ValueError(f"{place}: {takes}") from None


def load(text: str, checks: Mapping[str, Callable[..., Outcome]]) -> Document:
    """Read claims.toml; `checks` are the functions by name.

    Raises ConfigError with a line for each mistake.
    """
    try:
        document = Document.model_validate(tomllib.loads(text))
        for number, claim in document.claims.items():
            claim.number, claim.function = number, checks.get(claim.check)
            if claim.check:
                _check_function(claim, f"claims.{number}.check", checks)
    except ValidationError as error:
        lines = [f"{dotted(each['loc'])}: {each['msg']}" for each in error.errors()]
    except ValueError as error:
        lines = [str(error)]
    else:
        return document
    raise ConfigError(*(f"claims.toml: {line.replace('Value error, ', '')}" for line in lines))
