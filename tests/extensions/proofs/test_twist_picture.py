"""The picture of the twist coefficient."""

import numpy as np
import pytest
import xarray as xr
from keys import SCENE, texts
from legible import assert_text_is_whole_and_apart

from extensions.proofs.figures.twist import draw


def picture(energies, twist, **scene):
    """Draw twists that vanish nowhere."""
    data = xr.Dataset({"energy": ("e", energies), "twist": ("e", twist), "zero": np.nan})
    return draw(SCENE | scene, data)


def test_no_mark_of_a_twist_lies_outside_its_frame():
    energies = np.array([0.001, 0.002, 0.004, 0.006])
    axes = {"energy": {"limits": [0.003, 0.006], "ticks": [0.004]}}
    figure = picture(energies, 1e3 * energies, marks=[0.001, 0.004], axes=axes)
    assert [text for text in texts(figure) if "$E$ =" in text] == ["$E$ = 0.004"]


@pytest.mark.parametrize("last", [0.004, 0.0005])
def test_text_of_a_twist_is_apart_and_off_its_line(last):
    shares = np.array([0.1, 0.2, 0.4, 0.6, 0.8, 0.999])
    figure = picture(shares * last, 60.0 - 50.0 * shares, marks=[0.999 * last])
    assert_text_is_whole_and_apart(figure)
    (mark,) = (text for text in figure.texts if "$E$ =" in text.get_text())
    (dot,) = (line for line in figure.artists if line.get_marker() == "o")
    assert mark.get_position()[1] < dot.get_ydata()[0]
