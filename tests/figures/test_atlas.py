"""The atlas: what is drawn is what was computed, where it belongs."""

import numpy as np
import pytest
import xarray as xr

from pseudorigid.dynamics import fixed_point
from pseudorigid.figures import atlas
from pseudorigid.figures.axes import raster
from pseudorigid.figures.canvas import render, style
from pseudorigid.sweep import cell

PLANE = {"k": [0.1, 0.2, 0.3], "energy": [0.1, 1.0, 10.0, 100.0], "starts": 9, "impacts": 100}
# The lower ends of the two panels of PLANE.
LOWER = 320
UPPER = LOWER + 3 * (atlas.HIGH // 3) + 195
LINE = {"k": [0.2], "g": 0.04, "energy": [0.625 * i for i in range(1, 21)]}


def dataset(sweep, **given):
    shape = (len(sweep["k"]), len(sweep["energy"]))
    values = {name: np.full(shape, 0.5) for name in cell.VARIABLES if name != "chains"} | given
    data = {
        name: (("k", "energy"), np.broadcast_to(value, shape)) for name, value in values.items()
    }
    return xr.Dataset(data, coords={"k": sweep["k"], "energy": sweep["energy"]})


def commonest(image, across, up):
    """The commonest colour around a pixel, counted from the lower left."""
    patch = image[::-1][up - 12 : up + 13, across - 12 : across + 13].reshape(-1, 3)
    colors, counts = np.unique(patch, axis=0, return_counts=True)
    return "#" + "".join(f"{part:02x}" for part in colors[counts.argmax()])


def colours(name):
    """Those of a scale, as #rrggbb."""
    return ["#" + bytes(row).hex() for row in raster.palette(name)]


def test_a_cell_has_the_colour_of_its_value():
    share = np.linspace(0, 0.99, 12).reshape(3, 4)
    exponent = np.where(share > 0.9, np.nan, 0.4 * share)
    image = render.pixels(atlas.plane(PLANE, dataset(PLANE, regular=share, exponent=exponent)))
    scale = colours("viridis")
    width, height = atlas.WIDE / 4, atlas.HIGH // 3
    for row in range(3):
        for column in range(4):
            at = int(atlas.LEFT + (column + 0.3) * width), int(UPPER + (row + 0.3) * height)
            assert commonest(image, *at) == scale[int(share[row, column] * 64)]
    at = int(atlas.LEFT + 3.3 * width), int(LOWER + 2.3 * height)
    assert commonest(image, *at) == style.GRID  # no sea


def test_cells_fill_whole_pixels():
    """Where no curve is."""
    sweep = PLANE | {"energy": list(np.arange(101, 261) / 10), "k": list(np.arange(1, 101) / 5000)}
    share = np.random.default_rng(1).random((100, 160))
    image = render.pixels(atlas.plane(sweep, dataset(sweep, regular=share)))[::-1]
    scale = colours("viridis")
    upper = LOWER + 600 + (UPPER - LOWER - 3 * (atlas.HIGH // 3))
    for row in range(100):
        for column in range(0, 160, 7):
            x, y = atlas.LEFT + 5 * column, upper + 6 * row
            patch = image[y + 2 : y + 4, x + 2 : x + 4].reshape(-1, 3)
            wanted = scale[int(share[row, column] * 64)]
            assert all("#" + bytes(pixel).hex() == wanted for pixel in patch)


def test_values_beyond_the_scale_have_the_colours_of_its_ends():
    share = np.full((3, 4), -0.2)
    share[1] = 1.7
    image = render.pixels(atlas.plane(PLANE, dataset(PLANE, regular=share)))
    scale = colours("viridis")
    height = atlas.HIGH // 3
    at = int(atlas.LEFT + 0.3 * atlas.WIDE / 4), int(UPPER + 0.3 * height)
    assert commonest(image, *at) == scale[0]
    assert commonest(image, at[0], at[1] + height) == scale[-1]


def test_the_scales_are_sixty_four_colours_in_order():
    for name in ("viridis", "magma"):
        assert len(set(colours(name))) == 64
        light = raster.palette(name).sum(axis=1, dtype=int)
        assert light[0] < light[20] < light[40] < light[63]


def test_a_resonance_is_drawn_where_the_closed_form_has_it():
    figure = atlas.plane(PLANE, dataset(PLANE))
    k = 0.2
    e = fixed_point.resonance(k, 1, 6)
    across = atlas.LEFT + (np.log10(e) + 1.5) / 4 * atlas.WIDE
    up = UPPER + (k - 0.05) / 0.3 * 3 * (atlas.HIGH // 3)
    image = render.pixels(figure)[::-1]
    patch = image[int(up) - 3 : int(up) + 4, int(across) - 3 : int(across) + 4].reshape(-1, 3)
    assert patch.sum(axis=1).max() > 700
    away = image[int(up) - 3 : int(up) + 4, int(across) - 40 : int(across) - 33].reshape(-1, 3)
    assert away.sum(axis=1).max() < 700


def drawn(figure, color, dots):
    """Pixels (n, 2) of each artist in this colour: dots, or lines."""
    parts = [a for a in figure.artists if color in (a.get_color(), a.get_markerfacecolor())]
    parts = [a for a in parts if (a.get_marker() == "o") == dots]
    return [np.column_stack(a.get_data()) * figure.dpi for a in parts]


def test_the_line_is_drawn_with_its_bars_and_gaps():
    """Shares from 0 to 1 in pixels 635 to 1145, exponents to 1.02 of the largest in 135 to 545."""
    n = len(LINE["energy"])
    share = np.linspace(0.9, 0.1, n)
    value = np.where(np.arange(n) < 3, np.nan, np.linspace(0.1, 0.2, n) + 0.01 * (np.arange(n) % 2))
    given = {"regular": share, "regular_low": share - 0.05, "regular_high": share + 0.08}
    given |= {"exponent": value, "exponent_low": value - 0.04, "exponent_high": value + 0.05}
    figure = atlas.line(LINE, dataset(LINE, **given, exponent_error=0.01))
    energy = np.array(LINE["energy"]) * 0.04**2
    across = 110 + 900 * energy / (1.02 * energy[-1])

    def places(at, heights):
        return pytest.approx(np.column_stack([at, heights]), abs=0.3)

    blue, red = style.BLUE, style.VERMILION
    assert max(drawn(figure, blue, True), key=len) == places(across, 635 + 510 * share)
    bars = np.concatenate(drawn(figure, blue, False))
    ends = np.ravel(np.column_stack([share - 0.05, share + 0.08]))
    assert bars == places(np.repeat(across, 2), 635 + 510 * ends)
    height = 410 / (1.02 * (np.nanmax(value) + 0.05))
    (dots,) = drawn(figure, red, True)
    assert dots == places(across[3:], 135 + height * value[3:])
    for color, low, high in ((red, -0.0196, 0.0196), (style.pale(red), -0.04, 0.05)):
        bars = np.concatenate([line for line in drawn(figure, color, False) if len(line) == 2])
        ends = np.ravel(np.column_stack([value[3:] + low, value[3:] + high]))
        assert bars == places(np.repeat(across[3:], 2), 135 + height * ends)


def test_no_sea_anywhere_can_be_drawn():
    nothing = dict.fromkeys(("exponent", "exponent_low", "exponent_high"), np.nan)
    wide = PLANE | {"k": [0.1, 0.9], "energy": [-0.4, 0.2]}  # whose edges go beyond k = 0
    for sweep, draw in ((PLANE, atlas.plane), (wide, atlas.plane), (LINE, atlas.line)):
        draw(sweep, dataset(sweep, **nothing))


@pytest.mark.parametrize(
    ("low", "high", "count", "wanted"),
    [
        (0, 1, 5, [0, 0.5, 1]),
        (0, 0.03, 8, [0, 0.005, 0.01, 0.015, 0.02, 0.025, 0.03]),
        (0.012, 0.332, 5, [0.1, 0.2, 0.3]),
        (-2.5, 37, 5, [0, 10, 20, 30]),
    ],
)
def test_ticks_are_round(low, high, count, wanted):
    assert raster.ticks(low, high, count) == wanted


def test_minor_ticks_lie_between():
    assert raster.between([0.0, 0.5, 1.0], 0.0, 1.2) == [0.25, 0.75]
    assert raster.between([0.1, 0.2], 0.02, 0.28) == pytest.approx([0.05, 0.15, 0.25])
    assert raster.between([0.1], 0.02, 0.28) == []
    places = raster.decades(-1.1, 0.4)
    assert 10 ** np.array(places) == pytest.approx([0.08, 0.09, *np.arange(2, 10) / 10, 2.0])


def test_names_that_would_touch_are_moved_apart():
    assert atlas._apart([100.0, 300.0]) == [100.0, 300.0]
    left, right = atlas._apart([100.0, 110.0])
    assert right - left == atlas._NAME
    assert left + right == 210.0


def test_the_quotation_is_the_papers():
    text = " ".join(atlas.QUOTATION)
    quoted = "appear to be progressively destroyed as the total energy increases"
    assert f"“{quoted}”" in text


def test_edges_lie_halfway():
    assert raster.edges(np.array([1.0, 2.0, 4.0])).tolist() == [0.5, 1.5, 3.0, 5.0]
    assert raster.edges(np.array([1.0])).tolist() == [0.5, 1.5]
