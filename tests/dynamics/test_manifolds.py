"""Branches of manifolds: accuracy, invariance, windows, jumps and weak saddles."""

import math

import numpy as np
import pytest

from pseudorigid import Ball, symmetric_orbits, trace_manifold
from pseudorigid.dynamics import branch as rule
from pseudorigid.dynamics import manifolds
from pseudorigid.dynamics.variables import of_type

BALL, ENERGY = Ball(0.2, 0.04), 0.01
RADIUS = BALL.section(ENERGY)[1]
NAMES = "x", "xdot", "udot"


@pytest.fixture(scope="module")
def orbits():
    return symmetric_orbits(BALL, ENERGY, 6)


@pytest.fixture(scope="module")
def saddle(orbits):
    return of_type(orbits, "hyperbolic")


@pytest.fixture(scope="module")
def inverse(orbits):
    return of_type(orbits, "inverse hyperbolic")


@pytest.fixture(scope="module")
def weak():
    """Return the period-ten saddle of E = 0.001, whose multiplier is 1.34."""
    return of_type(symmetric_orbits(BALL, 0.001, 10), "hyperbolic")


def stacked(branch):
    return np.stack([branch[name].values for name in NAMES])


def sides_of(points):
    return np.sqrt(np.sum(np.diff(points, axis=1) ** 2, axis=0))


def distances(points, line):
    """Return the distance of each of points (3, n) from the nearest side of a polyline (3, m)."""
    start, along = line[:, :-1], np.diff(line, axis=1)
    good = ~np.isnan(along[0]) & (np.sum(along * along, axis=0) > 0)
    start, along = start[:, good], along[:, good]
    found = []
    for point in points.T:
        offset = point[:, None] - start
        share = np.clip(np.sum(offset * along, axis=0) / np.sum(along * along, axis=0), 0, 1)
        found.append(np.sqrt(np.min(np.sum((offset - share * along) ** 2, axis=0))))
    return np.array(found)


def mapped(points, impacts, ball=BALL):
    """Return the points (3, n) some impacts later."""
    columns = [a.copy() for a in points]
    ball.map.steps(*columns, ball.k, ball.g, impacts, np.empty(points.shape[1]))
    return np.stack(columns)


@pytest.mark.parametrize("side", ["inner", "outer"])
def test_sides_and_bends_are_within_their_limits(saddle, side):
    branch = trace_manifold(BALL, ENERGY, saddle, side=side, length=2.0, distance=0.01, bend=10.0)
    points = stacked(branch)
    assert np.all(points[:, 0] == [saddle[name].values[0] for name in NAMES])
    steps = np.diff(points, axis=1) / RADIUS
    sides = np.sqrt(np.sum(steps**2, axis=0))
    assert np.nanmax(sides) <= 0.01
    cosine = np.sum(steps[:, 1:] * steps[:, :-1], axis=0) / (sides[1:] * sides[:-1])
    drawn = np.maximum(sides[1:], sides[:-1]) > 1e-5
    assert np.nanmin(cosine[drawn]) >= np.cos(np.radians(10.0)) - 1e-12
    assert np.nansum(sides) == pytest.approx(2.0, abs=0.02)
    assert branch.attrs["start_error"] < 1e-10


@pytest.mark.parametrize("side", ["inner", "outer"])
def test_a_branch_is_mapped_into_itself(saddle, side):
    """P^6 maps the first part of a branch to a part of the branch, twice as far out."""
    branch = stacked(trace_manifold(BALL, ENERGY, saddle, side=side, length=1.0, bend=2.0))
    travelled = np.concatenate([[0.0], np.cumsum(sides_of(branch))]) / RADIUS
    some = branch[:, (travelled > 1e-4) & (travelled < 0.1)]
    assert some.shape[1] > 20
    assert np.max(distances(mapped(some, 6), branch)) < 3e-5 * RADIUS


