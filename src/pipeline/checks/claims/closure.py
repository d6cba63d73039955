"""Claims of the paper's sections 4.2 and 5: twist, conjecture, what is left open."""

import numpy as np

from pseudorigid.evidence.rotation import island, regular

from . import ledger
from .ledger import CORRECTED, HOLDS, NOT_COMPUTED, OPEN, PROVED, Verdict, formula

CLAIMS = []
claim = ledger.collector(CLAIMS)


def _turns(rises, falls):
    """Whether a rotation number with so many steps up and down has an extremum."""
    return min(rises, falls) > 0.1 * (rises + falls)


def _turning(found, row):
    """(rises, falls) of the rotation number from start to start across the main island."""
    size = island(found, row)
    good = regular(found["exponent"].values[row, :size], found.attrs["impacts"])
    steps = np.diff(found["rotation"].values[row, :size][good])
    large = np.abs(steps) > 1e-8  # the accuracy of the rotation numbers
    return int(np.sum(large & (steps > 0.0))), int(np.sum(large & (steps < 0.0)))


@claim(
    49,
    "4.2",
    "O",
    quote="the impact map cannot be readily categorized as a twist map",
    data=["rotation/rotation"],
    theorems=["twist-fixed-point", "twist-zero"],
)
def no_twist_map(data, proved):
    found = data["rotation/rotation"]
    energies = found["energy"].values
    counts = [_turning(found, row) for row in range(energies.size)]
    both = [f"{e:g}" for e, count in zip(energies, counts, strict=True) if _turns(*count)]
    monotone = min(counts[0]) == 0
    word = CORRECTED if monotone and both else HOLDS if both else OPEN
    said = "proved near the fixed point" if proved("twist-fixed-point") else "seen"
    value = f"a twist across the main island at E = {energies[0]:g} ({said})" if monotone else ""
    value += f"; none at E = {', '.join(both)}" if both else ""
    zero = "; it passes zero, proved" if proved("twist-zero") else ""
    return Verdict(word, value + zero, "along y = 0", "more_figures/claims/rotation.png")


@claim(
    50,
    "4.2",
    "O",
    quote="it is conjectured here that its symplectic property is responsible for the observed "
    "regular behavior",
    data=["derivations"],
    theorems=["twist-fixed-point", "twist-six"],
)
def conjecture(data, proved):
    area = formula(data["derivations"], "area")[0]
    reversible = formula(data["derivations"], "reversible")[1]
    both = proved("twist-fixed-point") and proved("twist-six")
    if not (area and both):
        return Verdict(OPEN, "", "", "./reproduce prove")
    value = "area kept makes the curves around the elliptic points (Moser)"
    value += "; so would the reversor, which the map has too" if reversible else ""
    return Verdict(CORRECTED, value, "near these points", "./reproduce prove")


@claim(
    51,
    "4.2",
    "Q",
    quote="This result is consistent with the findings in the recent work by Fetecau et al.",
)
def fetecau(data, proved):
    return Verdict(f"{NOT_COMPUTED}: a matter of citation", "", "", "")


@claim(
    52,
    "5",
    "O",
    quote="A rigorous justification for the existence of regular trajectories in the vicinity of "
    "the periodic points of the map along the lines of the KAM theory remains an outstanding "
    "question",
    theorems=["twist-fixed-point", "twist-fixed-point-low", "twist-six"],
)
def kam(data, proved):
    names = ("twist-fixed-point", "twist-fixed-point-low", "twist-six")
    done = [name for name in names if proved(name)]
    word = PROVED if len(done) == len(names) else OPEN
    value = f"invariant curves in every neighbourhood: {', '.join(done)}" if done else ""
    return Verdict(word, value, "near the points" if done else "", "./reproduce prove")


@claim(
    56,
    "4.2",
    "Q",
    quote="is remarkably similar to that of symplectic twist maps",
    data=["rotation/rotation"],
    theorems=["twist-fixed-point", "twist-six"],
)
def like_twist_maps(data, proved):
    up, down = _turning(data["rotation/rotation"], 0)
    word = HOLDS if min(up, down) == 0 < max(up, down) else OPEN
    word = PROVED if word == HOLDS and proved("twist-fixed-point") and proved("twist-six") else word
    value = f"the rotation number changes one way over {up + down} starts across the main island"
    return Verdict(word, value, "along y = 0", "more_figures/claims/rotation.png")
