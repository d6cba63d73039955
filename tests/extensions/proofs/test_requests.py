"""Proofs on request, proofs of impacts, and the data of the pictures."""

from functools import partial

import numpy as np
import pytest
from flint import ctx

from extensions.claims.analyses.polygon import Polygon
from extensions.proofs import THEOREMS, Surface, prove_curve, prove_horseshoe, prove_orbit
from extensions.proofs.proved_impacts import Impacts, _impacts_behind, of_orbits, prove_impacts
from extensions.proofs.theorems import scenes
from helpers.parts.certificates import numbers
from helpers.parts.small_curve import SMALL
from helpers.project import SHIPPED
from helpers.sections import BALL
from helpers.slowly import slowly
from pipeline import config
from pseudorigid import Ball, symmetric_orbits
from pseudorigid.dynamics.orbits import scene_orbits
from pseudorigid.dynamics.variables import chart, of_type, states_of

PAPER = Surface("1/5", "1/25", "1/100")


@pytest.fixture(scope="module")
def six():
    return symmetric_orbits(BALL, 0.01, 6)


@pytest.mark.parametrize(
    ("k", "g", "energy", "period"),
    [(0.2, 0.04, 0.01, 6), (1 / 3, 0.04, 0.1, 3), (0.2, 0.01, 0.03, 1), (1.0, 0.4, 0.064, 5)],
)  # fmt: skip
def test_every_symmetric_orbit_is_proved_on_request(k, g, energy, period):
    ball = Ball(k, g)
    orbits = symmetric_orbits(ball, energy, period)
    assert orbits.sizes["orbit"] > 0
    for i in range(orbits.sizes["orbit"]):
        orbit = orbits.isel(orbit=i)
        proved = prove_orbit(ball, orbit)
        assert proved.type == orbit["type"].item() and proved.radius > 0
        assert float(proved.trace) == pytest.approx(orbit["trace"].item(), rel=1e-6, abs=1e-6)
        points = np.array([[float(a) for a in point] for point in proved.points]).T
        assert points.shape == (2, period)
        assert np.abs(points - chart(k, *states_of(orbit))).max() < 1e-12


def test_exact_parameters_are_taken_as_they_are(six):
    orbit = of_type(six, "hyperbolic")
    exact, rounded = prove_orbit(PAPER, orbit), prove_orbit(BALL, orbit)
    decimal = prove_orbit(BALL, orbit, energy="0.01")
    with ctx.workprec(256):
        stated = THEOREMS["six-hyperbolic"].check().digits["x"]
        assert exact.points[0][0].str(20).startswith(stated[:15])
        assert not exact.points[0][0].overlaps(rounded.points[0][0])
        assert not rounded.points[0][0].overlaps(decimal.points[0][0])


def test_a_request_that_cannot_be_proved_is_refused_in_one_line(six):
    hyperbolic = of_type(six, "hyperbolic")
    moved = hyperbolic.copy(deep=True)
    moved["x"] = moved["x"] + 1e-3
    for match, request in {
        "it is elliptic": lambda: prove_horseshoe(PAPER, of_type(six, "elliptic"), side="outer"),
        "energy is 0.01": lambda: prove_orbit(Surface("1/5", "1/25", "1/50"), hyperbolic),
        "isel": lambda: prove_orbit(PAPER, six),
        "side = 'left'": lambda: prove_horseshoe(PAPER, hyperbolic, side="left"),
        "energy|cannot be proved": lambda: prove_orbit(PAPER, moved),
        "energy = None": lambda: prove_orbit(BALL, hyperbolic.drop_attrs()),
        "energy = <xarray": lambda: prove_orbit(BALL, hyperbolic, six),
        "rotation_number = <xarray": lambda: prove_curve(BALL, 0.01, six),
    }.items():
        with pytest.raises(ValueError, match=match) as error:
            request()
        assert "\n" not in str(error.value)


def test_what_is_no_ball_or_orbit_is_refused_in_one_line(six):
    orbit = of_type(six, "hyperbolic")
    for ball in (None, (0.2, 0.04), six):
        for call in (prove_orbit, partial(prove_horseshoe, side="outer")):
            with pytest.raises(ValueError, match=r"^ball = .* is not allowed: a Ball$"):
                call(ball, orbit)
        with pytest.raises(ValueError, match=r"^ball = .* is not allowed: a Ball$"):
            prove_curve(ball, 0.01, 0.17)
    for other in (None, 3, "orbit", orbit.drop_vars("x"), orbit.isel(point=[]), orbit["x"]):
        for call in (prove_orbit, partial(prove_horseshoe, side="outer")):
            with pytest.raises(ValueError, match=r"^orbit = .* is not allowed: one orbit of"):
                call(BALL, other)


