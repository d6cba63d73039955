"""The paper's kinds of picture show all of the data, in the right order, and nothing else."""

import numpy as np
import pytest

from helpers.keys import texts
from helpers.samples import (
    ATTRS,
    FLAT,
    SCENES,
    drawn,
    exponents,
    manifolds,
    module,
    motion,
    states,
    window,
)
from helpers.slowly import slowly
from paper.figures import tangle
from pseudorigid import Ball
from pseudorigid.dynamics.orbits import scene_orbits
from pseudorigid.dynamics.variables import rows, states_of
from pseudorigid.figures.axes import box, direction
from pseudorigid.figures.canvas import sheet, style


def test_curves_of_a_motion_touch_at_the_impacts_and_never_cross():
    curves = [line.get_data() for line in drawn("motion").artists if len(line.get_xdata()) > 20]
    (t, mass), (other_t, strain) = curves
    vertices = [set(zip(*(axis.tolist() for axis in curve), strict=True)) for curve in curves]
    assert len(vertices[0] & vertices[1]) == motion().sizes["impact"]
    slack = 1 / 32 / style.DPI  # two lines, each within 1/64 of a pixel of its samples
    assert (mass >= np.interp(t, other_t, strain) - slack).all()
    assert (np.interp(other_t, t, mass) >= strain - slack).all()


def test_all_visible_points_are_drawn_and_the_sea_comes_first():
    data = scene_orbits(Ball(k=0.2, g=0.04), 0.01, [0.1, -0.2, 0.6], [300, 200, 900])
    seen = box.Box(SCENES["portrait"]).seen(states_of(data))
    figure = module("portrait").draw(SCENES["portrait"], data)
    dots = [line for line in figure.artists if line.get_marker() == "o"]
    dots = dots[-len(data["row_size"]) :]  # the key's come before
    sizes = [np.sum(seen[span]) for span in rows(data)]
    assert [len(line.get_xdata()) for line in dots] == [sizes[2], sizes[0], sizes[1]]
    assert [line.get_color() for line in dots] == [style.SEA, *style.ordered(2)]
    assert 0 < np.sum(seen) < seen.size


@pytest.mark.parametrize("degrees", [0, 30, 40, 90, 115, 180, 270, -65, 1e-3, 359.999, 12345.678])
def test_sine_and_cosine_of_the_view_are_correctly_rounded(degrees):
    mpmath = pytest.importorskip("mpmath")
    with mpmath.workdps(50):
        angle = mpmath.mpf(degrees) * mpmath.pi / 180
        exact = float(mpmath.sin(angle)), float(mpmath.cos(angle))
    assert direction.sincos_degrees(degrees) == pytest.approx(exact, rel=0, abs=1e-40)


def test_snapped_pixels_keep_their_distance_from_every_threshold():
    snapped = sheet.snap_to_pixels(np.random.default_rng(6).uniform(0, 1500, 10000))
    for step in (1 / 256, 1 / 2, 1):
        part = snapped / step % 1
        assert np.minimum(part, 1 - part).min() * step >= 0.2 / 256
    points = snapped * 72 / style.DPI * 1e6
    assert np.abs(points % 1 - 0.5).min() > 0.1


def test_what_lies_outside_the_box_is_not_drawn():
    small = box.Box(SCENES["portrait"] | {"axes": FLAT})
    before = len(small.figure.artists)
    x = np.array([0.0, 0.1, 0.9, 0.1, 0.0, 0.1])
    y, z = 0 * x - 0.05, 0 * x + 0.24  # above the surface, so that nothing is behind it
    small.points(np.array([x, y, z]), style.BLUE, 1)
    small.line(np.array([x, y, z]), style.BLUE, 1)
    sizes = [len(artist.get_xdata()) for artist in small.figure.artists[before:]]
    assert sizes == [5, 2, 3]


@pytest.mark.parametrize("azimuth", [115, 205, *slowly(25, 295)])
def test_the_surface_hides_what_a_dense_cloud_of_it_covers(azimuth):
    """A point is hidden if points of the cloud before it fall on its square of pixels."""
    scene = SCENES["portrait"] | {"view": {"elevation": 40, "azimuth": azimuth}}
    picture = box.Box(scene)
    cloud = np.array([*states(400_000, 7).values()])
    some = cloud[:, :2000]
    towards = np.array(picture.view.eye)
    squares = [*map(tuple, np.floor(np.array(picture.view(cloud)) / 8).astype(int).T)]
    front = {}
    for square, depth in zip(squares, towards @ cloud, strict=True):
        front[square] = max(front.get(square, -1.0), depth)
    before = np.array([front[square] for square in squares[:2000]]) - towards @ some
    seen = picture.seen(some)
    assert before[seen].max() < 0.1  # as far as the surface rises within a square
    assert np.mean(before[~seen] > 0.0) > 0.99  # except for squares across the outline
    assert np.sum(before[~seen] > 0.1) > 5


