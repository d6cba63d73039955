"""Validation of sweeps: axes are written out, and checked against bounds of two numbers."""

from collections.abc import Iterator
from decimal import Context, Decimal
from itertools import pairwise

from ..schema.fields import YamlMapping
from ..schema.scene import CrossFieldError, exact
from ..schema.sweep import Sweep
from .mistakes import mistakes
from .words import Place, refusal

# Bounds of a sweep.
LARGEST_IMPACTS = 10_000_000_000_000  # a larger number is a slip
MOST_CELLS = 1_000_000  # each start of ./reproduce looks at all of them
MOST_JOBS = 5000  # with more, snakemake is busier with its list than with the jobs
HIGHEST_ENERGY = 1e9  # E/g^2
_FORTY_DIGITS = Context(prec=40)


def checked(given: YamlMapping, place: Place) -> tuple[YamlMapping, list[str]]:
    """Return a sweep with k and E/g^2 written out as lists, and a line for each mistake."""
    lines = mistakes(Sweep, given, place)
    if lines:
        return {}, lines
    sweep = dict(given)
    errors: list[CrossFieldError] = []
    for axis in ("k", "energy"):
        errors += _axis_errors(given[axis], axis)
        sweep[axis] = [] if errors else _values(given[axis])
        if any(not a < b for a, b in pairwise(sweep[axis])):
            errors.append(((axis,), given[axis], "increasing numbers that differ in six digits"))
    errors = errors or [*_cross_field_errors(sweep)]
    return sweep, [refusal((*place, *where), value, allowed) for where, value, allowed in errors]


def _axis_errors(given: YamlMapping | list[float], axis: str) -> Iterator[CrossFieldError]:
    if isinstance(given, list):
        return
    low, high = given["from"], given["to"]
    if not low < high:
        yield (axis, "to"), high, f"a number above from = {low}"
    elif given.get("spacing") == "log" and not low > 0:
        yield (axis, "from"), low, "a number > 0 where spacing is log"


def _values(given: YamlMapping | list[float]) -> list[float]:
    if isinstance(given, list):
        return [float(value) for value in given]
    spaced = _log_spaced if given.get("spacing") == "log" else _evenly_spaced
    return spaced(given["from"], given["to"], given["count"])


def _cross_field_errors(sweep: YamlMapping) -> Iterator[CrossFieldError]:
    """Yield errors between the fields of a sweep, each of which is correct by itself."""
    for i, k in enumerate(sweep["k"]):
        if not 0 < k <= 1:
            yield ("k",), k, f"numbers with 0 < k <= 1 (number {i + 1})"
            return
    yield from _energy_errors(sweep)
    cells = len(sweep["k"]) * len(sweep["energy"])
    if cells > MOST_CELLS:
        sizes = f"{len(sweep['k'])} times {len(sweep['energy'])}"
        words = f"axes with at most {MOST_CELLS} cells, here {sizes}"
        yield ("energy",), sweep["energy"], words
        return
    if cells * sweep["starts"] * sweep["impacts"] > LARGEST_IMPACTS:
        words = f"at most {LARGEST_IMPACTS} impacts in a sweep, counted over all cells and starts"
        yield ("impacts",), sweep["impacts"], words
    if cells > MOST_JOBS * sweep["block"]:
        words = f"at least {-(-cells // MOST_JOBS)} cells a block, for at most {MOST_JOBS} jobs"
        yield ("block",), sweep["block"], words


def _energy_errors(sweep: YamlMapping) -> Iterator[CrossFieldError]:
    first, last = sweep["energy"][0], sweep["energy"][-1]
    k = max(sweep["k"])
    lowest = -1 / (2 * exact(k))
    if not exact(first) > lowest:
        words = f"E/g^2 above -1/(2k) = {float(lowest)}, where a ball with k = {k} is at rest"
        yield ("energy",), first, words
    if not last <= HIGHEST_ENERGY:
        yield ("energy",), last, f"E/g^2 of at most {HIGHEST_ENERGY:g}"
        return
    if "g" not in sweep:
        return
    least_k, g = exact(min(sweep["k"])), exact(sweep["g"])
    if not g < least_k:
        yield ("g",), sweep["g"], f"0 < g < k = {float(least_k)}"
        return
    highest = (least_k / 2 - g) / (g * g)
    if not exact(last) < highest:
        words = f"E/g^2 below (k/2 - g)/g^2 = {float(highest)}, where the ball could flatten"
        yield ("energy",), last, words


def _evenly_spaced(low: float, high: float, count: int) -> list[float]:
    """Return evenly spaced numbers, exact to twelve digits where the ends are decimals."""
    first, last = exact(low), exact(high)
    values = [first + (last - first) * i / (count - 1) for i in range(count)]
    return [
        float(Context(prec=12).divide(Decimal(value.numerator), Decimal(value.denominator)))
        for value in values
    ]


def _log_spaced(low: float, high: float, count: int) -> list[float]:
    """Return numbers in equal ratios, to six digits. Decimals have the same bits everywhere."""
    first, last = _FORTY_DIGITS.ln(Decimal(str(low))), _FORTY_DIGITS.ln(Decimal(str(high)))
    step = _FORTY_DIGITS.divide(_FORTY_DIGITS.subtract(last, first), Decimal(count - 1))
    powers = (_FORTY_DIGITS.fma(step, Decimal(i), first) for i in range(count))
    return [float(Context(prec=6).plus(_FORTY_DIGITS.exp(power))) for power in powers]
