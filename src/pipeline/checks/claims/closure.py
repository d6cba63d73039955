"""Claims of the paper's sections 4.2 and 5: twist, conjecture, what is open or undecided."""

from importlib import resources

import numpy as np

from pseudorigid.evidence.rotation import island, regular

from .ledger import HOLDS, PROVED, UNDECIDED, Verdict, claim, formula

_CERTIFICATES = resources.files("pseudorigid.proofs") / "certificates"
# All theorems of invariant curves; `twist-zero` says where the twist vanishes, and proves none.
KAM = tuple(
    sorted(
        file.name.removesuffix(".toml")
        for file in _CERTIFICATES.iterdir()
        if file.name.startswith("twist-") and file.name != "twist-zero.toml"
    )
)


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
    word = HOLDS if both else UNDECIDED
    said = "proved near the fixed point" if proved("twist-fixed-point") else "seen"
    value = f"the rotation number turns back across the main island at E = {', '.join(both)}; "
    value = value if both else ""
    value += f"at E = {energies[0]:g} it does not ({said})" if monotone else "at no energy monotone"
    zero = "; the fixed point's twist passes zero, proved" if proved("twist-zero") else ""
    return Verdict(word, value + zero, "along y = 0", "more_figures/claims/rotation.png")


@claim(50, "4.2", "O", "derivations", theorems=["twist-fixed-point", "twist-six"])
def conjecture(algebra, proved):
    """“Although the impact map cannot be readily categorized as a twist map, it is conjectured here
    that its symplectic property is responsible for the observed regular behavior”"""
    evidence = "./reproduce prove"
    if not (formula(algebra, "area")[0] and proved("twist-fixed-point", "twist-six")):
        return Verdict(UNDECIDED, "neither curves nor area are proved", "", evidence)
    value = "near the elliptic points area kept and twist are enough, by Moser's theorem"
    if formula(algebra, "reversible")[1]:
        value += "; but so are twist and the reversor, which the map has as well (Sevryuk, "
        value += (
            "Reversible Systems, Springer 1986): which of the two is responsible cannot be told"
        )
    value += "; of the islands as wide as they are drawn nothing is proved"
    return Verdict(UNDECIDED, value, "", evidence)


@claim(51, "4.2", "Q")
def fetecau():
    """“This result is consistent with the findings in the recent work by Fetecau et al.”"""
    return Verdict(UNDECIDED, "not computed: a matter of citation", "", "")


@claim(52, "5", "O", theorems=KAM)
def kam(proved):
    """“A rigorous justification for the existence of regular trajectories in the vicinity of
    the periodic points of the map along the lines of the KAM theory remains an outstanding
    question”"""
    done = [name for name in KAM if proved(name)]
    word = PROVED if len(done) == len(KAM) else UNDECIDED
    value = "invariant curves in every neighbourhood of the elliptic points of the theorems "
    value = value if done else "not proved"
    return Verdict(word, value + ", ".join(done), "near the points", "./reproduce prove")


@claim(70, "1", "Q", theorems=KAM)
def like_kam(proved):
    """“The observed response is analogous to that predicted by the KAM theory”"""
    if not proved(*KAM):
        return Verdict(UNDECIDED, "no invariant curve is proved", "", "./reproduce prove")
    value = "a judgement: invariant curves near the elliptic points (row 52), gaps at resonances "
    value += "(row 23), a last curve (row 28), chaos beyond it (row 30)"
    return Verdict(HOLDS, value, "", "./reproduce prove")


@claim(56, "4.2", "Q", "rotation/rotation", theorems=["twist-fixed-point", "twist-six"])
def like_twist_maps(rotation, proved):
    """“The regular behavior exhibited by the impact map in the neighborhood of periodic points is
    remarkably similar to that of symplectic twist maps, such as the standard map”"""
    up, down = _turning(rotation, 0)
    word = HOLDS if min(up, down) == 0 < max(up, down) else UNDECIDED
    value = "a judgement: "
    known = proved("twist-fixed-point", "twist-six")
    value += "near the elliptic points the map is a twist map (proved); " if known else ""
    value += f"at E = {rotation['energy'].values[0]:g} the rotation number "
    value += f"{'falls' if down > up else 'rises'} outwards in all {up + down} steps from start to "
    value += "start across the main island"
    return Verdict(word, value, "along y = 0", "more_figures/claims/rotation.png")


@claim(57, "2.2", "Q")
def agree_with_solberg():
    """“The resulting equations agree with those derived in [7] using the momentum balances for the
    pseudo-rigid body”"""
    return Verdict(UNDECIDED, "not computed: the source is not at hand", "", "")


@claim(58, "Figure 1", "F")
def sketch():
    """a sketch of the ball, its position and its strain"""
    return Verdict(UNDECIDED, "not computed: a sketch, not a result", "", "")
