"""Branches of manifolds: accuracy, invariance, windows, jumps and weak saddles."""

from functools import cache

import numpy as np
import pytest
import xarray as xr

from helpers.sections import BALL
from pseudorigid import symmetric_orbits, trace_manifold
from pseudorigid.dynamics import branch as rule
from pseudorigid.dynamics import manifolds
from pseudorigid.dynamics.variables import of_type, states_of

ENERGY = 0.01
RADIUS = BALL.section(ENERGY)[1]
SIDES = "inner", "outer"


@cache
def orbits_of(energy, period):
    return symmetric_orbits(BALL, energy, period)


SADDLE = of_type(orbits_of(ENERGY, 6), "hyperbolic")
INVERSE = of_type(orbits_of(ENERGY, 6), "inverse hyperbolic")
WEAK_ENERGY = 0.001
WEAK = of_type(orbits_of(WEAK_ENERGY, 10), "hyperbolic")  # its multiplier is 1.34


def line(orbit=SADDLE, saddle=0, energy=ENERGY, **options):
    """Return the vertices (3, n) of a branch."""
    return states_of(trace_manifold(BALL, energy, orbit, saddle, **options))


def norm(vectors):
    return np.sqrt(np.sum(vectors**2, axis=0))


def sides_of(points):
    return norm(np.diff(points, axis=1))


def distances(points, line):
    """Return the distance of each of points (3, n) from the nearest side of a polyline (3, m)."""
    start, along = line[:, :-1], np.diff(line, axis=1)
    good = ~np.isnan(along[0]) & (np.sum(along * along, axis=0) > 0)
    start, along = start[:, good], along[:, good]
    nearest = []
    for point in points.T:
        offset = point[:, None] - start
        share = np.clip(np.sum(offset * along, axis=0) / np.sum(along * along, axis=0), 0, 1)
        nearest.append(np.min(norm(offset - share * along)))
    return np.array(nearest)


def mapped(points, impacts):
    """Return the points (3, n) some impacts later."""
    return BALL.after(points, impacts)[:3]


@pytest.mark.parametrize("side", SIDES)
def test_sides_and_bends_are_within_their_limits(side):
    options = {"side": side, "length": 2.0, "distance": 0.01, "bend": 10.0}
    branch = trace_manifold(BALL, ENERGY, SADDLE, **options)
    points = states_of(branch)
    assert np.all(points[:, 0] == states_of(SADDLE)[:, 0])
    steps = np.diff(points, axis=1) / RADIUS
    sides = norm(steps)
    assert np.nanmax(sides) <= 0.01
    cosine = np.sum(steps[:, 1:] * steps[:, :-1], axis=0) / (sides[1:] * sides[:-1])
    drawn = np.maximum(sides[1:], sides[:-1]) > 1e-5
    assert np.nanmin(cosine[drawn]) >= np.cos(np.radians(10.0)) - 1e-12
    assert np.nansum(sides) == pytest.approx(2.0, abs=0.02)
    assert branch.attrs["start_error"] < 1e-10


@pytest.mark.parametrize(("orbit", "energy", "side", "length", "mapped_length", "limit"), [
    (SADDLE, ENERGY, "inner", 1.0, 0.1, 3e-5),
    (SADDLE, ENERGY, "outer", 1.0, 0.1, 3e-5),
    (WEAK, WEAK_ENERGY, "outer", 0.5, 0.35, 5e-5),  # beyond the next saddle
])  # fmt: skip
def test_a_branch_is_mapped_into_itself(orbit, energy, side, length, mapped_length, limit):
    radius = BALL.section(energy)[1]
    branch = line(orbit, energy=energy, side=side, length=length, bend=2.0)
    travelled = np.concatenate([[0.0], np.cumsum(sides_of(branch))]) / radius
    part = branch[:, (travelled > 1e-4) & (travelled < mapped_length)]
    assert part.shape[1] > 20
    assert np.max(distances(mapped(part, orbit.sizes["point"]), branch)) < limit * radius