def test_a_branch_leaves_its_point_by_the_multiplier(saddle):
    """Near the point, P^6 multiplies the distance from it by the multiplier."""
    branch = stacked(trace_manifold(BALL, ENERGY, saddle, 2, length=0.01))
    point = branch[:, :1]
    off = np.sqrt(np.sum((branch - point) ** 2, axis=0))
    near = (off > 1e-6 * RADIUS) & (off < 1e-5 * RADIUS)
    after = np.sqrt(np.sum((mapped(branch[:, near], 6) - point) ** 2, axis=0))
    assert after / off[near] == pytest.approx(float(saddle["multiplier"]), rel=1e-3)


def test_the_stable_branch_is_the_mirror_image(saddle):
    unstable = trace_manifold(BALL, ENERGY, saddle, 1, length=0.5)
    stable = trace_manifold(BALL, ENERGY, saddle, 0, stable=True, length=0.5)
    mirrored = np.stack(BALL.reflect(*stacked(unstable)))
    # Rounding may shift points along the line.
    assert np.max(distances(mirrored, stacked(stable))) < 1e-4 * RADIUS


def test_a_stable_branch_comes_to_its_point(saddle):
    branch = stacked(trace_manifold(BALL, ENERGY, saddle, 3, stable=True, length=0.05))
    point, last = branch[:, 0], branch[:, [-1]]
    off = np.sqrt(np.sum((last[:, 0] - point) ** 2))
    for _ in range(6):
        last = mapped(last, 6)
        nearer = np.sqrt(np.sum((last[:, 0] - point) ** 2))
        assert nearer < 0.75 * off
        off = nearer


def test_inner_and_outer_leave_on_opposite_sides(saddle):
    for point in range(6):
        inner, outer = (
            stacked(trace_manifold(BALL, ENERGY, saddle, point, side=side, length=0.001))
            for side in ("inner", "outer")
        )
        a, b = (branch[:, -1] - branch[:, 0] for branch in (inner, outer))
        assert np.sum(a * b) < -0.99 * math.sqrt(np.sum(a * a) * np.sum(b * b))


@pytest.mark.parametrize("side", ["inner", "outer"])
def test_an_inverse_hyperbolic_branch_changes_sides(inverse, side):
    """P^6 maps a branch to the other one, P^12 to itself, by the multiplier's square."""
    multiplier = float(inverse["multiplier"])
    assert multiplier < -2
    other = "outer" if side == "inner" else "inner"
    one, across = (
        stacked(trace_manifold(BALL, ENERGY, inverse, 1, side=s, length=0.5, bend=2.0))
        for s in (side, other)
    )
    off = np.sqrt(np.sum((one - one[:, :1]) ** 2, axis=0))
    near = (off > 2e-6 * RADIUS) & (off < 1e-3 * RADIUS)
    assert near.sum() > 20
    six, twelve = mapped(one[:, near], 6), mapped(one[:, near], 12)
    assert np.max(distances(six, across)) < 1e-5 * RADIUS
    assert np.max(distances(twelve, one)) < 1e-5 * RADIUS
    first = off[near] < 1e-5 * RADIUS
    grown = np.sqrt(np.sum((twelve[:, first] - one[:, :1]) ** 2, axis=0)) / off[near][first]
    assert grown == pytest.approx(multiplier**2, rel=1e-3)


def window_around(saddle, point, size):
    x, v = float(saddle["x"][point]), float(saddle["xdot"][point])
    return (x - size, x + 0.7 * size, v - 0.8 * size, v + size)


