"""The ledger of claims: each has a check, each check can fail, CLAIMS.md says what they found."""

import json
import os
import re
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from pipeline.checks import claims
from pipeline.checks.claims import ledger, soundness
from pipeline.checks.claims.ledger import CORRECTED, FALSE, HOLDS, NOT_COMPUTED, OPEN, PROVED
from pipeline.checks.claims.render import render
from pipeline.cli import ledger as cli_ledger
from pipeline.records import artifacts
from pseudorigid import Ball, symmetric_orbits
from pseudorigid.dynamics import lyapunov, manifolds, motion, orbits
from pseudorigid.dynamics.ensemble import ImpactMap
from pseudorigid.evidence.clusters import clusters
from pseudorigid.evidence.flux import flux
from pseudorigid.evidence.jumps import jumps
from pseudorigid.evidence.last_curve import last_curve
from pseudorigid.evidence.rotation import rotation
from pseudorigid.evidence.spread import spread
from pseudorigid.proofs.derivations import derivations
from pseudorigid.sweep.cell import VARIABLES, cells

BALL, HIGH, LOW = Ball(0.2, 0.04), 0.01, 0.001
SEA = (0.55, 0.68)
STARTS_2 = [-0.440981, -0.338085, -0.23519, -0.132294, -0.063608, 0.142183, 0.165702, 0.534522]
STARTS_8 = [-0.20706, 0.155183, 0.426642, 0.66769, 0.894427, 0.999522]
PAPER_TEXT = "PAPER_TEXT"  # the environment variable that names the paper's text


def atlas(ks, energies, starts, impacts):
    rows = [cells(k, energies, starts, impacts) for k in ks]
    data = {
        name: (
            ("k", "energy"),
            np.array([[cell[name] for cell in row] for row in rows]),
            {"long_name": words, "units": "1"},
        )
        for name, (words, _) in VARIABLES.items()
        if name != "chains"
    }
    config = json.dumps({"starts": starts, "impacts": impacts})
    axes = {"k": ks, "energy": energies}
    axes = {name: (name, axis, {"long_name": name, "units": "1"}) for name, axis in axes.items()}
    return xr.Dataset(data, coords=axes, attrs={"g": 0.04, "config": config})


def made(stage, *inputs, ball=BALL, energy=HIGH, method=None, **fields):
    """A stage's dataset, with the attributes that its file would have."""
    config = fields if method is None else fields | {"method": method}
    about = {"k": ball.k, "g": ball.g, "energy": energy, "config": json.dumps(config)}
    found = stage(ball, energy, *inputs, **fields)
    return found.assign_attrs(about | found.attrs)


@pytest.fixture(scope="module")
def datasets():
    """All datasets that the checks need, smaller than the shipped ones."""
    one, six = (made(symmetric_orbits, period=period) for period in (1, 6))
    scan = ImpactMap((0.1, 1e-12))
    draw = {"starts": [0.6, 0.62, 0.65], "impacts": 200_000}
    published = made(
        lyapunov.scene_exponents, ball=Ball(0.2, 0.04, map=scan), records=10,
        method={"scan": 0.1, "tolerance": 1e-12}, **draw,
    )  # fmt: skip
    line = [0.3125, 0.625, 3.0, 6.25, 10.3125, 13.0, 16.5625, 18.75]
    return {
        "derivations": made(derivations),
        "fig2/orbits": made(
            orbits.scene_orbits, starts=STARTS_2,
            impacts=[1500, 2500, 3000, 3500, 4000, 3000, 2500, 25000],
        ),
        "fig3/periodic": one,
        "fig3/motion": made(motion.scene_motion, one, period=1, type="elliptic", duration=16),
        "fig4/periodic": six,
        "fig4/motion": made(motion.scene_motion, six, period=6, type="elliptic", duration=60),
        "fig6/manifolds": made(
            manifolds.scene_manifolds, six, period=6, type="hyperbolic",
            resolution={"distance": 0.1, "bend": 20}, point=0, length=0.1,
            window={"x": [-0.002862691, 0.001413489], "xdot": [-0.00109292, 0.000777909]},
        ),
        "fig7/lyapunov": made(lyapunov.scene_exponents, records=4, **draw),
        "fig8/orbits": made(
            orbits.scene_orbits, energy=LOW, starts=STARTS_8,
            impacts=[2000, 3500, 4500, 5000, 15000, 5000],
        ),
        "as_published/fig7/lyapunov": published.assign_attrs(
            impacts=scan.impacts, impacts_missed=scan.missed
        ),
        "atlas/line": atlas([0.2], line, 300, 3000),
        "atlas/plane": atlas([0.1, 0.2, 0.3], [1.0, 4.0, 10.0], 60, 1500),
        "clusters/clusters": made(
            clusters, between=SEA, orbits=96, impacts=3000, cuts=[4, 6], lags=2, resamples=40,
            seed=1,
        ),
        "jumps/jumps": made(jumps, energies=[0.0018], sides=200),
        "rotation/rotation": made(
            rotation, energies=[0.026], starts=200, impacts=6000, detail=(-0.8344, -0.8341),
            detail_impacts=50_000,
        ),
        "spread/spread": made(
            spread, between=SEA, orbits=32, length=200_000, blocks=20,
            regular=[-0.44, 0.142183], regular_impacts=1 << 14, cells=20, visits=1 << 14,
        ),
        "flux/flux": made(
            flux, period=6, distance=2e-3, grid=200, between=SEA, orbits=16, impacts=2000
        ),
        "last_curve/last_curve": made(
            last_curve, nobles=[[0, 5, 1, 15], [0, 5, 1, 17]], convergents=6,
            between=(-0.2, -0.0325639), impacts=4000, drawn=10,
        ),
    }  # fmt: skip


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