@pytest.mark.parametrize(("orbit", "energy"), [(SADDLE, ENERGY), (WEAK, WEAK_ENERGY)])
def test_the_stable_branch_is_the_mirror_image(orbit, energy):
    options = {"energy": energy, "length": 0.5}
    mirrored = np.stack(BALL.reflect(*line(orbit, 1, **options)))
    found = line(orbit, 0, stable=True, **options)
    # Rounding may shift points along the line.
    assert np.max(distances(mirrored, found)) < 1e-4 * BALL.section(energy)[1]


@pytest.mark.parametrize("stable", [True, False])
def test_a_branch_starts_at_its_own_saddle(stable):
    for saddle in range(6):
        found = line(SADDLE, saddle, stable=stable, length=0.02, distance=0.02, bend=60)
        own = states_of(SADDLE)[:, [saddle]]
        assert np.max(np.abs(found[:, :1] - own)) < 1e-9 * RADIUS


@pytest.mark.parametrize(("side", "other"), [SIDES, SIDES[::-1]])
def test_an_inverse_hyperbolic_branch_changes_sides(side, other):
    """P^6 maps a branch to the other one, P^12 to itself, by the multiplier's square."""
    multiplier = float(INVERSE["multiplier"])
    assert multiplier < -2
    branch, across = (line(INVERSE, 1, side=s, length=0.5, bend=2.0) for s in (side, other))
    distance = norm(branch - branch[:, :1])
    near = (distance > 2e-6 * RADIUS) & (distance < 1e-3 * RADIUS)
    assert near.sum() > 20
    six, twelve = mapped(branch[:, near], 6), mapped(branch[:, near], 12)
    assert np.max(distances(six, across)) < 1e-5 * RADIUS
    assert np.max(distances(twelve, branch)) < 1e-5 * RADIUS
    first = distance[near] < 1e-5 * RADIUS
    growth = norm(twelve[:, first] - branch[:, :1]) / distance[near][first]
    assert growth == pytest.approx(multiplier**2, rel=1e-3)


def test_a_window_keeps_what_passes_through_it():
    """It keeps all of the branch inside it, in sides that are short in units of its size."""
    x, v = float(SADDLE["x"][1]), float(SADDLE["xdot"][1])
    window = (x - 0.02, x + 0.014, v - 0.016, v + 0.02)
    whole = line(side="inner", distance=2e-4, bend=2.0, length=1.0)
    points = line(side="inner", length=1.0, distance=0.01, bend=2.0, window=window)

    def inside(points):
        low, high = np.array(window[::2])[:, None], np.array(window[1::2])[:, None]
        return np.all((points[:2] >= low) & (points[:2] <= high), axis=0)

    expected = whole[:, inside(whole)]
    assert expected.shape[1] > 100
    assert np.max(distances(expected, points)) < 2e-4 * 0.02
    assert inside(points).sum() > 0.8 * np.sum(~np.isnan(points[0]))  # little else is kept
    both = inside(points)[1:] & inside(points)[:-1]
    assert np.nanmax(norm(np.diff(points[:2]) / [[0.034], [0.036]])[both]) <= 0.01


def test_a_window_shows_branches_of_all_saddles():
    shown = manifolds.scene_manifolds(
        BALL, ENERGY, orbits_of(ENERGY, 6), 6, "hyperbolic", {"distance": 0.02, "bend": 10},
        point=0, window={"x": [-0.01, 0.01], "xdot": [-0.01, 0.01]}, length=0.3,
    )  # fmt: skip
    assert shown.sizes["branch"] == 24
    assert int(shown["row_size"].sum()) == shown.sizes["vertex"]
    own = (shown["saddle"].values == 0) & (shown["row_size"].values > 0)
    assert own.sum() == 4
    assert np.sum(shown["row_size"].values == 0) > 10  # these branches pass beside the window
    assert shown.attrs["window_x"][0] < shown.attrs["point_x"] < shown.attrs["window_x"][1]


