"""The ledger of claims: each has a check, each check can fail, CLAIMS.md says what they found."""

import os
import re
from pathlib import Path

import numpy as np
import pytest

from pipeline.checks import claims
from pipeline.checks.claims import ledger
from pipeline.checks.claims.ledger import CORRECTED, FALSE, HOLDS, NOT_COMPUTED, OPEN, PROVED
from pipeline.checks.claims.render import render

PAPER_TEXT = "PAPER_TEXT"  # the environment variable that names the paper's text


@pytest.fixture(scope="module")
def verdicts(datasets):
    return claims.judge(datasets, {})


EXPECTED = {
    FALSE: {5, 14, 19, 33},
    CORRECTED: {3, 4, 6, 7, 11, 13, 17, 22, 23, 37, 40, 44, 49},
    OPEN: {30, 50, 52},
    PROVED: {48},
}


def test_verdicts_without_a_proof(verdicts):
    for number, verdict in verdicts.items():
        word = next((w for w, numbers in EXPECTED.items() if number in numbers), HOLDS)
        if number in (51, 57, 58):
            assert verdict.verdict.startswith(f"{NOT_COMPUTED}: ")
        else:
            assert verdict.verdict == word, (number, verdict)


def test_all_statements_are_there():
    assert list(claims.CLAIMS) == list(range(1, 59))
    assert set(claims.theorems()) >= {"horseshoe-inner", "horseshoe-outer", "twist-fixed-point"}


@pytest.mark.parametrize("number", range(1, 59))
def test_words_are_short_and_whole(number):
    claim = claims.CLAIMS[number]
    assert claim.words == " ".join(claim.words.split())
    assert 5 < len(claim.words) < 250
    assert claim.words.isascii()
    assert "..." not in claim.words


def squeezed(text):
    """Text without what a transcript changes: spaces, hyphens at line ends, quotation marks."""
    return re.sub(r"[\s\-\N{RIGHT SINGLE QUOTATION MARK}']", "", text)


@pytest.mark.skipif(PAPER_TEXT not in os.environ, reason=f"{PAPER_TEXT} names no text")
@pytest.mark.parametrize("number", range(1, 59))
def test_quotes_are_the_papers_words(number):
    claim = claims.CLAIMS[number]
    text = squeezed(Path(os.environ[PAPER_TEXT]).read_text(encoding="utf-8"))
    assert (squeezed(claim.words) in text) == claim.quoted


def test_a_quote_is_compared_letter_by_letter():
    assert squeezed("a pe-\n  riodic\N{RIGHT SINGLE QUOTATION MARK}s") == squeezed("a periodic's")
    assert squeezed("is smooth") != squeezed("is smooth,")


# -- a wrong dataset changes the verdict ----------------------------------------------------------


def broken(*names):
    """The derivations with these formulas neither holding nor mended."""

    def change(datasets):
        found = datasets["derivations"].copy(deep=True)
        for name in names:
            row = found["formula"].values.tolist().index(name)
            found["printed"].values[row] = found["corrected"].values[row] = 0
        return {"derivations": found}

    return change


def changed(name, **values):
    """A dataset with variables replaced by what functions make of them."""

    def change(datasets):
        found = datasets[name].copy(deep=True)
        for variable, make in values.items():
            found[variable] = found[variable].copy(data=make(found[variable].values.copy()))
        return {name: found}

    return change


def attributes(name, **values):
    return lambda datasets: {name: datasets[name].assign_attrs(values)}


def shortened(name, **parts):
    return lambda datasets: {name: datasets[name].isel(parts)}


def first_to(value):
    def make(values):
        values.reshape(-1)[0] = value
        return values

    return make


def negated(values):
    return -values


def no_valley(values):
    return np.full_like(values, values.max())


def shifted_orbit(values):
    values[:, 0] += 0.05
    return values


def half(values):
    return np.full_like(values, 0.5)


def hundredth(values):
    return 0.01 * values