@pytest.mark.parametrize(
    ("k", "g", "energy", "period", "side", "entropy"),
    [(0.3, 0.02, 0.002, 5, "outer", 0.023),
     *slowly((0.3, 0.02, 0.002, 6, "inner", 0.04))],
)  # fmt: skip
def test_horseshoes_are_proved_on_request(k, g, energy, period, side, entropy):
    exact = Surface(*map(str, (k, g, energy)))
    orbit = of_type(symmetric_orbits(Ball(k, g), energy, period), "hyperbolic")
    finding = prove_horseshoe(exact, orbit, side=side)[1]
    assert float(finding.digits["entropy"]) > entropy


# ---- impacts of doubles


def orbit_impacts(starts, impacts_each):
    orbits = scene_orbits(BALL, 0.01, starts, impacts_each)
    return of_orbits(BALL, 0.01, orbits, orbits["start"].values)


def test_impacts_are_proved_and_errors_small():
    impacts, told = orbit_impacts([0.534522, -0.44], [400, 200]), []
    result = prove_impacts("1/5", "1/25", impacts, progress=told.append)
    assert told == [*range(600)] and result.verdict == "proved"
    assert 0 < result.margins["worst error"] < 1e-12 and "600 impacts" in result.line()


@pytest.mark.parametrize("scene", ["fig4", "fig6", "fig7"])
def test_impacts_of_each_stage_are_proved(scene, six):
    data = {"periodic": six, "manifolds": six.isel(orbit=0)}
    for _, some in _impacts_behind(config.load(SHIPPED).scenes[scene], data.get, 6):
        assert prove_impacts("1/5", "1/25", some).verdict == "proved"


def test_no_impacts_a_missed_one_and_a_wrong_time_are_noticed():
    none = Impacts(np.empty((3, 0)), np.empty((3, 0)), np.empty(0))
    assert prove_impacts("1/5", "1/25", none).verdict == "not proved"
    impacts = orbit_impacts([0.534522], [60])
    before, after, tau = impacts
    skipped = Impacts(np.delete(before, 31, 1), np.delete(after, 30, 1), np.delete(tau, 30))
    assert "impact 30 is off by" in prove_impacts("1/5", "1/25", skipped).reason
    tau[7] += 1e-5
    assert "impact 7 is off by 1e-05" in prove_impacts("1/5", "1/25", impacts).reason


# ---- data of the pictures


@pytest.fixture
def sets(six):
    return scenes.scene_horseshoe(BALL, 0.01, six, 6, "hyperbolic", "outer")


def test_the_data_of_the_horseshoe_show_the_committed_certificate(sets):
    assert sets.sizes["set"] == 6 + 2 * 59 + 1 and np.isnan(sets["chain"].values).sum() == 6
    rows = [row for field in ("saddles", "approach")
            for row in numbers(THEOREMS["horseshoe-outer"].text(), field)]  # fmt: skip
    assert sets["x"].values[: 6 + 59].tolist() == [float(row[0]) for row in rows]
    p, q = sets["image_p"].values, sets["image_q"].values
    assert np.abs(p[:2]).min() > 1 and np.abs(q).max() < 1
    middle = sets.isel(set=int(np.flatnonzero(sets["chain"].values == 0)[0]))
    assert middle["y"].item() == 0
    assert middle["corner_x"].mean().item() == pytest.approx(middle["x"].item(), abs=1e-12)


def test_the_twist_of_another_ball_and_its_proved_zero():
    energies = [0.001, 0.002, 0.003, 0.004, 0.005]
    data = scenes.scene_twist(Ball(k=0.3, g=0.02), 0.002, energies)
    assert 0.0042832990 < data["zero"].item() < 0.0042832991
    # at the resonance of order three the twist jumps: no zero
    assert np.isnan(scenes.scene_twist(Ball(0.3, 0.02), 0.002, [0.005, 0.01])["zero"].item())


def test_the_data_of_a_proved_curve(monkeypatch):
    monkeypatch.setattr(scenes, "theorems_at", lambda *_: [SMALL])
    data = scenes.scene_curves(BALL, 0.01, [0.17865])
    assert data.sizes["curve"] == 1 and 0.0069 < data["share"].item() < 0.007
    area = Polygon(np.stack([data["x"].values[:-1], data["y"].values[:-1]])).area()
    assert 0.99 * data["area"].item() < area < data["area"].item()


@pytest.mark.slow
def test_the_data_of_a_proved_graph():
    data = scenes.scene_graph(BALL, 0.005)
    assert 0.05 < data["entropy"].item() < 0.051
    ends = data["connection"].values < 0
    assert ends.sum() == 2 and ends.size - 2 == (data["impacts"].values - 1).sum()
    with pytest.raises(ValueError, match=r"at k = 1/5, .*: there are those at .*E/g.2 = 25/4"):
        scenes.scene_graph(BALL, 0.006)
    scaled = scenes.scene_graph(Ball(0.2, 0.08), 0.02)
    assert np.array_equal(scaled["corner_x"], 2.0 * data["corner_x"])
    assert scaled["radius"] == pytest.approx(2.0 * data["radius"])