def test_a_branch_is_interrupted_where_the_map_jumps():
    """The outer branch meets the curve where the previous flight nearly touched the floor."""
    points = line(side="outer", length=8.0)
    (gaps,) = np.nonzero(np.isnan(points[0]))
    assert gaps.size > 0
    width = norm(points[:, gaps + 1] - points[:, gaps - 1]) / RADIUS
    assert np.all(width > 1e-6)
    assert np.any(width > 0.05)
    # Some impacts before a wide jump both ends were one state.
    for gap in gaps[width > 0.05]:
        history = [points[:, [gap - 1, gap + 1]]]
        for _ in range(12):
            history.append(np.stack(BALL.inverse_impact(*history[-1])[:3]))
        assert min(np.max(np.abs(ends[:, 0] - ends[:, 1])) for ends in history) < 1e-3 * RADIUS
    assert np.nanmax(sides_of(points)) <= (0.01 + 1e-12) * RADIUS
    length = np.nansum(sides_of(points)) / RADIUS  # without the jumps
    assert length == pytest.approx(8.0, abs=0.01)


@pytest.mark.parametrize("side", SIDES)
def test_a_weak_branch_has_few_vertices_and_the_documented_accuracy(side):
    assert float(SADDLE["multiplier"]) > rule.WEAK > float(WEAK["multiplier"]) > 1
    branch = trace_manifold(BALL, WEAK_ENERGY, WEAK, side=side, length=0.5)
    points, radius = states_of(branch), BALL.section(WEAK_ENERGY)[1]
    sides = sides_of(points) / radius
    assert sides.max() <= 0.01
    assert sides.sum() == pytest.approx(0.5, abs=0.02)
    assert sides.size < 4000  # 14,000 and 47,000 if mapped from the segment
    assert "ended" not in branch.attrs
    fine = line(WEAK, energy=WEAK_ENERGY, side=side, length=0.52, distance=0.001, bend=1.0)
    assert np.max(distances(points[:, :-2], fine)) < 2e-6 * radius


def test_a_branch_ends_where_rounding_takes_over():
    """At E = 0.0008 rounding errors hide the inner branches beyond the next saddle."""
    orbit = of_type(orbits_of(0.0008, 10), "hyperbolic")
    radius = BALL.section(0.0008)[1]
    branch = trace_manifold(BALL, 0.0008, orbit, side="inner", length=0.5)
    points = states_of(branch)
    assert branch.attrs["ended"] == pytest.approx(np.sum(sides_of(points)) / radius, rel=1e-3)
    assert branch.attrs["ended"] < 0.2
    assert np.min(norm(states_of(orbit)[:, 1:] - points[:, [-1]])) < 1e-4 * radius


def test_a_branch_of_too_many_images_is_rejected(monkeypatch):
    monkeypatch.setattr(rule, "MOST_IMAGES", 20)
    with pytest.raises(ValueError, match=r"27 images, .* 1\.34235"):
        line(WEAK, energy=WEAK_ENERGY, length=0.5)


def test_orbits_without_manifolds_or_of_another_energy_are_rejected():
    with pytest.raises(ValueError, match="elliptic"):
        line(of_type(orbits_of(ENERGY, 6), "elliptic"))
    with pytest.raises(ValueError, match=r"energy = 0\.02 .* 0\.01"):
        line(energy=0.02)


def test_a_branch_of_an_inverse_saddle_stays_on_its_side():
    """Its images under P^n alternate between the sides; those of one branch do not."""
    for side in SIDES:
        points = line(INVERSE, side=side, length=0.05, distance=0.01, bend=20)
        steps = points[:2, 1:] - points[:2, :1]
        near = norm(steps) < 0.01 * RADIUS  # before it bends
        assert near.sum() > 30 and np.all(steps[:, near].T @ steps[:, 0] > 0.0)


def test_errors_of_a_scene_are_those_of_its_worst_branch(monkeypatch):
    attributes = iter([{"start_error": 1e-12 * i, "ended": 0.9 - 0.1 * i} for i in (1, 3, 2)] * 4)

    def traced(*given, **options):
        vertices = {name: ("vertex", [0.0]) for name in ("x", "xdot", "udot")}
        return xr.Dataset(vertices, attrs=next(attributes))

    monkeypatch.setattr(manifolds, "trace_manifold", traced)
    scene = {"period": 6, "type": "hyperbolic", "resolution": {}, "branches": {"outer": {}}}
    found = manifolds.scene_manifolds(BALL, ENERGY, orbits_of(ENERGY, 6), **scene)
    assert found.attrs["start_error"] == 3e-12
    assert found.attrs["ended"] == pytest.approx(0.6)
