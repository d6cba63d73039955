"""Figure 1 shows the states of a motion in proportion."""

import numpy as np
import pytest

from extensions.publication.figures import model
from helpers.examples import PAPER, checked, computed
from helpers.legible import assert_legible
from pseudorigid.figures.canvas import style


@pytest.mark.parametrize("fields", [
    {"ball": PAPER, "energy": 0.025, "period": 4, "duration": 9.77},  # as committed
    {"ball": PAPER, "energy": 0.055, "period": 1, "duration": 2.0},  # fast and high
    {"ball": PAPER, "energy": 1e-8, "period": 1, "duration": 1.0},  # hardly moves
    {},  # the example
])  # fmt: skip
def test_each_ball_is_stretched_and_placed_as_its_state_says(fields):
    block = checked("model", **fields)
    motion = computed(block)["motion"]
    figure = model.draw(block, motion)
    assert_legible(figure)
    balls = [line for line in figure.artists if line.get_linewidth() == 1.2]
    assert len(balls) == 3 and all(line.get_color() == style.BLACK for line in balls)
    reference, between, impact = (np.array(line.get_data()) * style.DPI for line in balls)
    radius, floor = np.ptp(reference[0]) / 2, reference[1].min()
    for outline, i in ((between, -1), (impact, 0)):
        x, u = (float(motion[name][i]) for name in ("position", "strain"))
        assert np.ptp(outline[0]) == pytest.approx(2 * radius, abs=0.1)
        assert np.ptp(outline[1]) == pytest.approx(2 * radius * (1 + u), abs=0.1)
        assert outline[1].min() - floor == pytest.approx(-radius * (x + u), abs=0.1)
    assert impact[1].min() == pytest.approx(floor, abs=0.1)
