"""Keys of families follow the data."""

import numpy as np
import pytest

from extensions.families.dataset import families
from extensions.families.figures.families import draw
from extensions.families.shares import shares
from helpers.keys import SCENE, texts
from helpers.sections import BALL
from pseudorigid.figures.canvas import style


@pytest.fixture(scope="module")
def calm():
    """Families of the least period, without any event."""
    scene = SCENE | {"energy": 0.001, "parameter": "energy", "span": [-0.0039, 0.0035], "drawn": 1}
    held = families(BALL, 0.001, "energy", scene["span"], 1, 2)
    return scene, held, shares(BALL, 0.001, held, "energy", scene["span"], 0.001, 20, 300)


def test_families_without_an_event_are_drawn_with_their_rim_and_a_key_of_what_there_is(calm):
    scene, held, regular = calm
    assert held.sizes["event"] == 0 and held["event_family"].dtype == np.int64
    figure = draw(scene, held, regular)
    assert not {"hyperbolic", "fold", "an impact grazes"} & set(texts(figure))
    assert {"elliptic", "rim of the section"} <= set(texts(figure))
    grey = [line for line in figure.artists if line.get_color() == style.SEA]
    rims = [line for line in grey if len(line.get_xdata()) > 2]
    assert len(rims) == 2
    low, high = 340 / style.DPI, 1345 / style.DPI
    assert all(low < y < high for line in rims for y in line.get_ydata())
