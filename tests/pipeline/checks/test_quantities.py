"""The quantities that pictures report are measured in their datasets."""

import pytest

from paper.numbers import PAPER_NUMBERS
from pipeline import config
from pipeline.checks import quantities
from pipeline.config.schema.kinds import KINDS
from pipeline.records.artifacts import load


@pytest.fixture(scope="module")
def scenes(finished):
    """Scene -> its block and its datasets."""
    checked = config.load(finished.config)
    files = {scene: checked.data_of("paper", scene).items() for scene in checked.scenes}
    return {
        scene: (block.as_mapping(), {s: load(finished.path / f) for s, f in files[scene]})
        for scene, block in checked.scenes.items()
    }


def test_quantities_are_measured_in_the_data_and_not_read_from_the_config(scenes):
    for scene, (block, data) in scenes.items():
        kind = KINDS[block["picture"]]
        values = quantities.reported(block, data)
        assert kind.headline in values
        assert set(PAPER_NUMBERS[scene]) <= set(values)
        other = block | {"energy": 0.5, "impacts": 3, "starts": [0.1], "duration": 1.0}
        other |= {"window": {"x": [0, 1], "xdot": [0, 1]}, "length": 9, "period": 99}
        assert quantities.reported(other, data) == values


def test_other_data_give_other_numbers(scenes):
    def measured(scene, **changes):
        block, data = scenes[scene]
        other = data | {stage: change(data[stage]) for stage, change in changes.items()}
        return quantities.reported(block, other)

    shifted = measured("fig6", manifolds=lambda d: d.assign_attrs(point_x=0.3, window_x=[0.2, 0.4]))
    assert shifted["x of the point"] == "0.3000000" and shifted["window, x"] == "0.2 to 0.4"
    faster = measured("fig2", orbits=lambda d: d.assign(xdot=d["xdot"] * 1.1))
    assert faster["energy"] != measured("fig2")["energy"] == "0.01"
    larger = measured("fig7", lyapunov=lambda d: d.assign(exponent=d["exponent"] + 1.0))
    assert all(float(value) > 1.0 for value in larger["largest exponent"].split(", "))
