"""Scenes of families: bounds, and which datasets variants share."""

import pytest
import yaml
from examples import PAPER, assert_bounded

from pipeline import config
from pipeline.config import paths
from pipeline.config.reference import example


@pytest.mark.parametrize(
    ("beyond", "line"),
    [
        ({"step": 0.03}, "step: 0.03 ... two multiples or more in the span"),
        ({"span": [-0.004, 0.01]}, "span[0]: -0.004 ... above -g^2/(2k)"),
        ({"parameter": "k", "span": [0, 0.3]}, "span: [0, 0.3] ... 0 < k <= 1"),
        ({"step": 1e-6}, "step: 1e-06 ... 2000 values in the span"),
        ({"drawn": 7}, "drawn: 7 ... at most period = 6"),
    ],
)
def test_beyond_its_bound(beyond, line):
    assert_bounded("families", "families", {"ball": PAPER}, beyond, line)


def test_a_dataset_is_shared_only_with_its_inputs():
    """Shares of stable motion follow the families, whose levels are not among their own fields."""
    scenes = {"map": yaml.safe_load(example("families"))}
    finer = {"scenes": {"map": {"levels": 40}}}
    document = {"ball": PAPER, "scenes": scenes, "variants": {"finer": finer}}
    artifact_paths = paths.artifact_paths(config.check(document).variants)
    for stage in ("families", "shares"):
        assert artifact_paths["finer", "map", stage] == f"results/finer/{stage}_map.nc"
