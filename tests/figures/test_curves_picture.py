"""The picture of proved invariant curves shows its data."""

import numpy as np

from pseudorigid import Ball
from pseudorigid.dynamics.orbits import scene_orbits
from pseudorigid.figures.canvas.render import render
from pseudorigid.figures.kinds import curves
from pseudorigid.proofs.theorems.curve_scene import scene_curves

SCENE = {"ball": {"k": 0.2, "g": 0.04}, "energy": 0.001, "sea": [1]}


def test_the_picture_of_the_curves_shows_its_data():
    ball = Ball(k=0.2, g=0.04)
    data = scene_curves(ball, 0.001, [0.10395])
    assert data.sizes["curve"] == 1
    assert 0.327 < data["share"].item() < 0.328
    x, y = data["x"].values[:-1], data["y"].values[:-1]
    area = 0.5 * abs(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]))
    assert 0.99 * data["area"].item() < area < data["area"].item()
    orbits = scene_orbits(ball, 0.001, [0.1, 0.9], [200, 800])
    first, again = (render(curves.draw(SCENE, data, orbits), "png") for _ in range(2))
    data["x"] = data["x"] + 0.005
    assert first == again != render(curves.draw(SCENE, data, orbits), "png")
