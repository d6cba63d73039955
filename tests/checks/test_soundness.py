"""Supplied datasets whose numbers are not those of the map are refused."""

import json
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr
from claim_data import made
from project import SHIPPED
from slowly import slowly

from pipeline import config
from pipeline.checks import claims
from pipeline.checks.claims import soundness
from pipeline.checks.claims.schema import CORRECTED, HOLDS, UNDECIDED
from pipeline.cli.commands import claims as claim_verdicts
from pipeline.records import artifacts
from pseudorigid import Ball, symmetric_orbits
from pseudorigid.dynamics import motion
from pseudorigid.dynamics.ensemble import ImpactMap
from pseudorigid.proofs import THEOREMS

BALL, ENERGY = Ball(0.2, 0.04), 0.01

SOUND = {
    name.rpartition("/")[2]: name
    for name in ("derivations", "fig2/orbits", "fig4/periodic", "fig4/motion", "fig6/manifolds",
                 "fig7/lyapunov", "spread/spread", "clusters/clusters", "rotation/rotation",
                 "jumps/jumps", "flux/flux", "last_curve/last_curve", "control/control",
                 "atlas/line", "atlas/plane")
}  # fmt: skip


DEAR = ("derivations", "flux")  # making one of them again takes four seconds
STAGES = [*(stage for stage in SOUND if stage not in DEAR), *slowly(*DEAR)]


def with_all(dataset, change):
    """Change all numbers of a dataset but those of its axes."""
    numbers = {n: v for n, v in dataset.data_vars.items() if v.dtype.kind == "f"}
    return dataset.assign({n: v.copy(data=change(v.values.copy())) for n, v in numbers.items()})


def test_every_stage_of_the_claims_is_tested_here():
    assert {name.rpartition("/")[2] for name in claims.required_datasets()} == set(SOUND)
    assert set(soundness.CHECKS) < set(SOUND)


@pytest.mark.parametrize("stage", STAGES)
def test_our_own_datasets_are_sound(datasets, stage):
    assert soundness.dataset_error(stage, datasets[SOUND[stage]]) is None


@pytest.mark.parametrize("stage", STAGES)
@pytest.mark.parametrize(
    "change",
    [
        lambda v: 1.02 * v,
        lambda v: 0.95 * v,
        lambda v: v * (1.0 + 0.03 * np.sin(np.arange(v.size)).reshape(v.shape)),
    ],
    ids=["more", "less", "noise"],
)
def test_numbers_a_little_off_are_refused(datasets, stage, change):
    assert soundness.dataset_error(stage, with_all(datasets[SOUND[stage]], change))


@pytest.mark.parametrize("name", ["k", "g", "energy"])
@pytest.mark.parametrize("stage", ["orbits", "periodic", "manifolds", "lyapunov", "spread"])
def test_another_ball_or_energy_is_refused(datasets, stage, name):
    dataset = datasets[SOUND[stage]]
    other = dataset.assign_attrs({name: 1.1 * dataset.attrs[name]})
    assert soundness.dataset_error(stage, other)


# Stages that are recomputed compare every variable by one loop, sweeps every share by another.
@pytest.mark.parametrize(
    ("stage", "name"),
    [("periodic", "tau"), ("control", "a"), ("line", "exponent"), ("line", "regular_lenient")],
)
def test_one_variable_a_tenth_less_is_named(datasets, stage, name):
    dataset = datasets[SOUND[stage]]
    words = soundness.dataset_error(stage, dataset.assign({name: 0.9 * dataset[name]}))
    assert name in words or name.removeprefix("regular_") in words


def test_two_impacts_in_another_order_are_refused(datasets):
    orbits = datasets[SOUND["orbits"]]
    order = np.arange(orbits["x"].size)
    order[[1, 2]] = 2, 1
    names = "x", "xdot", "udot"
    states = {name: orbits[name].copy(data=orbits[name].values[order]) for name in names}
    words = soundness.dataset_error("orbits", orbits.assign(states))
    assert words == "its states do not follow one another under the map"


@pytest.mark.slow
def test_an_inverted_verdict_of_the_derivations_is_refused(datasets):
    dataset = datasets["derivations"]
    inverted = dataset.assign({"printed": 1 - dataset["printed"]})
    assert soundness.dataset_error("derivations", inverted) == "its printed[0] is 0, made again 1"


def test_a_dataset_by_another_method_is_recomputed_by_it(datasets):
    dataset = datasets["as_published/fig7/lyapunov"]
    assert soundness.dataset_error("lyapunov", dataset) is None
    other = dataset.assign_attrs(impacts_missed=0)
    assert "impacts_missed" in soundness.dataset_error("lyapunov", other)
    config = json.loads(dataset.attrs["config"])
    del config["method"]
    assert soundness.dataset_error("lyapunov", dataset.assign_attrs(config=json.dumps(config)))


