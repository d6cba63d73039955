"""The claims: each has a check, each check can fail, and CLAIMS.md has what they found."""

import json
import re
from functools import partial

import numpy as np
import pytest

from extensions.claims import ledger as claims
from extensions.claims.ledger import VERDICTS, chaos, schema
from extensions.claims.ledger.outcomes import CORRECTED, FALSE, HOLDS, PROVED, UNCHECKED, UNDECIDED
from extensions.proofs import THEOREMS
from extensions.proofs.kinds import theorems
from pipeline.config import ConfigError
from pipeline.records.sources import ROOT
from pseudorigid import Ball

ALL = range(1, 75)
PUBLISHED = "as_published/fig7/lyapunov"
CERTIFIED = sorted(name for name, scene in theorems().items() if "theorem" in scene)


ALGEBRA = {1, 5, 8, 9, 10, 12, 15, 18, 47, 48, 53, 57, 64, 68, 71}  # settled by computer algebra
PROVED_BY_THEOREMS = {21, 26, 29, 30, 52}
EXPECTED = {
    FALSE: {14, 33},
    CORRECTED: {3, 4, 6, 7, 11, 13, 17, 19, 22, 23, 34, 37, 40, 44, 50, 59, 67, 74},
    UNDECIDED: {30, 52, 62, 63, 70}, UNCHECKED: {51, 58}, PROVED: ALGEBRA,
}  # fmt: skip


@pytest.mark.parametrize("proofs", ["", PROVED])
def test_verdicts_without_and_with_all_proofs(datasets, proofs):
    expected = {n: word for word, numbers in EXPECTED.items() for n in numbers}
    if proofs:
        expected |= dict.fromkeys(PROVED_BY_THEOREMS, PROVED) | {63: CORRECTED, 70: HOLDS}
    verdicts = claims.judge_claims(datasets, dict.fromkeys(claims.required_theorems(), proofs))
    assert {v.number: v.verdict for v in verdicts} == dict.fromkeys(ALL, HOLDS) | expected


@pytest.mark.parametrize("number", [23, 28, 42, 43, 52])
def test_shares_inside_curves_are_said_only_of_proved_theorems(datasets, number):
    """The share is the bound of the theorem whose certificate was checked, and no other."""
    claim = claims.CLAIMS[number]
    sized = [name for name in claim.theorems if name.startswith("curve-")]
    others = dict.fromkeys(claim.theorems, PROVED)
    for name in sized:
        share = f"more than {float(THEOREMS[name].bounds['share'])}"
        only = others | dict.fromkeys(sized, "not proved")
        assert "more than 0." not in claim.judge(datasets, only).value
        assert share in claim.judge(datasets, only | {name: PROVED}).value


def test_every_theorem_is_cited_by_a_claim():
    assert claims.required_theorems() == CERTIFIED


@pytest.mark.parametrize("change", [
    {"defect": lambda v: v + 1e-6},  # no map has the reversor
    {"defect": lambda v: 0.0 * v},  # the maps without it have it too
    {"class_high": lambda v: v + 0.2},  # regular orbits may remain with neither
    {"class_low": np.zeros_like, "wander": np.zeros_like},  # the reversor may keep an area
])  # fmt: skip
@pytest.mark.parametrize("energy", ["control", "control_low"])
def test_the_control_separates_the_properties_at_both_energies(datasets, energy, change):
    claim = claims.CLAIMS[50]
    wrong = datasets | changed(f"{energy}/control", **change)(datasets)
    assert claim.judge(wrong, {}).verdict == UNDECIDED
    assert claim.judge(datasets, {}).verdict == CORRECTED


def test_the_twins_of_the_figures_have_strains_below_the_bounds(datasets):
    claim = claims.CLAIMS[74]
    numbers = claim.function(*(datasets[name] for name in claim.data)).numbers
    for figure, least in zip("28", numbers["least"][2:], strict=True):
        for name, most in ((f"g{figure}", 0.1), (f"g{figure}_tenth", 0.01)):
            assert f"{{{name}:.3g}}" in claim.value
            assert 0.99 * most < -least * float(f"{numbers[name]:.3g}") / 0.04 <= most


