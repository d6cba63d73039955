"""Places on a panel: of labels, of notes beside points, and of what lies inside the frame."""

import numpy as np
import pytest

from pseudorigid.figures.axes.panel import Axis, Window, _apart, _beside
from pseudorigid.figures.canvas.sheet import POINT, Sheet

FRAME = (100.0, 50.0, 300.0, 150.0)


def test_labels_that_would_touch_are_thinned_out_evenly():
    marks, texts = np.array([0.0, 10.0, 21.0, 30.0, 40.0]), [*"abcde"]
    assert _apart(marks, 8.9, texts) == _apart(marks, 9.0, texts) == texts
    assert _apart(marks, 9.1, texts) == _apart(marks, 18.0, texts) == ["a", "", "c", "", "e"]
    assert _apart(marks, 18.1, texts) == ["a", "", "", "d", ""]
    assert _apart(marks[:1], 99.0, texts[:1]) == ["a"]


@pytest.mark.parametrize(("side", "other"), [("left", "right"), ("bottom", "top")])
def test_a_note_is_mirrored_if_it_fits_the_frame_only_so(side, other):
    """It is 20 long, 2 away from its point at 0, and a point away from the frame."""
    end = 22.0 + POINT
    for shift, own, mirrored in ((2.0, side, other), (-2.0, other, side)):
        narrow = [-end - 0.1, end + 0.1]
        assert _beside(0.0, shift, own, 20.0, *narrow) == (shift, own)
        narrow[shift > 0] *= 0.99
        assert _beside(0.0, shift, own, 20.0, *narrow) == (-shift, mirrored)
        assert _beside(0.0, shift, own, 20.0, 0.1 - end, end - 0.1) == (shift, own)  # on no side


def test_a_window_keeps_what_lies_within_both_of_its_axes():
    axes = Axis((0.0, 1.0), [0.0, 1.0]), Axis((2.0, 4.0), [2.0, 4.0])
    window = Window(Sheet(450, 225), FRAME, *axes)
    x = np.array([0.0, 0.5, 1.0, -0.1, 1.1, 0.5, 0.5, np.nan])
    y = np.array([2.0, 3.0, 4.0, 3.0, 3.0, 1.9, 4.1, 3.0])
    assert window.within(x, y).tolist() == [True] * 3 + [False] * 4 + [True]
    across, up = window.place(x[:5], y[:5])
    assert across == pytest.approx([100.0, 200.0, 300.0, 80.0, 320.0])
    assert up == pytest.approx([50.0, 100.0, 150.0, 100.0, 100.0])
