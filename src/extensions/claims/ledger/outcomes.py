"""What a check of a claim returns: a verdict, and the numbers of its sentences."""

from typing import Any, Literal, NamedTuple, get_args

VerdictWord = Literal[
    "does not hold", "holds with a correction", "undecided", "proved", "holds", "not checkable"
]
VERDICT_WORDS = get_args(VerdictWord)
FALSE, CORRECTED, UNDECIDED, PROVED, HOLDS, UNCHECKED = VERDICT_WORDS


class Outcome(NamedTuple):
    """What a check found: a verdict, the numbers of its sentences, and which sentences apply."""

    verdict: VerdictWord
    numbers: dict[str, Any] = {}  # noqa: RUF012  (never changed)
    case: str = ""  # a key of the claim's `cases`; empty for `value` and `error`


class Series(tuple[Any, ...]):
    """Numbers that a template formats one by one: "{ends:.2f}" gives "0.23, 0.24"."""

    def __format__(self, spec: str) -> str:
        return ", ".join(format(number, spec) for number in self)


def outcome_of(holds: object, proved: bool = False, /, **numbers: Any) -> Outcome:
    """Return the outcome for a statement that does or does not hold, and then may be proved."""
    return Outcome(FALSE if not holds else PROVED if proved else HOLDS, numbers)