# -- a wrong dataset changes the verdict ----------------------------------------------------------


def broken(*names):
    """Let formulas of the derivations hold neither as printed nor corrected."""

    def change(datasets):
        dataset = datasets["derivations"].copy(deep=True)
        for name in names:
            row = dataset["formula"].values.tolist().index(name)
            dataset["printed"].values[row] = dataset["corrected"].values[row] = 0
        return {"derivations": dataset}

    return change


def changed(name, **values):
    """Replace variables of a dataset by functions of their values."""

    def change(datasets):
        dataset = datasets[name].copy(deep=True)
        for variable, make in values.items():
            dataset[variable] = dataset[variable].copy(data=make(dataset[variable].values.copy()))
        return {name: dataset}

    return change


HUNDREDTH = partial(np.multiply, 0.01)
STATE = dict.fromkeys(("x", "xdot", "udot"), HUNDREDTH)
SHRUNK = [(f"fig{n}/motion", {"strain": HUNDREDTH}) for n in (3, 4)]
SHRUNK += [(f"fig{n}/orbits", STATE) for n in (2, 8)]
WRONG = {number: broken(*claim.formulas) for number, claim in claims.CLAIMS.items()
         if claim.formulas} | {
    5: changed("fig2/orbits", tau=lambda v: 1.001 * v),
    14: changed("jumps/jumps", length=np.zeros_like),
    19: lambda of: {name: of[name].assign_attrs(impacts_missed=0) for name in [PUBLISHED]},
    21: changed("fig3/periodic", type=lambda v: np.full(v.shape, "hyperbolic")),
    22: lambda of: {name: of[name].isel(orbit=[0]) for name in ["fig4/periodic"]},
    23: changed("rotation/rotation", detail_rotation=lambda v: np.linspace(0.17, 0.171, v.size)),
    38: broken("jacobian"),
    45: changed("rotation/rotation", exponent=np.zeros_like),
    50: changed("control_low/control", class_low=np.zeros_like),
    60: changed("fig5/manifolds", **dict.fromkeys(STATE, lambda v: np.linspace(0, 1e-3, v.size))),
    63: changed("jumps/jumps", length=np.zeros_like),
    74: lambda datasets: {n: changed(n, **change)(datasets)[n] for n, change in SHRUNK},
}  # fmt: skip


@pytest.mark.parametrize("number", WRONG)
def test_a_wrong_dataset_changes_the_verdict(datasets, number):
    claim = claims.CLAIMS[number]
    proofs = dict.fromkeys(claims.required_theorems(), PROVED)
    right = claim.judge(datasets, proofs)
    wrong = claim.judge(datasets | WRONG[number](datasets), proofs)
    undecided = right.verdict == wrong.verdict == UNDECIDED  # for another reason
    assert wrong.value != right.value if undecided else wrong.verdict != right.verdict


@pytest.mark.parametrize("number", [n for n, c in claims.CLAIMS.items() if "derivations" in c.data])
def test_a_formula_that_holds_only_with_a_correction_proves_no_statement(datasets, number):
    algebra = datasets["derivations"].copy(deep=True)
    algebra["printed"].values[:], algebra["corrected"].values[:] = 0, 1
    proofs = dict.fromkeys(claims.required_theorems(), PROVED)
    verdict = claims.CLAIMS[number].judge(datasets | {"derivations": algebra}, proofs).verdict
    assert verdict not in (PROVED, HOLDS)


CITED = [(n, name) for n, claim in claims.CLAIMS.items() for name in claim.theorems]


