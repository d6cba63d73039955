"""The datasets of the study describe themselves, and docs/data.md describes them."""

from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from helpers.described import assert_describes_itself, stages_of
from helpers.project import shipped
from pipeline.records import artifacts
from pseudorigid import Ball, symmetric_orbits
from study import figure_errors, stages
from study.methods.counted_methods import METHODS

BALL = Ball(0.2, 0.04)
SCENE = shipped()["scenes"]["fig3"] | {"ball": {"k": 0.2, "g": 0.04}, "energy": 0.01}


def needs():
    """The dataset of the errors of one figure."""
    one = symmetric_orbits(BALL, 0.01, 1)
    kinds, inputs = {"fig3": "motion"}, ["periodic/fig3"]
    return figure_errors.figure_errors(one, scenes={"fig3": SCENE}, measures=kinds, inputs=inputs)


STUDY = {
    "work": lambda: xr.merge(
        [
            stages.with_recorded(
                stages.accuracy(METHODS[:1], 2).assign(stages.missed(METHODS[:1], [0])), "work"
            ),
            stages.counts(METHODS[:1], 20),
            stages.recorded("times"),
        ],
        combine_attrs="override",
    ),
    "edges": lambda: stages.with_recorded(stages.failures(stages.EDGE_METHODS[:1], 2), "edges"),
    "misses": lambda: stages.misses(1000),
    "drift": lambda: stages.drift(1000),
    "needs": needs,
}


@pytest.mark.parametrize("name", STUDY)
def test_a_dataset_of_the_study_describes_itself(name, tmp_path):
    artifacts.save(STUDY[name](), tmp_path / "data.nc", {})
    assert assert_describes_itself(tmp_path / "data.nc") == "study"


def test_each_stage_is_made_here():
    assert stages_of("study.") == set(STUDY)


def test_a_root_is_wrong_if_it_is_off_by_a_tenth_of_a_flight_or_of_a_unit_of_time():
    truth = np.array([0.5, 0.5, 4.0, 4.0, 4.0])
    off = np.array([0.049, -0.051, 0.09, 0.11, np.nan])
    assert stages.is_wrong(truth + off, truth).tolist() == [False, True, False, True, True]


def test_the_accuracy_of_a_method_is_that_of_its_roots():
    truth = np.array([1.0, 2.0, 4.0, 4.0])
    tau = np.array([1.0 + 1e-8, 2.0, 4.5, np.nan])
    method = SimpleNamespace(solve=lambda ball, *columns: (tau, np.array([1.0, 2.0, 3.0, 4.0])))
    found = stages._accuracy(method, np.zeros((3, 4)), truth)
    median, worst, wrong, above, far_above, count = found
    assert median == pytest.approx(0.5 * (1e-8 + 0.125)) and worst == pytest.approx(1e-8)
    assert (wrong, above, far_above, count) == (0.5, 0.5, 0.75, 2.5)


def test_the_drift_is_the_largest_error_of_the_energy_so_far():
    state = BALL.start(0.3, 0.01)
    x, v, w = np.array([BALL.start(0.3, energy) for energy in (0.0101, 0.0097, 0.01)]).T
    drift = stages.energy_drift(BALL, state, np.array([x, v, w, x]))
    assert drift == pytest.approx([0.01, 0.03, 0.03], rel=1e-12)


def test_orbits_are_apart_after_the_median_of_their_starts():
    a, b = np.zeros((3, 6)), np.zeros((3, 6))
    b[0, 2:], b[1, 4:] = -1.0, 1.0
    assert stages._impacts_until_apart(a, b) == 4.0
    b[1], b[2, 3] = 0.0, 2.0 * stages.SEPARATION
    assert stages._impacts_until_apart(a, b) == 3.0
