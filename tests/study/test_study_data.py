"""The datasets of the study describe themselves, and docs/data.md describes them."""

import pytest
from described import assert_describes_itself, stages_of

from pipeline.records import artifacts
from pseudorigid import Ball, symmetric_orbits
from study import figure_errors, measured, stages
from study.methods.counted_methods import METHODS

BALL = Ball(0.2, 0.04)
SCENE = {
    "picture": "motion",
    "ball": {"k": 0.2, "g": 0.04},
    "energy": 0.01,
    "period": 1,
    "type": "elliptic",
    "duration": 1.0,
    "axes": {
        "t": {"limits": [0, 1], "ticks": [0, 1]},
        "displacement": {"limits": [-0.5, 0.5], "ticks": [0]},
    },
}


def needs():
    """The dataset of the errors of one figure."""
    one = symmetric_orbits(BALL, 0.01, 1)
    kinds, inputs = {"fig3": "motion"}, ["periodic/fig3"]
    return figure_errors.figure_errors(one, scenes={"fig3": SCENE}, measures=kinds, inputs=inputs)


STUDY = {
    "work": lambda: stages.with_recorded(
        stages.accuracy(METHODS[:1], 2).assign(stages.missed(METHODS[:1], [0])), "work"
    ),
    "edges": lambda: stages.with_recorded(stages.failures(stages.EDGE_METHODS[:1], 2), "edges"),
    "misses": lambda: stages.misses(1000),
    "drift": lambda: stages.drift(1000),
    "needs": needs,
    "work_all": lambda: measured.timed_work(METHODS[:1], 2, 1),
}


@pytest.mark.parametrize("name", STUDY)
def test_a_dataset_of_the_study_describes_itself(name, tmp_path):
    artifacts.save(STUDY[name](), tmp_path / "data.nc", {})
    assert assert_describes_itself(tmp_path / "data.nc") == "study"


def test_each_stage_is_made_here():
    assert stages_of("study.") == set(STUDY)