@pytest.mark.parametrize(("number", "name"), CITED)
def test_each_proof_changes_the_rows_that_cite_it(datasets, number, name):
    claim = claims.CLAIMS[number]
    proofs = dict.fromkeys(claim.theorems, PROVED)
    assert claim.judge(datasets, proofs | {name: "not proved"}) != claim.judge(datasets, proofs)
    assert claim.judge(datasets, {}).verdict != PROVED


# -- CLAIMS.json and CLAIMS.md --------------------------------------------------------------------


def test_the_committed_page_is_rendered_from_the_committed_verdicts():
    text = (ROOT / "CLAIMS.json").read_text(encoding="utf-8")
    verdicts = claims.read_json(text)
    assert [verdict.number for verdict in verdicts] == list(ALL)
    assert claims.to_json(verdicts) == text
    page = (ROOT / "CLAIMS.md").read_text(encoding="utf-8")
    assert claims.render(verdicts) == claims.render(verdicts[::-1]) == page
    titles = re.findall(r"^## (.*)$", page, flags=re.M)
    assert titles == [word.capitalize() for word in VERDICTS]
    for verdict in verdicts:
        claim = claims.CLAIMS[verdict.number]
        assert (verdict.place, verdict.statement) == (claim.place, claim.statement)
        assert verdict.datasets == claim.data


CHECK = 'check = "model.homogeneous"\n'
# Text of claims.toml, another with a mistake, and how the message begins.
MISTAKES = [
    ('place = "2.1"\n', 'plase = "2.1"\n', "1.place: Field required"),
    ('"fig2/orbits"', '"fig2/orbit"', "4.data[1]: 'orbit' is not known: did you mean orbits?"),
    ('["uncoupled"]', '["couple"]', "1.formulas[0]: 'couple' is not known: did you mean uncou"),
    ('"twist-zero"', '"twist-zer"', "49.theorems[1]: 'twist-zer' is not known: did you mean tw"),
    (CHECK, 'check = "model.same"\n', "4.check: 'model.same' is not known: did you mean model."),
    (CHECK, f'{CHECK}theorems = ["twist-zero"]\n', "4.check: model.homogeneous does not take 3"),
    (CHECK, "", "4: expected one of check, formulas and verdict"),
    (CHECK, f'{CHECK}paraphrase = "x"\n', "4: expected either quote or paraphrase"),
    ('data = ["derivations"]', 'data = ["atlas/line"]', "1: formulas are in one dataset: expect"),
]


@pytest.mark.parametrize(("text", "other", "line"), MISTAKES)
def test_a_mistake_in_the_data_of_a_claim_is_one_line(text, other, line):
    assert text in claims.TEXT
    with pytest.raises(ConfigError) as error:
        schema.load(claims.TEXT.replace(text, other, 1), claims.CHECKS)
    assert error.value.lines[0].startswith(f"claims.toml: claims.{line}")


@pytest.mark.parametrize(("value", "wrong"), [
    ("{shel}", "no number 'shel'"),
    ("{shell:y}", "Unknown format"),
])  # fmt: skip
def test_a_sentence_that_its_check_cannot_fill_is_one_line(datasets, value, wrong):
    claim = claims.CLAIMS[3].model_copy(update={"value": value})
    with pytest.raises(ConfigError, match=f"^claims.toml: claims.3: {wrong}"):
        claim.judge(datasets, {})


# -- what single rows say -------------------------------------------------------------------------