def test_a_window_keeps_what_passes_through_it(saddle):
    """It keeps all of the branch inside it, and otherwise only ends of sides that enter it."""
    window = window_around(saddle, 1, 0.02)
    fine = {"distance": 2e-4, "bend": 2.0, "length": 1.0}
    whole = stacked(trace_manifold(BALL, ENERGY, saddle, 0, side="inner", **fine))
    seen = trace_manifold(
        BALL, ENERGY, saddle, 0, side="inner", length=1.0, distance=0.01, bend=2.0, window=window
    )
    points = stacked(seen)

    def inside(line):
        low, high = np.array(window[::2])[:, None], np.array(window[1::2])[:, None]
        return np.all((line[:2] >= low) & (line[:2] <= high), axis=0)

    there = whole[:, inside(whole)]
    assert there.shape[1] > 100
    assert np.max(distances(there, points)) < 2e-4 * 0.02
    shown = ~np.isnan(points[0])
    near = inside(points) | np.append(inside(points)[1:], False)
    near |= np.append(False, inside(points)[:-1])
    crossing = ~near & shown  # ends of sides whose box meets the window
    assert crossing.sum() <= 0.05 * shown.sum()
    sides = np.diff(points[:2], axis=1) / np.array([[0.034], [0.036]])
    both = inside(points)[1:] & inside(points)[:-1]
    assert np.nanmax(np.sqrt(np.sum(sides**2, axis=0))[both]) <= 0.01


def test_a_window_beside_the_branch_is_empty(saddle):
    centre, radius = BALL.section(ENERGY)
    window = (centre + 2 * radius, centre + 3 * radius, 0.0, 0.1)
    branch = trace_manifold(BALL, ENERGY, saddle, length=0.3, window=window)
    assert branch.sizes["vertex"] == 0


def test_a_window_shows_branches_of_all_saddles(orbits):
    found = manifolds.scene_manifolds(
        BALL, ENERGY, orbits, 6, "hyperbolic", {"distance": 0.02, "bend": 10},
        point=0, window={"x": [-0.01, 0.01], "xdot": [-0.01, 0.01]}, length=0.3,
    )  # fmt: skip
    assert found.sizes["branch"] == 24
    assert int(found["row_size"].sum()) == found.sizes["vertex"]
    own = (found["saddle"].values == 0) & (found["row_size"].values > 0)
    assert own.sum() == 4
    assert found.attrs["window_x"][0] < found.attrs["point_x"] < found.attrs["window_x"][1]


def test_a_branch_is_interrupted_where_the_map_jumps(saddle):
    """The outer branch meets the curve where the previous flight nearly touched the floor."""
    branch = trace_manifold(BALL, ENERGY, saddle, 0, side="outer", length=8.0)
    points = stacked(branch)
    (gaps,) = np.nonzero(np.isnan(points[0]))
    assert gaps.size > 0
    apart = np.sqrt(np.sum((points[:, gaps + 1] - points[:, gaps - 1]) ** 2, axis=0)) / RADIUS
    assert np.all(apart > 1e-6)
    wide = apart > 0.05
    assert wide.any()
    # Some impacts before a wide jump both ends were one state.
    for gap in gaps[wide]:
        ends = points[:, [gap - 1, gap + 1]]
        history = [ends]
        for _ in range(12):
            back = np.stack(BALL.inverse_impact(*history[-1])[:3])
            history.append(back)
        spread = [np.max(np.abs(a[:, 0] - a[:, 1])) for a in history]
        assert min(spread) < 1e-3 * RADIUS
    steps = sides_of(points) / RADIUS
    assert np.nanmax(steps) <= 0.01 + 1e-12


def test_no_jumps_below_their_onset():
    orbit = of_type(symmetric_orbits(BALL, 0.0017, 10), "hyperbolic")
    branch = trace_manifold(BALL, 0.0017, orbit, side="outer", length=3.0)
    assert not np.any(np.isnan(branch["x"].values))


def test_the_papers_saddle_is_not_weak(saddle, weak):
    assert float(saddle["multiplier"]) > rule.WEAK > float(weak["multiplier"]) > 1


def test_a_weak_branch_needs_few_vertices(weak):
    radius = BALL.section(0.001)[1]
    for side in ("inner", "outer"):
        branch = trace_manifold(BALL, 0.001, weak, side=side, length=0.5)
        points = stacked(branch)
        sides = sides_of(points) / radius
        assert sides.max() <= 0.01
        assert sides.sum() == pytest.approx(0.5, abs=0.02)
        assert branch.sizes["vertex"] < 4000  # 14,000 and 47,000 if mapped from the segment
        assert "ended" not in branch.attrs


