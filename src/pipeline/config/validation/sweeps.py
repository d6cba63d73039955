"""The sweeps of the config: their axes written out, and the bounds that take two numbers."""

from decimal import Context, Decimal
from itertools import pairwise

from ..schema.scene import exact
from ..schema.sweep import Sweep
from .mistakes import mistakes
from .words import refusal

LARGEST = 10_000_000_000_000  # impacts of a sweep: above it a number is a slip
MOST_CELLS = 1_000_000  # of a sweep: each start of ./reproduce looks at all
MOST_JOBS = 5000  # of a sweep: beyond, snakemake is busier with its list than with the jobs
HIGHEST = 1e9  # of E/g^2
_EXACT = Context(prec=40)


def checked(given, place):
    """(the sweep with its lists of k and E/g^2 written out, []), or (None, its mistakes)."""
    lines = mistakes(Sweep, given, place)
    if lines:
        return None, lines
    sweep, errors = dict(given), []
    for axis in ("k", "energy"):
        errors += _axis_errors(given[axis], axis)
        sweep[axis] = [] if errors else _values(given[axis])
        if any(not a < b for a, b in pairwise(sweep[axis])):
            errors.append(((axis,), given[axis], "increasing numbers that differ in six digits"))
    errors = errors or [*_cross_field_errors(sweep)]
    lines = [refusal((*place, *where), value, allowed) for where, value, allowed in errors]
    return (None, lines) if lines else (sweep, [])


def _axis_errors(given, axis):
    """What is wrong with an axis from `from` to `to`."""
    if isinstance(given, list):
        return
    low, high = given["from"], given["to"]
    if not low < high:
        yield (axis, "to"), high, f"a number above from = {low}"
    elif given.get("spacing") == "log" and not low > 0:
        yield (axis, "from"), low, "a number > 0 where spacing is log"


def _values(given):
    """The numbers of an axis: as listed, or from `from` to `to`."""
    if isinstance(given, list):
        return [float(value) for value in given]
    spaced = _log_spaced if given.get("spacing") == "log" else _evenly_spaced
    return spaced(given["from"], given["to"], given["count"])


def _cross_field_errors(sweep):
    """What is wrong with a sweep whose axes are well each by itself."""
    for i, k in enumerate(sweep["k"]):
        if not 0 < k <= 1:
            yield ("k",), k, f"numbers with 0 < k <= 1 (number {i + 1})"
            return
    yield from _energy_errors(sweep)
    cells = len(sweep["k"]) * len(sweep["energy"])
    if cells > MOST_CELLS:
        sizes = f"{len(sweep['k'])} times {len(sweep['energy'])}"
        what = f"axes with at most {MOST_CELLS} cells, here {sizes}"
        yield ("energy",), sweep["energy"], what
        return
    if cells * sweep["starts"] * sweep["impacts"] > LARGEST:
        what = f"at most {LARGEST} impacts in a sweep, counted over all cells and starts"
        yield ("impacts",), sweep["impacts"], what
    if cells > MOST_JOBS * sweep["block"]:
        what = f"at least {-(-cells // MOST_JOBS)} cells a block, for at most {MOST_JOBS} jobs"
        yield ("block",), sweep["block"], what


def _energy_errors(sweep):
    first, last = sweep["energy"][0], sweep["energy"][-1]
    k = max(sweep["k"])
    lowest = -1 / (2 * exact(k))
    if not exact(first) > lowest:
        what = f"E/g^2 above -1/(2k) = {float(lowest)}, where a ball with k = {k} is at rest"
        yield ("energy",), first, what
    if not last <= HIGHEST:
        yield ("energy",), last, f"E/g^2 of at most {HIGHEST:g}"
        return
    if "g" not in sweep:
        return
    k, g = exact(min(sweep["k"])), exact(sweep["g"])
    if not g < k:
        yield ("g",), sweep["g"], f"0 < g < k = {float(k)}"
        return
    highest = (k / 2 - g) / (g * g)
    if not exact(last) < highest:
        what = f"E/g^2 below (k/2 - g)/g^2 = {float(highest)}, where the ball could flatten"
        yield ("energy",), last, what


def _evenly_spaced(low, high, count):
    """`count` numbers, rounded to twelve digits: of decimals, the decimals they are meant to be."""
    low, high = exact(low), exact(high)
    values = [low + (high - low) * i / (count - 1) for i in range(count)]
    return [
        float(Context(prec=12).divide(Decimal(value.numerator), Decimal(value.denominator)))
        for value in values
    ]


def _log_spaced(low, high, count):
    """`count` numbers in equal ratios, to six digits; decimals have the same bits everywhere."""
    low, high = _EXACT.ln(Decimal(str(low))), _EXACT.ln(Decimal(str(high)))
    step = _EXACT.divide(_EXACT.subtract(high, low), Decimal(count - 1))
    powers = (_EXACT.fma(step, Decimal(i), low) for i in range(count))
    return [float(Context(prec=6).plus(_EXACT.exp(power))) for power in powers]
