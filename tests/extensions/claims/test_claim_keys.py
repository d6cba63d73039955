"""Keys and limits of the pictures of claims follow the data."""

import numpy as np
import pytest
import xarray as xr
from keys import SCENE, colors, texts
from legible import assert_text_is_whole_and_apart
from sections import BALL

from extensions.claims.analyses.control import control
from extensions.claims.analyses.flux import SIDES
from extensions.claims.analyses.rotation import rotation
from extensions.claims.analyses.spread import spread
from extensions.claims.figures import clusters as clusters_figure
from extensions.claims.figures import control as control_figure
from extensions.claims.figures import flux as flux_figure
from extensions.claims.figures import last_curve as last_curve_figure
from extensions.claims.figures import rotation as rotation_figure
from extensions.claims.figures import spread as spread_figure
from pipeline import config
from pipeline.checks.compare import picture
from pseudorigid.dynamics.lyapunov import scene_exponents
from pseudorigid.figures.canvas import style


def residues(values):
    """A dataset of residues of two convergents of two numbers."""
    x, y = np.random.default_rng(1).uniform(-1, 1, (2, 2, 9))
    by_convergent = {"period": [[23.0, 40.0], [17.0, 29.0]], "residue": values}
    return xr.Dataset(
        {"rotation": ("noble", [0.17, 0.18])}
        | {name: (("noble", "convergent"), array) for name, array in by_convergent.items()}
        | {name: (("noble", "point"), array) for name, array in (("x", x), ("y", y))}
    )


def test_the_critical_residue_lies_within_its_axis():
    figure = last_curve_figure.draw(SCENE, residues([[1e-3, 1e-5], [1e-6, 1e-9]]))
    (critical,) = (line for line in figure.artists if line.get_linestyle() == "--")
    assert critical.get_ydata()[0] < 1425 / style.DPI - 0.05


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_hollow_residues_are_explained_if_there_are_any(sign):
    figure = last_curve_figure.draw(SCENE, residues([[1e-3, 1e-5], [1e-6, sign * 1e-9]]))
    assert ("hollow: negative" in texts(figure)) == (sign < 0.0)


def test_a_start_under_regular_that_is_chaotic_is_no_island():
    data = spread(BALL, 0.01, 4, 2000, 4, [-0.2, 0.6], 1024, 4, 100)
    runs = scene_exponents(BALL, 0.01, [0.6], 500, 4)
    figure = spread_figure.draw(SCENE, data, runs)
    assert "Largest exponent in the islands" not in texts(figure)
    assert any("grey: chaotic" in text for text in texts(figure))
    assert style.SEA in colors(figure)
    calm = spread_figure.draw(SCENE, data.isel(island=[0]), runs)
    assert "Largest exponent in the islands" in texts(calm) and style.SEA not in colors(calm)


def test_rotation_at_low_energy_has_no_chaos_in_its_key():
    data = rotation(BALL, -0.003, [-0.0035], 20, 200, (0.1, 0.2), 200)
    figure = rotation_figure.draw(SCENE | {"energy": -0.003}, data)
    assert not {"chaotic", "islands"} & set(texts(figure)) and "regular" in texts(figure)


def test_the_control_at_low_energy_has_no_chaos_in_its_key():
    data = control(BALL, -0.003, [0.05], 10, 400, 5, [0.1], 0.05, 400, 10, 1)
    figure = control_figure.draw(SCENE | {"energy": -0.003}, data)
    assert "chaotic" not in texts(figure) and "regular" in texts(figure)


def test_flux_without_regions_and_lobes_says_why():
    blank = {name: ("side", [np.nan] * 2) for name in ("area", "region")}
    lines = ("outline_x", "outline_y", "branch_x", "branch_y", "crossing_x")
    blank |= {name: (("side", "n"), np.full((2, 9), np.nan)) for name in lines}
    why = {"missing_inner": "a jump of the map cuts it"}
    data = xr.Dataset(blank, coords={"side": list(SIDES)}, attrs=why)
    figure = flux_figure.draw(SCENE, data)
    assert "neither region has an edge that can be drawn" in texts(figure)
    assert "no lobe: a jump of the\nmap cuts it" in texts(figure)
    assert not {style.ORANGE, style.PURPLE} & colors(figure)


