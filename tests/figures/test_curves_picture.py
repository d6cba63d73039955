"""The picture of proved invariant curves shows its data."""

import numpy as np
from small_curve import SMALL

from pseudorigid import Ball
from pseudorigid.dynamics.orbits import scene_orbits
from pseudorigid.figures.canvas.render import render
from pseudorigid.figures.kinds import curves
from pseudorigid.proofs.theorems import curve_scene

SCENE = {"ball": {"k": 0.2, "g": 0.04}, "energy": 0.01, "sea": [1]}


def test_the_picture_of_the_curves_shows_its_data(monkeypatch):
    monkeypatch.setattr(curve_scene, "THEOREMS", {SMALL.name: SMALL})
    ball = Ball(k=0.2, g=0.04)
    data = curve_scene.scene_curves(ball, 0.01, [0.17865])
    assert data.sizes["curve"] == 1
    assert 0.0069 < data["share"].item() < 0.007
    x, y = data["x"].values[:-1], data["y"].values[:-1]
    area = 0.5 * abs(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]))
    assert 0.99 * data["area"].item() < area < data["area"].item()
    orbits = scene_orbits(ball, 0.01, [0.1, 0.9], [200, 800])
    first, again = (render(curves.draw(SCENE, data, orbits), "png") for _ in range(2))
    data["x"] = data["x"] + 0.005
    assert first == again != render(curves.draw(SCENE, data, orbits), "png")
