"""Proofs on request, impacts proved, the judge, and the pictures' data."""

from fractions import Fraction

import numpy as np
import pytest
from flint import ctx

from pseudorigid import Ball, symmetric_orbits
from pseudorigid.dynamics.orbits import scene_orbits
from pseudorigid.dynamics.variables import of_type
from pseudorigid.proofs import THEOREMS, Surface, prove_horseshoe, prove_orbit, reference_solver
from pseudorigid.proofs.theorems import impacts, pictures, scenes

BALL = Ball(k=0.2, g=0.04)
PAPER = Surface("1/5", "1/25", "1/100")


@pytest.fixture(scope="module")
def six():
    return symmetric_orbits(BALL, 0.01, 6)


@pytest.mark.parametrize(
    ("k", "g", "energy", "period"),
    [(0.2, 0.04, 0.01, 6), (1 / 3, 0.04, 0.1, 3), (0.2, 0.01, 0.03, 1), (1.0, 0.5, 0.1, 5),
     (0.3, 0.1, 0.02, 1), (0.2, 0.04, 0.001, 10)],
)  # fmt: skip
def test_every_symmetric_orbit_is_proved_on_request(k, g, energy, period):
    ball = Ball(k, g)
    found = symmetric_orbits(ball, energy, period)
    assert found.sizes["orbit"] > 0
    for i in range(found.sizes["orbit"]):
        one = found.isel(orbit=i)
        proved = prove_orbit(ball, one)
        assert proved.type == one["type"].item()
        assert proved.radius > 0
        assert len(proved.points) == period
        assert float(proved.trace) == pytest.approx(one["trace"].item(), rel=1e-6, abs=1e-6)
        y = one["xdot"].values - k * one["udot"].values
        for (a, b), x0, y0 in zip(proved.points, one["x"].values, y, strict=True):
            assert abs(float(a) - x0) + abs(float(b) - y0) < 1e-12


def test_exact_parameters_are_taken_as_they_are(six):
    one = of_type(six, "hyperbolic")
    exact, rounded = prove_orbit(PAPER, one), prove_orbit(BALL, one)
    also = prove_orbit(Ball(k=0.2, g=0.04), one, energy="0.01")
    with ctx.workprec(256):
        stated = THEOREMS["six-hyperbolic"].check().digits["x"]
        assert exact.points[0][0].str(20).startswith(stated[:15])
        assert not exact.points[0][0].overlaps(rounded.points[0][0])
        assert not rounded.points[0][0].overlaps(also.points[0][0])


def one_line(error):
    assert "\n" not in str(error.value)


def test_what_cannot_be_proved_is_said_in_one_line(six):
    hyperbolic = of_type(six, "hyperbolic")
    with pytest.raises(ValueError, match=r"it is elliptic, not hyperbolic") as error:
        prove_horseshoe(PAPER, of_type(six, "elliptic"), side="outer")
    one_line(error)
    with pytest.raises(
        ValueError, match=r"the orbit's energy is 0.01, not that of k = 1/5"
    ) as error:
        prove_orbit(Surface("1/5", "1/25", "1/50"), hyperbolic)
    one_line(error)
    with pytest.raises(ValueError, match="isel"):
        prove_orbit(PAPER, six)
    with pytest.raises(ValueError, match="'outer' or 'inner'"):
        prove_horseshoe(PAPER, hyperbolic, side="left")
    moved = hyperbolic.copy(deep=True)
    moved["x"] = moved["x"] + 1e-3
    with pytest.raises(ValueError, match=r"energy|cannot be proved"):
        prove_orbit(PAPER, moved)


def test_a_horseshoe_on_request_gives_its_certificate(six):
    text, found = prove_horseshoe(PAPER, of_type(six, "hyperbolic"), side="outer")
    assert float(found.digits["entropy"]) > 0.0175
    theorem = THEOREMS["horseshoe-outer"]
    again = theorem.checker(text, **theorem.bounds | {"entropy": Fraction("0.0175")})
    assert again.margins == found.margins


@pytest.mark.parametrize(
    ("k", "g", "energy", "period", "side", "entropy"),
    [(0.3, 0.02, 0.002, 5, "outer", 0.023), (0.3, 0.02, 0.002, 6, "inner", 0.04),
     (0.2, 0.04, 0.012, 6, "outer", 0.027)],
)  # fmt: skip
def test_horseshoes_of_other_orbits_are_found_without_a_guess(k, g, energy, period, side, entropy):
    ball = Ball(k, g)
    orbit = of_type(symmetric_orbits(ball, energy, period), "hyperbolic")
    _, found = prove_horseshoe(ball, orbit, side=side)
    assert float(found.digits["entropy"]) > entropy


@pytest.mark.slow
def test_a_horseshoe_that_is_not_found_is_said_in_one_line():
    """At E = 0.001 the branches of the orbit of period ten all but coincide."""
    orbit = of_type(symmetric_orbits(BALL, 0.001, 10), "hyperbolic")
    with pytest.raises(ValueError, match=r"no size of its sets from 0.001 to \d.*e-07") as error:
        prove_horseshoe(BALL, orbit, side="outer")
    one_line(error)


# ---- impacts of doubles


def test_impacts_of_an_orbit_are_proved_and_errors_small():
    orbits = scene_orbits(BALL, 0.01, [0.534522, -0.440981], [400, 200])
    states = impacts.of_orbits(BALL, 0.01, orbits, orbits["start"].values)
    result = impacts.prove_impacts("1/5", "1/25", *states)
    assert result.verdict == "proved"
    assert 0 < result.margins["worst error"] < 1e-12
    assert result.line().startswith(
        "impacts: each of 600 impacts computed is the first one, to within 1e-06"
    )