def test_a_comparison_says_if_axes_cannot_be_the_same():
    scene = {"picture": "rotation", "energy": -0.003, "energies": [0.001], "starts": 9}
    scene |= {"impacts": 100, "detail": [0.1, 0.2], "detail_impacts": 100}
    document = {"ball": {"k": 0.2, "g": 0.04}, "scenes": {"low": scene}}
    blocks = [config.check(document).scenes["low"]] * 2
    data = rotation(BALL, -0.003, [0.001], 9, 100, (0.1, 0.2), 100)
    assert picture.on_same_axes(blocks, [[data]] * 2)[1] == ", each on its own axes"


def test_rotation_names_the_energies_that_are_drawn_beside_their_lines():
    """The curves fall at once to where the key stands otherwise."""
    place = np.tile(np.linspace(-0.8, 0.9, 40), (3, 1))
    growth = np.where(place < -0.6, 0.0, 1.0)
    growth[2] = 1.0
    growth[2, 0] = 0.0  # one regular start is no line
    turns = 0.3 - 0.02 * np.minimum(1.0, 20.0 * (place + 0.8))
    data = {"energy": [0.01, 0.02, 0.03], "fixed_place": [-0.8] * 3, "fixed_rotation": [0.3] * 3}
    data = {name: ("energy", values) for name, values in data.items()}
    for name, values in (("place", place), ("rotation", turns), ("exponent", growth)):
        data |= {name: (("energy", "start"), values), f"detail_{name}": ("start", values[0])}
    data = xr.Dataset(data, attrs={"impacts": 1000, "detail_impacts": 1000})
    figure = rotation_figure.draw(SCENE, data)
    names = {text.get_text(): text.get_position() for text in figure.texts}
    assert {"$E$ = 0.01", "$E$ = 0.02"} <= names.keys() and "$E$ = 0.03" not in names
    across, up = np.array(names["$E$ = 0.01"]) * style.DPI
    lines = [line for line in figure.artists if line.get_linestyle() == "-"]
    lines = [line for line in lines if line.get_color() == style.MANY_HUES[0]]
    (curve,) = (line for line in lines if len(line.get_xdata()) > 2)
    x, y = curve.get_xydata().T * style.DPI
    assert not ((x > across - 60) & (x < across + 290) & (abs(y - up) < 15)).any()


@pytest.mark.parametrize("cuts", [[0.3, 0.5, 0.8, 1.2], [0.4, 0.5, 0.6, 0.65]])
def test_the_text_of_clusters_stands_beside_its_cut_and_off_the_marks(cuts):
    shape, high = ("cut", "lag", "a", "b"), np.full((4, 1, 2, 2), 0.97)
    data = {
        "bin_edge": ("edge", np.linspace(0, 4, 41)),
        "flights": ("bin", np.arange(40.0)),
        "period": ("cut", 40.0 + np.arange(4)),
    }
    for end, shift in (("", 0), ("_low", -0.01), ("_high", 0.01)):
        data[f"correlation{end}"] = shape, high + shift
        data[f"dependence{end}"] = shape[:3], high[..., 0] + shift
    data = xr.Dataset(data, coords={"cut": cuts, "lag": [1]})
    figure = clusters_figure.draw(SCENE, data)
    assert_text_is_whole_and_apart(figure)
    words = [text for text in figure.texts if text.get_text().startswith("95 %")]
    marks = [line.get_ydata()[0] for line in figure.artists if line.get_marker() in "os^D"]
    for text in words:
        assert min(abs(text.get_position()[1] - y) for y in marks) > 0.1
