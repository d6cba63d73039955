"""Checks of claims of the paper's sections 4.2 and 5: twist, conjecture, KAM theory."""

import numpy as np

from pseudorigid.analyses.regularity import regular
from pseudorigid.analyses.rotation import island

from .schema import HOLDS, PROVED, UNDECIDED, formula


def no_twist_map(found, proved):
    """Count the turns of the rotation number across the main island at each energy."""
    energies = found["energy"].values
    counts = [_turning(found, row) for row in range(energies.size)]
    both = [
        f"{energy:g}"
        for energy, (rises, falls) in zip(energies, counts, strict=True)
        if min(rises, falls) > 0.1 * (rises + falls)
    ]
    value = "at no energy monotone"
    if min(counts[0]) == 0:
        said = "proved near the fixed point" if proved["twist-fixed-point"] else "seen"
        value = f"at E = {energies[0]:g} it does not ({said})"
    if both:
        turns = "the rotation number turns back across the main island at E ="
        value = f"{turns} {', '.join(both)}; {value}"
    value += "; the fixed point's twist passes zero, proved" if proved["twist-zero"] else ""
    return HOLDS if both else UNDECIDED, value, "along y = 0"


def _turning(found, row):
    """(rises, falls) of the rotation number from start to start across the main island."""
    size = island(found, row)
    good = regular(found["exponent"].values[row, :size], found.attrs["impacts"])
    steps = np.diff(found["rotation"].values[row, :size][good])
    large = np.abs(steps) > 1e-8  # the accuracy of the rotation numbers
    return int(np.sum(large & (steps > 0.0))), int(np.sum(large & (steps < 0.0)))


def conjecture(algebra, proved):
    """Say which of the map's proved properties are enough for regular behaviour."""
    if not (formula(algebra, "area")[0] and all(proved.values())):
        return UNDECIDED, "neither curves nor area are proved", ""
    value = "near the elliptic points area kept and twist are enough, by Moser's theorem"
    if formula(algebra, "reversible")[1]:
        value += "; but so are twist and the reversor, which the map has as well (Sevryuk, "
        value += "Reversible Systems, Springer 1986): which of the two is responsible cannot be "
        value += "told"
    return UNDECIDED, f"{value}; of the islands as wide as they are drawn nothing is proved", ""


def kam(proved):
    """List the theorems of invariant curves that are proved."""
    done = [name for name, known in proved.items() if known]
    value = "invariant curves in every neighbourhood of the elliptic points of the theorems "
    value = value if done else "not proved"
    word = PROVED if len(done) == len(proved) else UNDECIDED
    return word, value + ", ".join(done), "near the points"


def like_kam(proved):
    """Ask for the theorems of invariant curves."""
    if all(proved.values()):
        return HOLDS, {}
    return UNDECIDED, "no invariant curve is proved", ""


def like_twist_maps(rotation, proved):
    """Count the rises and falls of the rotation number at the lowest energy."""
    up, down = _turning(rotation, 0)
    known = "near the elliptic points the map is a twist map (proved); "
    return HOLDS if min(up, down) == 0 < max(up, down) else UNDECIDED, {
        "known": known if all(proved.values()) else "",
        "energy": rotation["energy"].values[0],
        "moves": "falls" if down > up else "rises",
        "steps": up + down,
    }