def test_a_stage_that_does_not_take_a_method_is_recomputed_without_it():
    scan = {"scan": 0.1, "tolerance": 1e-12}
    ball = Ball(0.2, 0.04, map=ImpactMap((0.1, 1e-12)))
    fixed_point = symmetric_orbits(BALL, ENERGY, 1)
    fields = {"period": 1, "type": "elliptic", "duration": 16}
    dataset = made(motion.scene_motion, fixed_point, ball=ball, method=scan, **fields)
    dataset = dataset.assign_attrs(impacts=ball.map.impacts, impacts_missed=ball.map.missed)
    assert soundness.dataset_error("motion", dataset) is None


def test_surplus_attributes_and_variables_are_refused(datasets):
    exact = datasets["fig7/lyapunov"].assign_attrs(impacts=600_000, impacts_missed=0)
    words = "it has impacts, impacts_missed, which its stage does not make"
    assert soundness.dataset_error("lyapunov", exact) == words
    motion = datasets["fig3/motion"]
    surplus = motion.assign(other=motion["t"])
    assert soundness.dataset_error("motion", surplus).startswith("it has other, ")


@pytest.mark.parametrize("wrong", [np.nan, 5.0])
def test_a_share_outside_its_interval_is_refused(datasets, wrong):
    share = datasets["atlas/plane"]["regular"]
    cell = (share["k"] == share["k"][1]) & (share["energy"] == share["energy"][0])
    plane = datasets["atlas/plane"].assign(regular=share.where(~cell, wrong))
    assert soundness.dataset_error("plane", plane).startswith("a share is not between ")


def test_a_number_without_dimensions_is_compared(monkeypatch):
    ours, given = (xr.Dataset({"zero": value}, attrs={"config": "{}"}) for value in (1.0, 2.0))
    monkeypatch.setattr(soundness, "recomputed", lambda *_: ours)
    given = given.assign_attrs(k=0.2, g=0.04, energy=ENERGY)
    assert soundness.dataset_error("twist", given) == "its zero[] is 2.0, made again 1.0"


@pytest.mark.parametrize("text", ["[]", "null", '"x"', "{"])
def test_a_dataset_of_another_form_is_refused(datasets, text):
    dataset = datasets["fig3/motion"].assign_attrs(config=text)
    for stage in ("motion", "spread"):
        assert soundness.dataset_error(stage, dataset).startswith("it cannot be read as one (")


@pytest.mark.parametrize(
    ("number", "name", "change", "words"),
    [
        (40, "spread/spread", lambda spread: spread, f"{CORRECTED}; they converge to 0.23"),
        (40, "spread/spread", lambda spread: with_all(spread, lambda v: 0.9 * v), " is no spread"),
        *slowly(
            (1, "derivations", lambda spread: spread, " is no derivations of its ball and energy")
        ),
        (34, "spread/spread", lambda spread: spread.drop_vars("entered_any"), " cannot be read as"),
    ],
)
def test_a_sound_file_is_judged_and_another_is_not(datasets, tmp_path, number, name, change, words):
    file = tmp_path / "given.nc"
    dataset = change(datasets["spread/spread"])
    artifacts.save(dataset, file, {}, stage=name.rpartition("/")[2])
    line = claim_verdicts.check(config.load(SHIPPED), number, name, file)
    assert line.startswith(f"{number}  {'' if CORRECTED in words else UNDECIDED}") and words in line


def test_the_file_of_a_sweep_is_judged_with_the_gravity_of_its_block(
    datasets, tmp_path, monkeypatch
):
    # The theorems of this claim take half a minute; tests/proofs proves them.
    proved = {
        name: SimpleNamespace(
            bounds=theorem.bounds, check=lambda: SimpleNamespace(verdict="proved")
        )
        for name, theorem in THEOREMS.items()
    }
    monkeypatch.setattr("pseudorigid.proofs.THEOREMS", proved)
    line, file = datasets["atlas/line"], tmp_path / "line.nc"
    artifacts.save(line.drop_attrs(deep=False), file, json.loads(line.attrs["config"]))
    checked = config.load(SHIPPED)
    checked["sweeps"]["line"] = {}
    assert claim_verdicts.check(checked, 43, "", file).startswith("43  ")
    checked["sweeps"]["line"] = {"g": 0.04}
    words = claim_verdicts.check(checked, 43, "", file)
    assert words.startswith(f"43  {HOLDS}; regular share of the section from ")
