"""The pictures of sweeps show what was computed, where it belongs."""

import numpy as np
import pytest
import xarray as xr

from extensions.atlas import cell
from extensions.atlas.figures import atlas
from extensions.atlas.sweep import resonances
from helpers.examples import assert_decided
from helpers.legible import assert_legible
from helpers.readable import assert_readable
from pipeline.checks.captions import caption_of
from pipeline.checks.quantities import facts
from pseudorigid.dynamics import fixed_point
from pseudorigid.figures.axes import raster
from pseudorigid.figures.canvas import render, style

PLANE = {"k": [0.1, 0.2, 0.3], "energy": [0.1, 1.0, 10.0, 100.0]}
WIDTH, HEIGHT = atlas.WIDE / 4, atlas.HIGH // 3  # pixels of a cell of PLANE
# The lower ends of the two panels of PLANE.
LOWER = 320
UPPER = LOWER + 3 * HEIGHT + 225
LINE = {"k": [0.2], "g": 0.04, "energy": [0.625 * i for i in range(1, 21)]}


def dataset(sweep, **given):
    """Return the dataset of a sweep with 0.5 in each variable that is not given."""
    shape = (len(sweep["k"]), len(sweep["energy"]))
    values = {name: np.full(shape, 0.5) for name in cell.VARIABLES if name != "chains"} | given
    data = {
        name: (("k", "energy"), np.broadcast_to(value, shape)) for name, value in values.items()
    }
    data = xr.Dataset(data, coords={"k": sweep["k"], "energy": sweep["energy"]})
    return data.assign(resonances(sweep["k"]) | {"exponent_95": 1.96 * data["exponent_error"]})


def image_of(sweep, **given):
    """Return the pixels of a plane, from the lower left."""
    return render.pixels(atlas.plane(sweep, dataset(sweep, **given)))[::-1]


def around(image, x, y, reach):
    """Return the pixels (n, 3) around a place."""
    x, y = int(x), int(y)
    return image[y - reach : y + reach + 1, x - reach : x + reach + 1].reshape(-1, 3)


def colours(name):
    return ["#" + bytes(row).hex() for row in raster.palette(name)]


def test_cells_have_the_colours_of_their_values_and_a_resonance_its_curve():
    """The curve is where the closed form has it."""
    share = np.linspace(-0.2, 0.99, 12).reshape(3, 4)
    share[1, 1] = 1.7
    exponent = np.where(share > 0.9, np.nan, 0.4 * share)
    of_root = np.sqrt(np.maximum(exponent, 0.0) / np.nanmax(exponent))
    image, scale = image_of(PLANE, regular=share, exponent=exponent), colours("viridis")

    def commonest(row, column, bottom):
        place = atlas.LEFT + (column + 0.3) * WIDTH, bottom + (row + 0.3) * HEIGHT  # no curve there
        colors, counts = np.unique(around(image, *place, 12), axis=0, return_counts=True)
        return "#" + bytes(colors[counts.argmax()]).hex()

    for row, column in np.ndindex(3, 4):
        wanted = scale[min(max(int(share[row, column] * 64), 0), 63)]
        assert commonest(row, column, UPPER) == wanted
        if (shade := of_root[row, column]) >= 0.0:
            assert commonest(row, column, LOWER) == colours("magma")[min(int(shade * 64), 63)]
    assert commonest(2, 3, LOWER) == style.GRID  # no sea
    across = atlas.LEFT + (np.log10(fixed_point.resonance(0.2, 1, 6)) + 1.5) / 4 * atlas.WIDE
    up = UPPER + (0.2 - 0.05) / (1 / 3 - 0.05) * 3 * HEIGHT  # from a cell's edge to a shell
    for shift, drawn in ((0, True), (-37, False)):
        assert (around(image, across + shift, up, 3).sum(axis=1).max() > 700) == drawn


def drawn(figure, color, dots):
    """Return the pixels (n, 2) of each artist in this colour: dots, or lines."""
    parts = [a for a in figure.artists if color in (a.get_color(), a.get_markerfacecolor())]
    parts = [a for a in parts if (a.get_marker() == "o") == dots]
    return [np.column_stack(a.get_data()) * figure.dpi for a in parts]