def test_impacts_graze_on_the_rim_which_ends_the_outline():
    picture = box.Box(SCENES["portrait"])
    x, y, z = picture.surface.rim()
    assert np.array_equal(y, -z)
    k, g, energy = (ATTRS[name] for name in ("k", "g", "energy"))
    assert np.allclose((y * y + k * z * z + k * x * x) / 2 - g * x, energy, rtol=0, atol=1e-15)
    around = picture.surface.outline(picture.view)
    x, y, z = around[:, ~np.isnan(around[0])]
    assert np.all(y + z >= 0.0) and np.min(y + z) < 0.01
    assert np.allclose((y * y + k * z * z + k * x * x) / 2 - g * x, energy, rtol=0, atol=1e-15)
    normal = np.array([k * x - g, y, k * z])
    assert np.max(np.abs(picture.view.eye @ normal)) < 1e-15 and 0 < x.size < around.shape[1]


def test_ends_have_open_dots_and_jumps_squares():
    figure, data = drawn("tangle"), manifolds()
    picture = box.Box(SCENES["tangle"])
    seen = picture.seen(states_of(data))
    ends, jumps = np.cumsum(data["row_size"].values) - 1, [99, 103]  # jumps: beside the gap
    assert np.flatnonzero(tangle._jumps(data)).tolist() == jumps
    marks = {"o": 0, "s": 0}
    for artist in figure.artists:
        small = artist.get_markersize() < 3  # not the rings around saddles
        if small and artist.get_markerfacecolor() == "white" and artist.get_markeredgewidth():
            marks[artist.get_marker()] += len(artist.get_xdata())
    in_key = sum(a.get_markersize() == 3.2 and a.get_markerfacecolor() == "white"
                 and a.get_marker() == "s" for a in figure.artists)  # fmt: skip
    assert marks == {"o": seen[ends].sum(), "s": seen[jumps].sum()}
    assert in_key == bool(seen[jumps].any())
    assert ("jump" in texts(figure)) == bool(seen[jumps].any())


def test_the_saddle_is_in_the_key_and_the_upper_panel_has_an_abscissa():
    assert "saddle" in texts(drawn("closeup"))
    axes = SCENES["exponents"]["axes"] | {"largest": {"limits": [0.2, 0.25], "ticks": [0.23]}}
    figure = module("exponents").draw(SCENES["exponents"] | {"axes": axes}, exponents())
    assert {"0.5", "1.5"} <= {*texts(figure)}  # labels of the upper panel alone


@pytest.mark.parametrize("shift", [0.0, 1e-7, 3e-5])
def test_branches_that_coincide_are_both_seen(shift):
    """The stable one is thick and lies below, unless it is seen beside the other."""
    data, unstable = window(), slice(0, 500)
    data["x"][500:], data["xdot"][500:] = data["x"][unstable], data["xdot"][unstable] + shift
    figure = module("closeup").draw(SCENES["closeup"], data)
    lines = [line for line in figure.artists if line.get_clip_box() is not None]
    widths = {line.get_color(): line.get_linewidth() for line in lines}
    if shift > 1e-6:
        assert widths == {style.UNSTABLE: 0.5, style.STABLE: 0.5}
    else:
        assert [*widths] == [style.STABLE, style.UNSTABLE]
        assert widths[style.STABLE] > 2 * widths[style.UNSTABLE]


def test_a_sharp_fold_is_marked_unless_a_line_goes_on_or_ends_there():
    reach = tangle._REACH * sheet.POINT
    x = np.concatenate([np.linspace(0.0, 9.0, 91), np.linspace(9.0, 0.0, 91)[1:]]) * reach
    fold = np.array([x, np.where(np.arange(181) > 90, 0.1 * reach, 0.0)])
    assert tangle._tips(fold, fold) == [90]
    beyond = np.array([[9.6 * reach, 10.0 * reach], [0.0, 0.0]])
    assert tangle._tips(fold, np.append(fold, beyond, axis=1)) == []
    for part in (fold[:, 82:], fold[:, :99]):  # nearer to an end than the reach
        assert tangle._tips(part, part) == []
    gap = np.full((2, 1), np.nan)
    assert tangle._tips(np.append(gap, fold, axis=1), fold) == [91]
    bend = np.array([np.minimum(np.arange(181), 90.0), np.maximum(np.arange(181) - 90.0, 0.0)])
    assert tangle._tips(0.1 * reach * bend, bend) == []
