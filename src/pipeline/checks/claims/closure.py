"""Claims of the paper's sections 4.2 and 5: twist, conjecture, what is open or not computed."""

import numpy as np

from pseudorigid.evidence.rotation import island, regular

from .ledger import CORRECTED, HOLDS, NOT_COMPUTED, OPEN, PROVED, Verdict, claim, formula

KAM = ("twist-fixed-point", "twist-fixed-point-low", "twist-six")


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


@claim(49, "4.2", "O", "rotation/rotation", theorems=["twist-fixed-point", "twist-zero"])
def no_twist_map(found, proved):
    """“the impact map cannot be readily categorized as a twist map”"""
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


@claim(50, "4.2", "O", "derivations", theorems=["twist-fixed-point", "twist-six"])
def conjecture(algebra, proved):
    """“it is conjectured here that its symplectic property is responsible for the observed
    regular behavior”"""
    if not (formula(algebra, "area")[0] and proved("twist-fixed-point", "twist-six")):
        return Verdict(OPEN, "", "", "./reproduce prove")
    value = "area kept makes the curves around the elliptic points (Moser)"
    if formula(algebra, "reversible")[1]:
        value += "; so would the reversor, which the map has too"
    return Verdict(CORRECTED, value, "near these points", "./reproduce prove")


@claim(51, "4.2", "Q")
def fetecau():
    """“This result is consistent with the findings in the recent work by Fetecau et al.”"""
    return Verdict(f"{NOT_COMPUTED}: a matter of citation", "", "", "")


@claim(52, "5", "O", theorems=KAM)
def kam(proved):
    """“A rigorous justification for the existence of regular trajectories in the vicinity of
    the periodic points of the map along the lines of the KAM theory remains an outstanding
    question”"""
    done = [name for name in KAM if proved(name)]
    word = PROVED if len(done) == len(KAM) else OPEN
    value = f"invariant curves in every neighbourhood: {', '.join(done)}" if done else ""
    return Verdict(word, value, "near the points" if done else "", "./reproduce prove")


@claim(56, "4.2", "Q", "rotation/rotation", theorems=["twist-fixed-point", "twist-six"])
def like_twist_maps(rotation, proved):
    """“is remarkably similar to that of symplectic twist maps”"""
    up, down = _turning(rotation, 0)
    word = PROVED if proved("twist-fixed-point", "twist-six") else HOLDS
    word = word if min(up, down) == 0 < max(up, down) else OPEN
    value = f"the rotation number changes one way over {up + down} starts across the main island"
    return Verdict(word, value, "along y = 0", "more_figures/claims/rotation.png")


@claim(57, "2.2", "Q")
def agree_with_solberg():
    """“The resulting equations agree with those derived in [7]”"""
    return Verdict(f"{NOT_COMPUTED}: the source is not at hand", "", "", "")


@claim(58, "Figure 1", "F")
def sketch():
    """a sketch of the ball, its position and its strain"""
    return Verdict(f"{NOT_COMPUTED}: a sketch, not a result", "", "", "")