def test_a_weak_branch_is_mapped_into_itself(weak):
    """The error is that of the sides, on the whole way beyond the next saddle."""
    radius = BALL.section(0.001)[1]
    branch = stacked(trace_manifold(BALL, 0.001, weak, side="outer", length=0.5, bend=2.0))
    travelled = np.concatenate([[0.0], np.cumsum(sides_of(branch))]) / radius
    some = branch[:, (travelled > 1e-4) & (travelled < 0.35)][:, ::3]
    assert np.max(distances(mapped(some, 10), branch)) < 5e-5 * radius


@pytest.mark.parametrize("energy", [0.001, 0.0012])
def test_a_weak_branch_is_as_accurate_as_documented(energy):
    orbit = of_type(symmetric_orbits(BALL, energy, 10), "hyperbolic")
    radius = BALL.section(energy)[1]
    for side in ("inner", "outer"):
        branch = stacked(trace_manifold(BALL, energy, orbit, side=side, length=0.5))
        fine = {"length": 0.52, "distance": 0.001, "bend": 1.0}
        line = stacked(trace_manifold(BALL, energy, orbit, side=side, **fine))
        assert np.max(distances(branch[:, :-2], line)) < 2e-6 * radius


def test_mapping_images_and_mapping_the_segment_give_one_line(saddle, monkeypatch):
    """Both ways are accurate at the paper's saddle, treated as if it were weak."""
    for side, length in (("inner", 0.8), ("outer", 0.6)):
        how = {"side": side, "length": length, "distance": 0.005, "bend": 3.0}
        exact = stacked(trace_manifold(BALL, ENERGY, saddle, **how))
        with monkeypatch.context() as patch:
            patch.setattr(rule, "WEAK", 3.0)
            one = trace_manifold(BALL, ENERGY, saddle, **how)
        assert "ended" not in one.attrs
        off = distances(stacked(one)[:, :-2], exact)  # one line may be longer by a vertex
        assert np.max(off) < 1e-5 * RADIUS


def test_a_branch_ends_where_rounding_takes_over():
    """At E = 0.0008 rounding errors hide the inner branches beyond the next saddle."""
    orbit = of_type(symmetric_orbits(BALL, 0.0008, 10), "hyperbolic")
    radius = BALL.section(0.0008)[1]
    branch = trace_manifold(BALL, 0.0008, orbit, side="inner", length=0.5)
    points = stacked(branch)
    assert branch.attrs["ended"] == pytest.approx(np.sum(sides_of(points)) / radius, rel=1e-3)
    assert branch.attrs["ended"] < 0.2
    others = np.stack([orbit[name].values for name in NAMES])[:, 1:]
    gaps = np.sqrt(np.sum((others - points[:, [-1]]) ** 2, axis=0))
    assert gaps.min() < 1e-4 * radius


def test_a_branch_of_too_many_images_is_rejected(weak, monkeypatch):
    monkeypatch.setattr(rule, "MOST_IMAGES", 20)
    with pytest.raises(ValueError, match=r"27 images, .* 1\.34235"):
        trace_manifold(BALL, 0.001, weak, length=0.5)


def test_an_elliptic_orbit_is_rejected(orbits):
    with pytest.raises(ValueError, match="elliptic"):
        trace_manifold(BALL, ENERGY, of_type(orbits, "elliptic"))


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        ({"saddle": 6}, "saddle = 6 .* from 0 to 5"),
        ({"length": 0.0}, "length = 0.0"),
        ({"distance": -1.0}, "distance = -1.0"),
        ({"bend": 180.0}, "bend = 180.0"),
    ],
)
def test_arguments_out_of_range_are_rejected(saddle, fields, message):
    with pytest.raises(ValueError, match=message):
        trace_manifold(BALL, ENERGY, saddle, **fields)


def test_another_energy_is_rejected(saddle):
    with pytest.raises(ValueError, match=r"energy = 0\.02 .* 0\.01"):
        trace_manifold(BALL, 0.02, saddle)