def test_the_line_is_drawn_with_its_bars_and_gaps():
    """Shares 0 to 1 are at pixels 635 to 1145, exponents to 1.02 of the largest at 135 to 545."""
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

    blue, pale = style.BLUE, style.pale(style.BLUE)
    upper, dots = sorted(drawn(figure, blue, True), key=len, reverse=True)[:2]
    assert upper == places(across, 635 + 510 * share)
    bars = np.concatenate([line for line in drawn(figure, blue, False) if line[0, 1] > 600])
    ends = np.ravel(np.column_stack([share - 0.05, share + 0.08]))
    assert bars == places(np.repeat(across, 2), 635 + 510 * ends)
    height = 410 / (1.02 * (np.nanmax(value) + 0.05))
    assert dots == places(across[3:], 135 + height * value[3:])
    for color, low, high in ((blue, -0.0196, 0.0196), (pale, -0.04, 0.05)):
        lines = [line for line in drawn(figure, color, False) if line[:, 1].max() < 600]
        bars = np.concatenate([line for line in lines if len(line) == 2])
        ends = np.ravel(np.column_stack([value[3:] + low, value[3:] + high]))
        assert bars == places(np.repeat(across[3:], 2), 135 + height * ends)


@pytest.mark.slow
def test_a_sweep_without_a_sea_can_be_drawn():
    nothing = dict.fromkeys(("exponent", "exponent_low", "exponent_high"), np.nan)
    wide = PLANE | {"k": [0.1, 0.9], "energy": [-0.4, 0.2]}  # the edges of cells pass k = 0
    long = LINE | {"energy": [0.625 * i for i in range(1, 60)]}
    for sweep in (wide, long):
        figure = atlas.draw(sweep, dataset(sweep, **nothing))
    assert_legible(figure)  # names of resonances that would touch are moved apart
    assert_readable(atlas.draw(PLANE, dataset(PLANE)))


@pytest.mark.parametrize(("sweep", "k", "energy"), [
    ({"k": [0.03, 0.2, 0.3], "energy": [0.2, 1.0, 2.0]}, (0, 1 / 3), (-0.2, 2.5)),
    ({"k": [0.02, 0.3], "energy": [-1.5, 4.0]}, (0, 1 / 3), (-0.5 / 0.3, 6.75)),
    ({"k": [0.1, 0.11], "g": 0.01, "energy": [1.0, 395.0]}, (0.095, 0.115), (None, 400)),
    ({"k": [0.2, 0.9], "energy": [1.0, 2.0]}, (0, 1), (0.5, 2.5)),
])  # fmt: skip
def test_cells_end_halfway_between_values_and_where_no_ball_is(sweep, k, energy):
    figure = atlas.sheet_above(LOWER, sweep)
    values = np.full((len(sweep["k"]), len(sweep["energy"])), 0.5)
    panel = atlas.cells(figure, LOWER, sweep, values, 1.0, "viridis", "")
    assert panel.up.limits == pytest.approx(k)
    ends = np.array(panel.across.limits)
    ends = 10.0**ends if panel.across.decades else ends
    assert ends[1] == pytest.approx(energy[1])
    assert energy[0] is None or ends[0] == pytest.approx(energy[0])
    image, _ = figure.figure.images  # and the colour scale
    left, bottom, right, top = panel.frame
    assert image.get_array().shape[:2] == (top - bottom, right - left)


def test_the_key_of_a_plane_has_what_is_drawn():
    high = {"k": [0.1, 0.2, 0.3], "energy": [4.0, 5.0]}
    words = [text.get_text() for text in atlas.plane(high, dataset(high)).texts]
    assert not any("no chaotic" in text or "Figure" in text or "jumps" in text for text in words)
    low = {"k": [0.15, 0.25], "energy": [0.5, 0.8]}
    data = dataset(low, exponent=np.nan)
    words = [text.get_text() for text in atlas.plane(low, data).texts]
    assert any("no chaotic" in text for text in words) and "the paper's Figure 8" in words


@pytest.mark.parametrize(("sweep", "given", "said", "unsaid"), [
    (LINE, {"regular_low": 0.4, "regular_high": 0.6},
     ["Dotted lines", "is 1/5 to 1/8.", "The dashed line", "Circles are the paper's two"],
     ["rises with", "grey", "1/10"]),
    ({"k": [0.1, 0.2, 0.3], "energy": [4.0, 5.0]},
     {"regular_low": [0.1, 0.8], "regular_high": [0.2, 0.9]},
     ["in places the regular share (a) rises", "Solid curves"],
     ["grey", "ircle", "begins to jump"]),
    ({"k": [0.15, 0.25], "energy": [0.5, 0.8]}, {"exponent": np.nan},
     ["A grey cell", "The circle is one of"], ["Circles", "rises with"]),
])  # fmt: skip
def test_the_caption_has_what_is_drawn(sweep, given, said, unsaid):
    block = sweep | {"picture": "atlas", "starts": 9, "impacts": 100}
    caption = caption_of("a", block, facts(block, {"sweep": dataset(sweep, **given)}))
    assert_decided(caption)
    text = " ".join(caption[2:])
    assert all(words in text for words in said) and not any(words in text for words in unsaid)
