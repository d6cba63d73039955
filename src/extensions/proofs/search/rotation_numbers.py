"""Rotation numbers for which invariant curves can be sought. Nothing here takes long to import."""

import math
from collections.abc import Sequence

_CLOSE = 5e-4  # of a noble number to the wanted rotation number
_TRIALS = 20  # numbers on each side of a refused one, 1e-4 apart


def quotients_near(value: float) -> list[int]:
    """Return partial quotients for which the number of `checkers.circle.noble` is close to a value.

    They are the first ones of the value's continued fraction. Raises ValueError for a value so
    close to a fraction of small integers that this gives no number close to it.

    >>> quotients_near(0.1524)
    [6, 1, 1, 3]
    """
    if quotients := _quotients(value):
        return quotients
    near = [
        next((n for i in range(1, _TRIALS) if _quotients(n := round(value + side * i, 4))), None)
        for side in (-1e-4, 1e-4)
    ]
    words = " and ".join(f"{number:g}" for number in near if number)
    raise ValueError(
        f"{value:.10g} is too close to a fraction of small integers: "
        f"the nearest that are not are {words}"
    )


def _quotients(value: float) -> list[int]:
    """Return the partial quotients, or none if there is no number close to the value."""
    rest, quotients = value, []
    while rest > 0.0:
        rest = 1.0 / rest
        quotients.append(int(rest))
        rest -= int(rest)
        if abs(_noble(quotients) - value) < _CLOSE:
            return quotients
        if rest < _CLOSE:
            break
    return []


def _noble(quotients: Sequence[int]) -> float:
    """Return [0; quotients, then 1 for ever]."""
    value = (1.0 + math.sqrt(5.0)) / 2.0
    for a in reversed(quotients):
        value = a + 1.0 / value
    return 1.0 / value
