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
    """Return a sweep with k and E/g^2 written out, and a line for each mistake between fields."""
    if mistakes(Sweep, given, place):
        return {}, []
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
    """Yield an error if the ends of an axis are wrong."""
    if isinstance(given, dict):
        low, high = given["from"], given["to"]
        if not low < high:
            yield (axis, "to"), high, f"a number above from = {low}"
        elif given.get("spacing") == "log" and not low > 0:
            yield (axis, "from"), low, "a number > 0 where spacing is log"


def _cross_field_errors(sweep: YamlMapping) -> Iterator[CrossFieldError]:
    """Yield errors between the fields of a sweep, each of which is correct by itself."""
    k, energy, block, impacts = (sweep[name] for name in ("k", "energy", "block", "impacts"))
    for i, each in enumerate(k):
        if not 0 < each <= 1:
            yield ("k",), each, f"numbers with 0 < k <= 1 (number {i + 1})"
            return
    yield from _energy_errors(energy[0], energy[-1], k, sweep.get("g"))
    orders = sweep.get("chains", [])
    if orders and len(k) == 1:
        yield ("chains",), orders, "no chains in a sweep of one k"
    if orders and not energy[0] > 0:
        yield ("energy",), energy[0], "energies > 0 in a sweep with chains"
    cells = len(k) * len(energy)
    if cells > MOST_CELLS:
        sizes = f"{len(k)} times {len(energy)}"
        yield ("energy",), energy, f"axes with at most {MOST_CELLS} cells, here {sizes}"
        return
    if cells * sweep["starts"] * impacts > LARGEST_IMPACTS:
        words = f"at most {LARGEST_IMPACTS} impacts in a sweep, counted over all cells and starts"
        yield ("impacts",), impacts, words
    if cells > MOST_JOBS * block:
        words = f"at least {-(-cells // MOST_JOBS)} cells a block, for at most {MOST_JOBS} jobs"
        yield ("block",), block, words


def _energy_errors(
    first: float, last: float, k: list[float], g: float | None
) -> Iterator[CrossFieldError]:
    """Yield an error for the first or last energy, or for g, if a ball could rest or flatten."""
    lowest = -1 / (2 * exact(k[-1]))
    if not exact(first) > lowest:
        words = f"E/g^2 above -1/(2k) = {float(lowest)}, where a ball with k = {k[-1]} is at rest"
        yield ("energy",), first, words
    if not last <= HIGHEST_ENERGY:
        yield ("energy",), last, f"E/g^2 of at most {HIGHEST_ENERGY:g}"
    elif g is not None and not g < k[0]:
        yield ("g",), g, f"0 < g < k = {k[0]}"
    elif g is not None:
        highest = (exact(k[0]) / 2 - exact(g)) / exact(g) ** 2
        if not exact(last) < highest:
            words = f"E/g^2 below (k/2 - g)/g^2 = {float(highest)}, where the ball could flatten"
            yield ("energy",), last, words


def _values(given: YamlMapping | list[float]) -> list[float]:
    """Return the numbers of an axis.

    Evenly spaced ones are exact to twelve digits where the ends are decimals. Those in equal ratios
    have six digits; they are computed in decimals, which have the same bits everywhere.
    """
    if isinstance(given, list):
        return [float(value) for value in given]
    low, high, count = given["from"], given["to"], given["count"]
    if given.get("spacing") != "log":
        first, last = exact(low), exact(high)
        values = [first + (last - first) * i / (count - 1) for i in range(count)]
        twelve = Context(prec=12)
        return [float(twelve.divide(Decimal(v.numerator), Decimal(v.denominator))) for v in values]
    start, end = (_FORTY_DIGITS.ln(Decimal(str(value))) for value in (low, high))
    step = _FORTY_DIGITS.divide(_FORTY_DIGITS.subtract(end, start), Decimal(count - 1))
    powers = (_FORTY_DIGITS.fma(step, Decimal(i), start) for i in range(count))
    return [float(Context(prec=6).plus(_FORTY_DIGITS.exp(power))) for power in powers]
