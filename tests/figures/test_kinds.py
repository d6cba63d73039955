"""What the kinds of picture show: all of the data, in the right order, and nothing else."""

import numpy as np
import pytest
import xarray as xr
from samples import ATTRS, DATA, FLAT, SCENES, SPACE, VIEW, draw, motion, orbits

from pseudorigid.figures.axes import box, projection
from pseudorigid.figures.canvas import sheet, style


def test_refuses_what_the_data_do_not_have():
    from pseudorigid.figures.kinds import portrait, tangle

    with pytest.raises(ValueError, match=r"sea \[7\]"):
        portrait.draw(SCENES["portrait"] | {"sea": [7]}, orbits())
    with pytest.raises(ValueError, match="no inverse hyperbolic orbit"):
        tangle.draw(SCENES["tangle"] | {"type": "inverse hyperbolic"}, *DATA["tangle"]())
    with pytest.raises(ValueError, match="elevation 90"):
        portrait.draw(SCENES["portrait"] | {"view": {"elevation": 90, "azimuth": 0}}, orbits())
    with pytest.raises(KeyError, match="udot"):
        portrait.draw(SCENES["portrait"], orbits().drop_vars("udot"))


def test_curves_of_a_motion_touch_at_the_impacts_and_never_cross():
    curves = [line.get_data() for line in draw("motion").artists if len(line.get_xdata()) > 20]
    (t, mass), (other_t, strain) = curves
    vertices = [set(zip(*(axis.tolist() for axis in curve), strict=True)) for curve in curves]
    assert len(vertices[0] & vertices[1]) == motion().sizes["impact"]
    seen = 1 / 32 / style.DPI  # two lines, each within 1/64 of a pixel of its samples
    assert (mass >= np.interp(t, other_t, strain) - seen).all()
    assert (np.interp(other_t, t, mass) >= strain - seen).all()


def test_every_point_is_drawn_and_the_sea_comes_first():
    data = orbits()
    dots = [line for line in draw("portrait").artists if line.get_marker() == "o"]
    assert sum(len(line.get_xdata()) for line in dots) == data.sizes["point"]
    colors = [line.get_color() for line in dots]
    full = colors[len(colors) // 2 :]
    assert full == [style.SEA, style.HUES[0], style.HUES[1]]
    assert colors[: len(colors) // 2] == [style.pale(color) for color in full]


def test_projection_is_orthographic_and_fits():
    limits = [span["limits"] for span in SPACE.values()]
    view = projection.Projection(limits, VIEW)
    frame = np.array([view.right, view.up, view.eye])
    assert np.allclose(frame @ frame.T, np.eye(3), atol=1e-15)
    across, up = view.place(10, 20, 300, 400)(*view.corners().T)
    assert across.min() >= 10 - 1e-9
    assert across.max() <= 310 + 1e-9
    assert up.min() >= 20 - 1e-9
    assert up.max() <= 420 + 1e-9


@pytest.mark.parametrize("degrees", [0, 30, 40, 90, 115, 180, 270, -65, 1e-3, 359.999, 12345.678])
def test_sine_and_cosine_of_the_view_are_correctly_rounded(degrees):
    mpmath = pytest.importorskip("mpmath")
    with mpmath.workdps(50):
        angle = mpmath.mpf(degrees) * mpmath.pi / 180
        exact = float(mpmath.sin(angle)), float(mpmath.cos(angle))
    assert projection.sincos_degrees(degrees) == pytest.approx(exact, rel=0, abs=1e-40)


def test_settled_pixels_keep_their_distance_from_every_threshold():
    pixels = sheet.settle(np.random.default_rng(6).uniform(0, 1500, 10000))
    for step in (1 / 256, 1 / 2, 1):
        part = pixels / step % 1
        assert np.minimum(part, 1 - part).min() * step >= 0.2 / 256
    points = pixels * 72 / style.DPI * 1e6
    assert np.abs(points % 1 - 0.5).min() > 0.1


def test_what_lies_outside_the_box_is_not_drawn():
    small = box.Box(SCENES["portrait"] | {"axes": FLAT})
    before = len(small.figure.artists)
    x = np.array([0.0, 0.1, 0.9, 0.1, 0.0, 0.1])
    small.points(x, 0 * x, 0 * x, style.BLUE, 1)
    small.line(x, 0 * x, 0 * x, style.BLUE, 1)
    sizes = [len(artist.get_xdata()) for artist in small.figure.artists[before:]]
    assert sizes == [5, 2, 3]


def test_box_knows_the_far_side():
    seen = box.Box(SCENES["portrait"])
    x = np.array([0.2, 0.2])
    state = {"x": ("point", x), "xdot": ("point", [0.1, -0.1]), "udot": ("point", [0.0, 0.0])}
    towards = xr.Dataset(state, attrs=ATTRS)
    assert seen.facing(towards).tolist() == [True, False]