def test_impacts_of_periodic_orbits_and_of_states_are_proved(six):
    one = of_type(six, "elliptic")
    assert impacts.prove_impacts("1/5", "1/25", *impacts.of_periodic(one)).verdict == "proved"
    states = np.array([one[name].values for name in ("x", "xdot", "udot")])
    found = impacts.of_states(BALL, states)
    assert impacts.prove_impacts("1/5", "1/25", *found).verdict == "proved"


def test_no_impacts_prove_nothing():
    none = np.empty((3, 0))
    result = impacts.prove_impacts("1/5", "1/25", none, none, np.empty(0))
    assert (result.verdict, result.reason) == ("not proved", "there are no impacts")


def test_a_missed_impact_is_seen():
    orbits = scene_orbits(BALL, 0.01, [0.534522], [60])
    before, after, tau = impacts.of_orbits(BALL, 0.01, orbits, orbits["start"].values)
    skipped = np.delete(before, 31, axis=1), np.delete(after, 30, axis=1), np.delete(tau, 30)
    result = impacts.prove_impacts("1/5", "1/25", *skipped)
    assert result.verdict == "not proved"
    assert "impact 30 is off by" in result.reason
    wrong = tau.copy()
    wrong[7] += 1e-5
    result = impacts.prove_impacts("1/5", "1/25", before, after, wrong)
    assert "impact 7 is off by 1e-05" in result.reason


def test_a_grazing_flight_is_not_decided():
    # exactly on the rim and pressed by nothing: x = -g, as far as 8192 bits of 1/25 tell
    before = np.array([[-0.25], [0.0], [0.0]])
    errors = reference_solver.impact_errors("1/5", "1/4", before, before, np.zeros(1))
    assert errors[0] < 1e-300
    errors = reference_solver.impact_errors("1/5", "1/25", np.array([[-0.04], [0.0], [0.0]]),
                                 before, np.zeros(1))  # fmt: skip
    assert errors[0] > 0.1


# ---- data of the pictures


def outer_sets():
    theorem = THEOREMS["horseshoe-outer"]
    return pictures.horseshoe_data(PAPER, theorem.prove(theorem.text()))


def test_the_committed_horseshoe_is_what_the_paper_s_scene_shows(six):
    shown = scenes.scene_horseshoe(BALL, 0.01, six, 6, "hyperbolic", "outer")
    assert shown.identical(outer_sets())


def test_the_twist_of_another_ball_and_its_proved_zero():
    energies = [0.001, 0.002, 0.003, 0.004, 0.005]
    data = scenes.scene_twist(Ball(k=0.3, g=0.02), 0.002, energies)
    assert 0.0042832990 < data["zero"].item() < 0.0042832991
    # at the resonance of order three the twist jumps: no zero
    assert np.isnan(scenes.scene_twist(Ball(0.3, 0.02), 0.002, [0.005, 0.01])["zero"].item())


def test_the_horseshoe_s_data_show_the_certificate():
    data = outer_sets()
    assert data.sizes["set"] == 6 + 2 * 59 + 1
    assert np.isnan(data["chain"].values).sum() == 6
    p, q = data["image_p"].values, data["image_q"].values
    assert np.abs(p[:2]).min() > 1
    assert np.abs(q).max() < 1
    middle = data.isel(set=int(np.flatnonzero(data["chain"].values == 0)[0]))
    assert middle["y"].item() == 0
    assert middle["corner_x"].mean().item() == pytest.approx(middle["x"].item(), abs=1e-12)


def test_the_twist_s_data_fall_through_the_zero():
    data = pictures.twist_data("1/5", "1/25", ["1/1000", "1/100", "29/1000", "3/100"])
    assert np.all(np.diff(data["twist"].values) < 0)
    assert data["twist"].values[2] > 0 > data["twist"].values[3]
    assert 0.029 < data["zero"].item() < 0.03
    stated = THEOREMS["twist-fixed-point"].check().digits["twist"]
    assert data["twist"].values[1] == float(stated[1:].split()[0])


def test_the_pictures_are_drawn():
    from pseudorigid.dynamics.manifolds import scene_manifolds
    from pseudorigid.figures.canvas.render import render
    from pseudorigid.figures.kinds import horseshoe, twist

    scene = {"ball": {"k": BALL.k, "g": BALL.g}, "energy": 0.01}
    data = pictures.twist_data("1/5", "1/25", ["1/1000", "1/100", "29/1000", "3/100"])
    one = render(twist.draw(scene | {"marks": [0.001, 0.01]}, data), "png")
    assert one == render(twist.draw(scene | {"marks": [0.001, 0.01]}, data), "png")
    assert one != render(twist.draw(scene | {"marks": []}, data), "png")
    manifolds = scene_manifolds(
        BALL, 0.01, symmetric_orbits(BALL, 0.01, 6), 6, "hyperbolic",
        {"distance": 0.05, "bend": 40},
        branches={"outer": {"length": 0.5}, "inner": {"length": 0.5}},
    )  # fmt: skip
    axes = {name: {"limits": [-1.4, 1.4], "ticks": [-1, 0, 1]} for name in "xypq"}
    sets = outer_sets()
    two = render(horseshoe.draw(scene | {"axes": axes}, manifolds, sets), "png")
    assert two == render(horseshoe.draw(scene | {"axes": axes}, manifolds, sets), "png")
    sets["image_p"] = 1.1 * sets["image_p"]
    assert two != render(horseshoe.draw(scene | {"axes": axes}, manifolds, sets), "png")
