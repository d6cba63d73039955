"""The numbers that the paper prints, from the scenes of config.yaml."""

import numpy as np
import pytest

from helpers.project import shipped
from paper.values import BALL as PAPER_BALL
from paper.values import EXPONENT, FIGURES, WINDOW
from pseudorigid import Ball, symmetric_orbits
from pseudorigid.dynamics.lyapunov import scene_exponents
from pseudorigid.dynamics.variables import of_type

DOCUMENT = shipped()
SCENES = DOCUMENT["scenes"]
BALL = Ball(**DOCUMENT["ball"])


def the_orbit(scene):
    block = SCENES[scene]
    return of_type(symmetric_orbits(BALL, block["energy"], block["period"]), block["type"])


def test_the_ball_and_the_energies_are_the_paper_s():
    assert {"k": BALL.k, "g": BALL.g} == PAPER_BALL and SCENES.keys() == FIGURES.keys()
    for name, printed in FIGURES.items():
        for key in SCENES[name].keys() & printed.keys() - {"starts"}:
            assert SCENES[name][key] == printed[key], (name, key)


@pytest.mark.parametrize("scene", ["fig2", "fig8"])
def test_the_portraits_have_as_many_starts_and_points(scene):
    block, printed = SCENES[scene], FIGURES[scene]
    assert len(block["starts"]) == len(block["impacts"]) == printed["starts"]
    assert sum(block["impacts"]) == pytest.approx(printed["points"], rel=0.02)


def test_the_hyperbolic_point_is_in_the_window_of_figure_6():
    block = SCENES["fig6"]
    saddle = the_orbit("fig6")
    x, xdot = (float(saddle[name][block["point"]]) for name in ("x", "xdot"))
    radius = BALL.section(block["energy"])[1]
    for name, centre in (("x", x), ("xdot", xdot)):
        edges = WINDOW[name]
        assert edges[0] < centre < edges[1]
        window = [centre + radius * edge for edge in block["window"][name]]
        assert window == pytest.approx(edges, abs=1e-8)


def test_the_multipliers():
    multiplier = float(the_orbit("fig6")["multiplier"])
    assert round(multiplier, 4) == 2.0417 and round(1 / multiplier, 4) == 0.4898


def test_the_exponents_of_figure_7():
    block = SCENES["fig7"]
    assert len(block["starts"]) == FIGURES["fig7"]["starts"]
    fields = {name: block[name] for name in ("energy", "starts", "impacts", "records")}
    found = scene_exponents(BALL, **fields)["exponent"].values
    assert found.shape[1:] == (3, 3)
    final = found[-1]
    assert final[:, 0] == pytest.approx(EXPONENT, abs=0.02)
    assert final[:, 2] == pytest.approx(-EXPONENT, abs=0.02)
    assert np.max(np.abs(final.sum(axis=1))) < 1e-4 and np.max(np.abs(final[:, 1])) < 1e-4