# -- a dataset that is handed in is one of its map -------------------------------------------------

SOUND = {
    name.rpartition("/")[2]: name
    for name in ("derivations", "fig2/orbits", "fig4/periodic", "fig4/motion", "fig6/manifolds",
                 "fig7/lyapunov", "spread/spread", "clusters/clusters", "rotation/rotation",
                 "jumps/jumps", "flux/flux", "last_curve/last_curve", "atlas/line", "atlas/plane")
}  # fmt: skip


def with_all(dataset, change):
    """The dataset with all its numbers, but those of its axes, changed a little."""
    found = {name: dataset[name] for name in dataset.data_vars if dataset[name].dtype.kind == "f"}
    return dataset.assign({n: v.copy(data=change(v.values.copy())) for n, v in found.items()})


def test_every_stage_that_claims_rest_on_has_its_check():
    assert {name.rpartition("/")[2] for name in claims.needed()} == set(SOUND)
    assert set(soundness.CHECKS) < set(SOUND)


@pytest.mark.parametrize("stage", SOUND)
def test_our_own_datasets_are_of_their_map(datasets, stage):
    assert soundness.fault(stage, datasets[SOUND[stage]]) is None


@pytest.mark.parametrize("stage", SOUND)
@pytest.mark.parametrize(
    "change",
    [
        lambda v: 1.02 * v,
        lambda v: 0.95 * v,
        lambda v: v * (1.0 + 0.03 * np.sin(np.arange(v.size)).reshape(v.shape)),
    ],
    ids=["more", "less", "noise"],
)
def test_numbers_a_little_off_are_not_of_the_map(datasets, stage, change):
    assert soundness.fault(stage, with_all(datasets[SOUND[stage]], change))


@pytest.mark.parametrize("stage", ["orbits", "periodic", "manifolds", "lyapunov", "spread"])
def test_another_ball_or_energy_is_noticed(datasets, stage):
    dataset = datasets[SOUND[stage]]
    for name in ("k", "g", "energy"):
        assert soundness.fault(stage, dataset.assign_attrs({name: 1.1 * dataset.attrs[name]}))


TENTH_LESS = {
    "derivations": ("value",),
    "clusters": ("correlation", "strain_energy", "period_error"),
    "flux": ("sea_out", "carried_out", "carried_in", "area", "lobe_polygon", "branch_x"),
    "jumps": ("length_error", "flight_x"),
    "last_curve": ("place", "orbit_exponent"),
    "line": ("exponent", "regular_low", "regular_high", "regular_lenient", "chain_share"),
    "lyapunov": ("exponent",),
    "motion": ("strain",),
    "periodic": ("multiplier", "rotation_number", "tau"),
    "plane": ("exponent", "exponent_error", "regular_low", "followed"),
    "rotation": ("fixed_rotation", "detail_exponent"),
}


@pytest.mark.parametrize(("stage", "name"), [(s, n) for s in TENTH_LESS for n in TENTH_LESS[s]])
def test_one_variable_a_tenth_less_is_noticed_by_name(datasets, stage, name):
    dataset = datasets[SOUND[stage]]
    words = soundness.fault(stage, dataset.assign({name: 0.9 * dataset[name]}))
    assert name in words or name.removeprefix("regular_") in words


def test_a_verdict_of_the_derivations_that_is_turned_round_is_noticed(datasets):
    dataset = datasets["derivations"]
    turned = dataset.assign({"printed": 1 - dataset["printed"]})
    assert soundness.fault("derivations", turned) == "its printed[0] is 0, made again 1"


def test_numbers_by_another_method_are_made_again_by_it(datasets):
    dataset = datasets["as_published/fig7/lyapunov"]
    assert soundness.fault("lyapunov", dataset) is None
    other = dataset.assign_attrs(impacts_missed=0)
    assert soundness.fault("lyapunov", other).startswith("its impacts_missed is 0, made again ")
    config = json.loads(dataset.attrs["config"])
    del config["method"]
    assert soundness.fault("lyapunov", dataset.assign_attrs(config=json.dumps(config)))


def test_a_dataset_of_another_stage_is_refused_in_words(datasets):
    assert "cannot be read" in soundness.fault("spread", datasets["fig2/orbits"])


def test_a_file_is_judged_and_one_of_another_map_is_not(datasets, tmp_path):
    def said(number, name, dataset):
        file = tmp_path / "given.nc"
        artifacts.save(dataset, file, {}, stage=name.rpartition("/")[2])
        return cli_ledger.check(None, number, f"{name}={file}"), str(file)

    spread = datasets["spread/spread"]
    assert said(40, "spread/spread", spread)[0].startswith(f"40  {CORRECTED}; 0.23")
    line, file = said(40, "spread/spread", with_all(spread, lambda v: 0.9 * v))
    assert line.startswith(f"40  {NOT_COMPUTED}: {file} is no spread/spread of its ball and energy")
    line, file = said(1, "derivations", spread)
    assert line.startswith(f"1  {NOT_COMPUTED}: {file} is no derivations of its ball and energy: ")
    line, file = said(34, "spread/spread", spread.drop_vars("entered_any"))
    assert line.startswith(f"34  {NOT_COMPUTED}: {file} cannot be read as spread/spread: ")


def test_the_file_of_a_sweep_is_judged_with_the_gravity_of_its_block(datasets, tmp_path):
    line, file = datasets["atlas/line"], tmp_path / "line.nc"
    artifacts.save(line.drop_attrs(deep=False), file, json.loads(line.attrs["config"]))
    words = cli_ledger.check({"sweeps": {"line": {"g": 0.04}}}, 43, str(file))
    assert words.startswith(f"43  {HOLDS}; regular share of the section from ")


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
