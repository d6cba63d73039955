"""The numbers that the paper prints, from the scenes of config.yaml."""

import numpy as np
import pytest
from project import shipped

from pseudorigid import Ball, symmetric_orbits
from pseudorigid.dynamics.lyapunov import scene_exponents
from pseudorigid.dynamics.motion import motion
from pseudorigid.dynamics.orbits import scene_orbits
from pseudorigid.dynamics.variables import of_type

DOCUMENT = shipped()
SCENES = DOCUMENT["scenes"]
BALL = Ball(**DOCUMENT["ball"])


def the_orbit(scene):
    block = SCENES[scene]
    return of_type(symmetric_orbits(BALL, block["energy"], block["period"]), block["type"])


def test_the_ball_and_the_energies_are_the_paper_s():
    assert (BALL.k, BALL.g) == (0.2, 0.04)
    energies = {name: block["energy"] for name, block in SCENES.items()}
    expected = dict.fromkeys(("fig2", "fig3", "fig4", "fig5", "fig6", "fig7"), 0.01)
    assert energies == expected | {"fig8": 0.001}


@pytest.mark.parametrize(("scene", "starts", "points"), [("fig2", 8, 45_000), ("fig8", 6, 35_000)])
def test_the_portraits_have_as_many_starts_and_points(scene, starts, points):
    block = SCENES[scene]
    assert len(block["starts"]) == len(block["impacts"]) == starts
    assert sum(block["impacts"]) == pytest.approx(points, rel=0.02)
    found = scene_orbits(BALL, block["energy"], block["starts"], block["impacts"])
    assert found.sizes == {"point": sum(block["impacts"]), "orbit": starts}
    energy = BALL.energy(*(found[name].values for name in ("x", "xdot", "udot")))
    assert np.max(np.abs(energy - block["energy"])) < 1e-14
    # every point is inside the axes
    for name in ("x", "xdot", "udot"):
        low, high = block["axes"][name]["limits"]
        assert np.all((found[name].values >= low) & (found[name].values <= high))


def test_the_hyperbolic_point_is_in_the_window_of_figure_6():
    block = SCENES["fig6"]
    saddle = the_orbit("fig6")
    x, xdot = (float(saddle[name][block["point"]]) for name in ("x", "xdot"))
    assert 0.21 < x < 0.2116
    assert 0.0925 < xdot < 0.0932
    radius = BALL.section(block["energy"])[1]
    for name, centre, edges in (("x", x, (0.21, 0.2116)), ("xdot", xdot, (0.0925, 0.0932))):
        window = [centre + radius * edge for edge in block["window"][name]]
        assert window == pytest.approx(edges, abs=1e-8)


def test_the_multipliers():
    multiplier = float(the_orbit("fig6")["multiplier"])
    assert round(multiplier, 4) == 2.0417
    assert round(1 / multiplier, 4) == 0.4898


@pytest.mark.parametrize(("scene", "turns"), [("fig3", 16), ("fig4", 60)])
def test_figures_3_and_4_close_on_themselves(scene, turns):
    one = the_orbit(scene)
    duration = SCENES[scene]["duration"]
    assert duration == turns
    total = float(one["total_time"])
    found = motion(BALL, one, duration)
    t, position, strain = (found[name].values for name in ("t", "position", "strain"))
    assert (t[0], t[-1]) == (0.0, duration)
    assert np.max(position + strain) <= 1e-16 * 4
    # a whole orbit later it is where it was
    assert total < duration
    later = np.linspace(total, duration, 500)
    for curve in (position, strain):
        shifted = np.interp(later - total, t, curve) - np.interp(later, t, curve)
        assert np.max(np.abs(shifted)) < 2e-5  # of linear interpolation between samples
    again = [float(one[name][0]) for name in ("x", "xdot", "udot")]
    for _ in range(one.sizes["point"]):
        again = BALL.impact(*again)[:3]
    gap = max(abs(a - float(one[n][0])) for a, n in zip(again, ("x", "xdot", "udot"), strict=True))
    assert gap <= 1e-14
    low, high = SCENES[scene]["axes"]["displacement"]["limits"]
    assert low < np.min(-position)
    assert np.max(strain) < high


def test_the_exponents_of_figure_7():
    block = SCENES["fig7"]
    assert block["impacts"] == 200_000
    assert len(block["starts"]) == 3
    fields = {name: block[name] for name in ("energy", "starts", "impacts", "records")}
    found = scene_exponents(BALL, **fields)["exponent"].values
    assert found.shape[1:] == (3, 3)
    final = found[-1]
    assert np.all((final[:, 0] > 0.215) & (final[:, 0] < 0.245))
    assert np.all((final[:, 2] < -0.215) & (final[:, 2] > -0.245))
    assert np.max(np.abs(final.sum(axis=1))) < 1e-4
    assert np.max(np.abs(final[:, 1])) < 1e-4