CONSTANT = dict.fromkeys(("regular", "regular_low", "regular_high"), half)
ONE_WAY = {"rotation": lambda v: np.linspace(0.18, 0.17, v.size).reshape(v.shape)}
WRONG = {
    1: broken("uncoupled"),
    2: changed("clusters/clusters", strain_energy=hundredth),
    3: broken("shell"),
    4: attributes("fig2/orbits", k=0.3),
    5: changed("clusters/clusters", least_strain=hundredth, largest_strain=hundredth),
    6: broken("contact_speed"),
    7: broken("impulsive_forces"),
    8: broken("jump_conditions"),
    9: broken("impulse_without_stiffness"),
    10: broken("scaling"),
    11: broken("scaled_impulse"),
    12: broken("flights"),
    13: broken("impact_map"),
    14: changed("jumps/jumps", length=np.zeros_like),
    15: changed("clusters/clusters", energy_error=first_to(1e-6)),
    16: changed("fig8/orbits", xdot=negated, udot=negated),
    17: broken("bound"),
    18: changed("clusters/clusters", least_strain=first_to(-1.01)),
    19: attributes("as_published/fig7/lyapunov", impacts_missed=0),
    20: shortened("fig2/orbits", orbit=slice(0, 7)),
    21: changed("fig3/periodic", type=first_to("hyperbolic")),
    22: shortened("fig4/periodic", orbit=slice(0, 1)),
    23: changed("rotation/rotation", detail_rotation=lambda v: np.linspace(0.17, 0.171, v.size)),
    24: changed("fig4/motion", t=lambda v: 0.9 * v),
    25: changed("fig4/periodic", trace=lambda v: v + 0.01),
    26: changed("flux/flux", sine=first_to(1e-12)),
    27: changed("flux/flux", area=first_to(1e-4)),
    28: changed("last_curve/last_curve", residue=np.ones_like),
    29: attributes("fig6/manifolds", point_x=0.2121),
    31: changed("flux/flux", target=lambda v: np.array([0, 1])),
    32: changed("clusters/clusters", flights=no_valley),
    33: changed("clusters/clusters", dependence_low=np.zeros_like),
    34: changed("spread/spread", entered_least=lambda v: v // 2),
    35: changed("spread/spread", regular_exponent=lambda v: v + 0.2),
    36: changed("spread/spread", exponent=shifted_orbit),
    37: broken("exponents"),
    38: broken("jacobian"),
    39: shortened("fig7/lyapunov", orbit=slice(0, 2)),
    40: changed("spread/spread", exponent=lambda v: 1.2 * v),
    41: changed("spread/spread", exponent=np.abs),
    42: changed("atlas/line", regular_low=np.zeros_like),
    43: changed("atlas/line", **CONSTANT),
    44: changed("atlas/line", **CONSTANT),
    45: changed("rotation/rotation", exponent=np.zeros_like),
    46: changed("atlas/plane", regular=np.ones_like),
    47: broken("one_form"),
    48: broken("area"),
    49: changed("rotation/rotation", **ONE_WAY),
    50: broken("area"),
    53: changed("jumps/jumps", length=np.zeros_like),
    54: broken("softness"),
    55: changed("flux/flux", sea_inside=first_to(0.1)),
    56: changed("rotation/rotation", rotation=lambda v: v + 1e-3 * np.sin(np.arange(v.shape[1]))),
}  # fmt: skip


def test_every_check_of_data_has_a_wrong_dataset():
    assert set(WRONG) == {number for number, claim in claims.CLAIMS.items() if claim.data}


@pytest.mark.parametrize("number", WRONG)
def test_a_wrong_dataset_changes_the_verdict(datasets, number):
    claim = claims.CLAIMS[number]
    proofs = dict.fromkeys(claims.theorems(), PROVED)
    right = claim.judge(datasets, proofs)
    wrong = claim.judge(datasets | WRONG[number](datasets), proofs)
    assert wrong.verdict != right.verdict, (right, wrong)


@pytest.mark.parametrize("number", [n for n, claim in claims.CLAIMS.items() if claim.theorems])
def test_a_proof_changes_what_is_said(datasets, number):
    claim = claims.CLAIMS[number]
    without = claim.judge(datasets, dict.fromkeys(claim.theorems, "not proved"))
    proved = claim.judge(datasets, dict.fromkeys(claim.theorems, PROVED))
    assert without != proved
    assert without.verdict != PROVED


def test_a_dataset_that_is_missing_is_named(datasets):
    with pytest.raises(ValueError, match="claim 40 needs spread/spread"):
        claims.CLAIMS[40].judge({}, {})


def test_a_check_may_ask_only_for_theorems_that_it_names(datasets):
    theorems = ("twist-zero",)
    claim = ledger.Claim(1, "", "", False, "E", (), theorems, lambda proved: proved("twist-six"))
    with pytest.raises(KeyError, match="does not name the theorem twist-six"):
        claim.judge({}, {"twist-six": PROVED})


# -- the page -------------------------------------------------------------------------------------


def test_page_has_a_row_for_each_claim_the_corrections_first(verdicts):
    text = render(verdicts)
    rows = re.findall(r"^\| (\d+) \|", text, flags=re.M)
    assert sorted(map(int, rows)) == list(range(1, 59))
    titles = re.findall(r"^## (.*)$", text, flags=re.M)
    assert titles[:2] == ["Does not hold", "Holds with a correction"]
    assert text == render(dict(reversed(verdicts.items())))
    assert all(line.count(" | ") == 5 for line in text.splitlines() if line.startswith("| "))


def test_page_wants_all_verdicts(verdicts):
    with pytest.raises(ValueError, match="no verdict on 7"):
        render({number: verdict for number, verdict in verdicts.items() if number != 7})


def test_a_claim_is_well_formed():
    with pytest.raises(ValueError, match="claim 1 has no words"):
        ledger.claim(1, "here", "E")(lambda: None)
    with pytest.raises(ValueError, match="kind 'X' is not allowed"):
        ledger.claim(1, "here", "X")


@pytest.mark.parametrize("word", ["true", "not computed", "not computed: ", ""])
def test_a_verdict_is_one_of_a_few_words(word):
    with pytest.raises(ValueError, match="is not allowed"):
        ledger.Verdict(word, "", "", "")
