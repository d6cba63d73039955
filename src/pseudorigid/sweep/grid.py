"""The sweeps of config.yaml: their check, their cells, and the files these are kept in.

Cells are counted along the energies of one k, then the next k. Importing this module is cheap.
"""

from decimal import Context, Decimal
from fractions import Fraction
from itertools import pairwise

LARGEST = 10_000_000_000_000  # impacts of a sweep: above it a number is a slip
MOST_JOBS = 5000  # of a sweep: beyond, snakemake is busier with its list than with the jobs
HIGHEST = 1e9  # of E/g^2
FORMATS = ("png", "svg")  # of a line; of a plane the first alone
_EXACT = Context(prec=40)


# ---- checking ----


def check(sweeps, structure, refusal) -> dict:
    """The complete sweeps of a config: the lists of k and energy (E/g^2) written out.

    `structure(instance, definition, place)` checks against the schema, `refusal(place, value,
    allowed)` makes the error that is raised: both are those of `config`, which calls this.
    """
    structure(sweeps, "sweeps", ("sweeps",))
    return {
        name: _checked(block, ("sweeps", name), structure, refusal)
        for name, block in sweeps.items()
    }


def _checked(block, place, structure, refusal):
    structure(block, "sweep", place)
    block = block | {
        axis: _axis(block[axis], (*place, axis), structure, refusal) for axis in ("k", "energy")
    }
    for i, k in enumerate(block["k"]):
        if not 0 < k <= 1:
            raise refusal((*place, "k"), k, f"numbers with 0 < k <= 1 (number {i + 1})")
    _check_energies(block, place, refusal)
    cells = len(block["k"]) * len(block["energy"])
    if cells * block["starts"] * block["impacts"] > LARGEST:
        what = f"at most {LARGEST} impacts in a sweep, counted over all cells and starts"
        raise refusal((*place, "impacts"), block["impacts"], what)
    if cells > MOST_JOBS * block["block"]:
        what = f"at least {-(-cells // MOST_JOBS)} cells a block, for at most {MOST_JOBS} jobs"
        raise refusal((*place, "block"), block["block"], what)
    return block


def _check_energies(block, place, refusal):
    where = (*place, "energy")
    k = max(block["k"])
    lowest = -1 / (2 * Fraction(str(k)))
    if not Fraction(str(block["energy"][0])) > lowest:
        what = f"E/g^2 above -1/(2k) = {float(lowest):g}, where a ball with k = {k} is at rest"
        raise refusal(where, block["energy"][0], what)
    if not block["energy"][-1] <= HIGHEST:
        raise refusal(where, block["energy"][-1], f"E/g^2 of at most {HIGHEST:g}")
    if "g" not in block:
        return
    k, g = Fraction(str(min(block["k"]))), Fraction(str(block["g"]))
    if not g < k:
        raise refusal((*place, "g"), block["g"], f"0 < g < k = {float(k):g}")
    highest = (k / 2 - g) / (g * g)
    if not Fraction(str(block["energy"][-1])) < highest:
        what = f"E/g^2 below (k/2 - g)/g^2 = {float(highest):g}, where the ball could flatten"
        raise refusal(where, block["energy"][-1], what)


def _axis(given, place, structure, refusal):
    """The numbers of an axis: as listed, or from `from` to `to`."""
    if isinstance(given, list):
        structure(given, "sweep_list", place)
        values = [float(value) for value in given]
    else:
        structure(given, "sweep_range", place)
        low, high, logarithmic = given["from"], given["to"], given.get("spacing") == "log"
        if not low < high:
            raise refusal((*place, "to"), high, f"a number above from = {low}")
        if logarithmic and not low > 0:
            raise refusal((*place, "from"), low, "a number > 0 where spacing is log")
        values = (_log_spaced if logarithmic else _evenly_spaced)(low, high, given["count"])
    if any(not a < b for a, b in pairwise(values)):
        raise refusal(place, given, "increasing numbers that differ in six digits")
    return values


def _evenly_spaced(low, high, count):
    """`count` numbers, rounded to twelve digits: of decimals, the decimals they are meant to be."""
    low, high = Fraction(str(low)), Fraction(str(high))
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


# ---- cells and files ----


def cells(sweep) -> int:
    """How many cells."""
    return len(sweep["k"]) * len(sweep["energy"])


def ranges(sweep) -> list[tuple[int, int]]:
    """Of each block, its first cell and the one after its last."""
    count, size = cells(sweep), sweep["block"]
    return [(start, min(start + size, count)) for start in range(0, count, size)]


def block(sweep, number) -> dict:
    """What decides the data of a block: its cells as [k, E/g^2], and the orbits of each."""
    start, stop = ranges(sweep)[number]
    across = len(sweep["energy"])
    return {
        "cells": [
            [sweep["k"][i // across], sweep["energy"][i % across]] for i in range(start, stop)
        ],
        "starts": sweep["starts"],
        "impacts": sweep["impacts"],
    }


def whole(sweep) -> dict:
    """What decides the data of the sweep: not how it is cut into blocks."""
    return {key: sweep[key] for key in ("k", "energy", "starts", "impacts")}


def block_files(name, sweep) -> list[str]:
    """Where its blocks are kept, from the project's root."""
    return [f"results/sweep/blocks/{name}_{i:04d}.nc" for i in range(len(ranges(sweep)))]


def dataset(name) -> str:
    """Where the whole sweep is."""
    return f"results/sweep/{name}.nc"


def record(name) -> str:
    """Where its sha256 is."""
    return f"results/sweep/{name}.nc.sha256"


def pictures(name, sweep) -> list[str]:
    """Where its pictures are drawn, and where users look for them.

    A plane has a rectangle a cell: as vectors they would weigh megabytes.
    """
    formats = FORMATS if is_line(sweep) else FORMATS[:1]
    folders = ("results/sweep/figures", "atlas_figures")
    return [f"{folder}/{name}.{extension}" for folder in folders for extension in formats]


def is_line(sweep) -> bool:
    """Whether a sweep is drawn against the energy alone."""
    return len(sweep["k"]) == 1
