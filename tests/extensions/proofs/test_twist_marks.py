"""Marks of the twist outside the limits of an axis are neither drawn nor named."""

import numpy as np
import xarray as xr
from keys import SCENE, texts

from extensions.proofs.figures import twist


def test_no_mark_of_the_twist_lies_outside_its_axis():
    energies = np.array([0.001, 0.002, 0.004, 0.006])
    data = xr.Dataset({"energy": ("e", energies), "twist": ("e", 1e3 * energies), "zero": np.nan})
    axes = {"energy": {"limits": [0.003, 0.006], "ticks": [0.004]}}
    figure = twist.draw(SCENE | {"marks": [0.001, 0.004], "axes": axes}, data)
    assert [text for text in texts(figure) if "$E$ =" in text] == ["$E$ = 0.004"]
