"""The picture of a proved graph shows its data."""

import numpy as np
import pytest

from pseudorigid import Ball
from pseudorigid.dynamics.orbits import scene_orbits
from pseudorigid.figures.canvas.render import render
from pseudorigid.figures.kinds import graph
from pseudorigid.proofs.theorems.graph_scene import scene_graph

SCENE = {"ball": {"k": 0.2, "g": 0.04}, "energy": 0.005}


def test_the_picture_of_a_graph_shows_its_data():
    ball = Ball(k=0.2, g=0.04)
    data = scene_graph(ball, 0.005)
    assert 0.05 < data["entropy"].item() < 0.051
    ends = data["connection"].values < 0
    assert ends.sum() == 2
    assert ends.size - 2 == (data["impacts"].values - 1).sum()
    orbits = scene_orbits(ball, 0.005, [0.6], [500])
    first, again = (render(graph.draw(SCENE, data, orbits), "png") for _ in range(2))
    data["corner_x"] = data["corner_x"] + 0.005 * np.where(ends, 1.0, 0.0)[:, None]
    assert first == again != render(graph.draw(SCENE, data, orbits), "png")


def test_an_energy_without_a_theorem_about_a_graph_is_refused():
    with pytest.raises(ValueError, match="no graph is a theorem at k = 1/5"):
        scene_graph(Ball(k=0.2, g=0.04), 0.006)
