"""Scenes of families and chains: bounds, which datasets variants share, and a run."""

import pytest

from helpers.documents import complaint, good
from helpers.examples import PAPER, assert_bounded
from pipeline import config

PLANE = {"k": [0.19, 0.21], "energy": [0.3, 2.0, 6.25], "starts": 12, "impacts": 200, "block": 2}
CHAINS = {"picture": "chains", "over": "a", "chains": [6]}


@pytest.mark.parametrize(("beyond", "line"), [
    ({"step": 0.03}, "step: 0.03 ... two multiples or more in the span"),
    ({"span": [-0.004, 0.01]}, "span[0]: -0.004 ... above -g^2/(2k)"),
    ({"parameter": "k", "span": [0, 0.3]}, "span: [0, 0.3] ... g < k <= 1"),
    ({"step": 1e-6}, "step: 1e-06 ... 2000 values in the span"),
    ({"drawn": 7}, "drawn: 7 ... at most period = 6"),
])  # fmt: skip
def test_beyond_its_bound(beyond, line):
    assert_bounded("families", "families", {"ball": PAPER}, beyond, line)


@pytest.mark.parametrize(("plane", "chains", "start", "allowed"), [
    ({}, {"chains": [5, 5]}, "chains: [5, 5]", "none of them twice"),
    ({}, {"over": "b"}, "over: 'b'", "a scene of kind atlas"),
    ({"k": [0.2]}, {}, "over: 'a'", "several k"),
    ({"energy": [-0.1, 1]}, {}, "over: 'a'", "above 0"),
])  # fmt: skip
def test_chains_that_cannot_be_are_refused_in_one_line(plane, chains, start, allowed):
    line = complaint(good() | {"sweeps": {"a": PLANE | plane, "over_it": CHAINS | chains}})
    assert line.startswith(f"sweeps.over_it.{start}") and allowed in line


def test_a_stage_of_a_scene_drawn_over_another_is_its_own():
    """The chains are those of the scene; the sweep is that of the scene over which it is drawn."""
    sweeps = {"a": PLANE, "over_it": CHAINS, "twin": CHAINS}
    paths = config.check(good() | {"sweeps": sweeps}).datasets
    found = [paths["atlas", scene, "chains"] for scene in ("over_it", "twin")]
    assert found == [f"results/atlas/chains_{scene}.nc" for scene in ("over_it", "twin")]
    assert paths["atlas", "over_it", "sweep"] == paths["atlas", "a", "sweep"]