def test_the_derivative_beside_the_jump_curve_is_that_of_differences(datasets):
    """Row 14: the numbers by differences of the map itself, on both sides."""
    jumps, ball = datasets["jumps/jumps"], Ball(0.2, 0.04)
    middle = jumps.sizes["point"] // 2
    x, y = jumps["x"].values[0], -jumps["y"].values[0]
    along = np.array([x[middle + 1] - x[middle - 1], y[middle + 1] - y[middle - 1]])
    across = np.array([along[1], -along[0]]) / np.hypot(*along)
    row, step = 1, 1e-7  # at a distance of 1e-3
    distance = jumps["distance"].values[row]
    norms = []
    for side in (-1.0, 1.0):
        point = np.array([x[middle], y[middle]]) + side * distance * across
        images = []
        for shift in step * np.array([[1, 0], [-1, 0], [0, 1], [0, -1]]):
            a, v, w, _ = ball.impact(*ball.state_xy(*(point + shift), 0.01))
            images.append([a, v - 0.2 * w])
        matrix = np.array([np.subtract(*images[:2]), np.subtract(*images[2:])]).T / (2 * step)
        norms.append(np.linalg.norm(matrix, 2))
    ours = [float(jumps[f"derivative_{side}"].values[row]) for side in ("missed", "touched")]
    assert sorted(norms) == pytest.approx(ours, rel=1e-4)
    touched = jumps["derivative_touched"].values
    assert touched[-1] / touched[-3] == pytest.approx(10.0, rel=0.02)  # like h^-1/2
    assert "like h^-0.50" in claims.CLAIMS[14].judge(datasets, {}).value


def test_x_and_y_are_told_apart_where_clusters_are_compared(datasets):
    """Row 33: each number is that of its own coordinate, and the widest interval is the error."""
    clusters = datasets["clusters/clusters"]
    verdict = claims.CLAIMS[33].judge(datasets, {})
    of_y, of_x = verdict.value.split(". It explains")
    for i, text in enumerate((of_x, of_y)):
        correlation = clusters["correlation"].values[:, 0, i, i]
        for numbers in (correlation, clusters["dependence"].values[:, 0, i]):
            assert ", ".join(f"{number:.3f}" for number in numbers) in text
    assert 0.005 < float(verdict.error.rpartition(" ")[2]) < 0.1


def test_rises_are_counted_by_the_share_and_its_intervals():
    share = np.array([9.0, 5.0, 4.0, 4.5, 8.0, 8.0, 7.9, 3.0, 3.5])
    assert chaos._rises(share, share - 0.4, share + 0.4) == [(2, 4)]
    assert chaos._rises(share, share - 3.0, share + 3.0) == []
    assert chaos._rises(share, share - 0.1, share + 0.1) == [(2, 4), (7, 8)]
    share = np.array([1.0, 5.0, 4.9, 6.0, 2.0])  # falls within the intervals end no rise
    assert chaos._rises(share, share - 0.2, share + 0.2) == [(0, 3)]


def test_the_atlas_page_has_the_numbers_of_the_rows_that_share_them():
    """Rows 42 to 44 of the committed CLAIMS.md and the page of the atlas round alike."""
    text = (ROOT / "CLAIMS.json").read_text(encoding="utf-8")
    rows = {row.number: row for row in claims.read_json(text)}
    page = (ROOT / "src/extensions/atlas/README.md").read_text(encoding="utf-8")
    rises = re.findall(r"(0\.\d+) at (0\.\d+)", rows[44].value)
    assert len(rises) == 6
    for share, energy in rises[:-1]:  # the last is where the line ends
        assert f"{energy} ({share})" in page
    for share, low, high, energy in re.findall(
        r"(0\.\d+) \((0\.\d+) to (0\.\d+)\) at E = (0\.\d+)", rows[43].value
    ):
        assert re.search(rf"\| {energy} \([^|]*\) \| {share} \| {low} - {high} \|", page)
    assert rows[42].error.replace(" to ", " - ") in page


def test_missed_impacts_are_judged_by_the_contact_speeds_of_the_same_orbits(datasets):
    """Row 19: condition (22) holds at every impact that the method finds, (21) between them not."""
    value = claims.CLAIMS[19].judge(datasets, {}).value
    least = float(re.search(r"at least (\S+)$", value)[1])
    assert 0.0 < least < 0.05
    lyapunov = datasets[PUBLISHED]
    method = json.loads(lyapunov.attrs["config"])["method"]
    assert f"steps of {method['scan']:g}" in value
