"""Errors of figures under each method, for a portrait and a motion."""

from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from pipeline import config
from pseudorigid import Ball, symmetric_orbits
from study import figure_errors
from study.compared import STUDIED
from study.methods.counted_methods import ENGINES, OURS, SCANS

BALL = {"k": 0.2, "g": 0.04}
AXIS = {"limits": [-0.4, 0.6], "ticks": [-0.4, 0, 0.25]}
PORTRAIT = {
    "picture": "portrait", "ball": BALL, "energy": 0.01, "impacts": 400,
    "starts": [0.53, {"x": 0.1, "y": 0.02}], "view": {"elevation": 40, "azimuth": 115},
    "axes": {name: AXIS for name in ("x", "xdot", "udot")},
}  # fmt: skip
MOTION = {
    "picture": "motion", "ball": BALL, "energy": 0.01, "period": 1, "type": "elliptic",
    "duration": 30, "axes": {"t": {"limits": [0, 30], "ticks": [0, 30]}, "displacement": AXIS},
}  # fmt: skip


@pytest.fixture(scope="module")
def errors():
    """Errors of a portrait and a motion by the march, a coarse scan and a fine engine."""
    periodic = symmetric_orbits(Ball(**BALL), 0.01, 1)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(figure_errors, "METHODS", (OURS, SCANS[0], ENGINES[2]))
        return figure_errors.figure_errors(
            periodic, scenes={"sections": PORTRAIT, "times": MOTION},
            measures={"sections": "portrait", "times": "motion"}, inputs=["periodic/times"],
        )  # fmt: skip


def test_the_kinds_with_a_measure_are_studied():
    assert set(STUDIED) == set(figure_errors.MEASURES)


def test_a_scene_without_all_axes_is_left_out():
    bare = {key: value for key, value in PORTRAIT.items() if key != "axes"}
    flat = {name: axis for name, axis in PORTRAIT["axes"].items() if name != "udot"}
    document = {"one": PORTRAIT, "two": bare, "three": PORTRAIT | {"axes": flat}}
    given = {"ball": BALL, "scenes": document, "study": {"needs": {"picture": "figure_errors"}}}
    specs = config.check(given).build_specs(["study"])
    block = specs["results/study/needs.nc"].config
    assert list(block["scenes"]) == list(block["measures"]) == ["one"]


def test_the_march_is_exact_and_the_cheapest_and_an_engine_is_not(errors):
    march, scan, engine = (errors["error"].values[:, i] for i in range(3))
    assert np.all(march < 1e-6) and np.all(march < scan)
    assert np.all(engine > 0.1)  # its first order shows
    assert np.all(errors["missed"].values[:, 0] == 0)
    assert np.all(errors["evaluations"].values[:, 0] < errors["evaluations"].values[:, 1])
    assert np.all(errors["limit"].values == 1.0)
    assert errors["good"].values[:, 0].tolist() == [1, 1]
    assert errors["cheapest"].values.tolist() == [0, 0]


def test_a_figure_has_its_impacts_and_the_size_of_its_pixels(errors):
    portrait, motion = errors["impacts"].values
    assert portrait == 2 * 400
    assert 8 <= motion <= 12  # flights of some 3 time units
    assert np.all((errors["pixel"].values > 1e-4) & (errors["pixel"].values < 0.05))


def test_errors_across_a_branch_grow_by_the_multiplier_of_an_impact(monkeypatch):
    monkeypatch.setattr(figure_errors, "METHODS", (OURS, ENGINES[2]))
    states = Ball(**BALL).start(np.linspace(-0.5, 0.5, 20), 0.01)
    names = "x", "xdot", "udot"
    manifolds = xr.Dataset({n: ("point", a) for n, a in zip(names, states, strict=True)})

    def error(multiplier, period):
        orbit = xr.Dataset({"x": (("orbit", "point"), np.zeros((1, period)))})
        orbit = orbit.assign(type=("orbit", ["saddle"]), multiplier=("orbit", [multiplier]))
        block = PORTRAIT | {"type": "saddle", "period": period}
        return figure_errors._branches(block, orbit, manifolds).error[1]

    assert error(2.0, 1) == pytest.approx(1.5 * error(4.0, 1), rel=1e-12)
    assert error(0.0625, 2) == pytest.approx(error(4.0, 1), rel=1e-12)

    def with_a_wrong_root(*given):
        tau, count = OURS.solve(*given)
        return np.append(tau[:-1], 99.0), count

    lost = SimpleNamespace(solve=with_a_wrong_root)  # it counts as missed, not as an error
    monkeypatch.setattr(figure_errors, "METHODS", (OURS, lost))
    assert error(2.0, 1) < 1e-6


def test_a_missed_impact_makes_a_picture_of_orbits_wrong(monkeypatch):
    scene = PORTRAIT | {"impacts": 20_000, "starts": [0.534522]}
    monkeypatch.setattr(figure_errors, "METHODS", (OURS, SCANS[3]))
    data = figure_errors.figure_errors(
        scenes={"sea": scene}, measures={"sea": "portrait"}, inputs=[]
    )
    assert data["missed"].values[0, 1] > 0
    assert data["error"].values[0, 1] < 1.0
    assert data["good"].values[0].tolist() == [1, 0]


def test_the_stretch_is_that_of_the_product_and_leaves_grazings_out():
    matrices = np.random.default_rng(1).normal(0.0, 2.0, (9, 3, 3))
    product = np.linalg.multi_dot([*matrices[::-1], np.array([1.0, 0.0, 0.0])])
    expected = np.log(np.linalg.norm(product))
    assert figure_errors._log_stretch(matrices) == pytest.approx(expected, rel=1e-12)
    for value in (np.inf, np.nan, 0.0):
        grazing = np.insert(matrices, 4, np.full((3, 3), value), axis=0)
        assert figure_errors._log_stretch(grazing) == pytest.approx(expected, rel=1e-12)


def test_a_pixel_is_that_of_the_axes():
    plane = SimpleNamespace(frame=(10.0, 20.0, 110.0, 220.0))
    plane.across, plane.up = SimpleNamespace(limits=(0, 30)), SimpleNamespace(limits=(-1, 1))
    assert figure_errors._pixels(plane) == (0.3, 0.01)
