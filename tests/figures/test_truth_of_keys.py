"""Names, keys and limits follow the data of a scene, not its config or the shipped scenes."""

import numpy as np
import pytest
import xarray as xr
from legible import assert_text_is_whole_and_apart
from matplotlib.colors import to_hex
from samples import SCENES, SPACE, module, motion
from sections import BALL

from pipeline.checks.compare import picture
from pseudorigid import Ball
from pseudorigid.analyses.control import control
from pseudorigid.analyses.families import families
from pseudorigid.analyses.flux import SIDES
from pseudorigid.analyses.rotation import chaotic_orbits, rotation
from pseudorigid.analyses.spread import spread
from pseudorigid.dynamics.lyapunov import scene_exponents
from pseudorigid.dynamics.orbits import scene_orbits
from pseudorigid.figures.axes import section
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.render import pixels
from pseudorigid.sweep.shares import shares

SCENE = {"ball": {"k": 0.2, "g": 0.04}, "energy": 0.01}
VIEW = {"elevation": 40, "azimuth": 115}
REGULAR, CHAOTIC = [0.1, -0.2], 0.6  # starts at SCENE


def texts(figure):
    return [text.get_text() for text in figure.texts]


def height(figure, text):
    """The height in inches at which a text stands."""
    (found,) = (each for each in figure.texts if each.get_text() == text)
    return found.get_position()[1]


def colors(figure):
    return {to_hex(line.get_color()) for line in figure.artists}


@pytest.mark.parametrize("sea", [[], [0], [2]])
def test_an_orbit_is_called_chaotic_by_its_growth_and_not_by_the_config(sea):
    data = scene_orbits(BALL, 0.01, [*REGULAR, CHAOTIC], [200, 200, 900])
    assert chaotic_orbits(SCENE["ball"], data) == [2]
    portrait = module("portrait").draw(SCENE | {"view": VIEW, "sea": sea}, data)
    assert "chaotic orbit" in texts(portrait)
    sizes = [len(line.get_xdata()) for line in portrait.artists if line.get_color() == style.SEA]
    assert max(sizes) > 400
    _, regular, chaotic = section.over_orbits(SCENE | {"sea": sea}, data)
    assert (regular[0], chaotic[0]) == ("regular orbits", "chaotic orbit")


def test_a_key_has_no_orbits_that_are_not_there():
    data = scene_orbits(BALL, 0.01, REGULAR, 200)
    portrait = module("portrait").draw(SCENE | {"view": VIEW, "sea": [0, 1]}, data)
    assert not any("chaotic" in text for text in texts(portrait))
    curve = scene_orbits(BALL, 0.001, [0.5], 1000)  # of the example of `curves` in docs/config.md
    _, regular, chaotic = section.over_orbits(SCENE | {"energy": 0.001, "sea": [0]}, curve)
    assert regular[0] == "regular orbit" and chaotic is None
    few = scene_orbits(BALL, 0.01, [CHAOTIC], 5)
    _, regular, chaotic = section.over_orbits(SCENE | {"sea": []}, few)
    assert chaotic[0] == "chaotic orbit" and regular is None


def test_the_rim_is_in_the_key_only_if_it_is_seen():
    near = scene_orbits(BALL, -0.003, [0.1], 300)
    low = SCENE | {"view": VIEW, "energy": -0.003}
    assert "grazing rim" not in texts(module("portrait").draw(low, near))
    assert "grazing rim" in texts(module("portrait").draw(low | {"axes": SPACE}, near))


@pytest.mark.parametrize("others", [[-0.2], [-0.2, -0.1, 0.1, 0.15, -0.3, -0.4, 0.05]])
def test_names_of_exponents_stand_at_the_chaotic_lines_and_starts_are_named(others):
    starts = [*others, {"x": 0.4, "y": 0.0}]
    data = scene_exponents(BALL, 0.01, starts, 4000, 40)
    figure = module("exponents").draw(SCENE | {"starts": starts, "impacts": 4000}, data)
    last = data["exponent"].values[-1, -1]
    ends = {text: height(figure, rf"$\lambda_{text}$") for text in (1, 2, 3)}
    assert last[0] > 0.2 and (ends[1] - ends[2]) == pytest.approx(ends[2] - ends[3], rel=0.05)
    names = [text for text in texts(figure) if ": " in text]
    assert len(names) == len(starts) and "start \N{MINUS SIGN}0.2: regular" in names
    assert "$x$ 0.4, y 0: chaotic" in names
    full = {line.get_ydata()[-1] for line in figure.artists if len(line.get_xdata()) > 10}
    assert np.min(np.abs(np.array([*full]) - ends[1])) < 0.1  # beside the end of a line


def test_exponents_of_one_sort_have_no_key_and_hidden_ones_no_name():
    data = scene_exponents(BALL, 0.01, [0.6], 2000, 40)
    narrow = {"exponent": {"limits": [-0.1, 0.1], "ticks": [0]}}
    scene = SCENE | {"starts": [0.6], "impacts": 2000, "axes": narrow}
    figure = module("exponents").draw(scene, data)
    names = [text for text in texts(figure) if "lambda" in text or ":" in text]
    assert names == [r"$\lambda_2$"]
    assert len([text for text in texts(figure) if text == "0"]) == 2  # of two axes, no inset


def test_no_mark_of_a_chart_lies_outside_its_frame():
    height = {"limits": [-0.1, 0.1], "ticks": [0]}
    axes = {"t": {"limits": [4, 10], "ticks": [5]}, "displacement": height}
    figure = module("motion").draw(SCENES["motion"] | {"axes": axes}, motion())
    dots = [len(line.get_xdata()) for line in figure.artists if line.get_marker() == "o"]
    assert sorted(dots) == [1, 2]  # the key's, and those at 6.2 and 9.3
    axes["t"] = {"limits": [4, 6], "ticks": [5]}
    figure = module("motion").draw(SCENES["motion"] | {"axes": axes}, motion())
    assert "impact" not in texts(figure)
    energies = np.array([0.001, 0.002, 0.004, 0.006])
    data = xr.Dataset({"energy": ("e", energies), "twist": ("e", 1e3 * energies), "zero": np.nan})
    axes = {"energy": {"limits": [0.003, 0.006], "ticks": [0.004]}}
    figure = module("twist").draw(SCENE | {"marks": [0.001, 0.004], "axes": axes}, data)
    assert [text for text in texts(figure) if "$E$ =" in text] == ["$E$ = 0.004"]


def test_the_critical_residue_lies_within_its_axis():
    small = np.array([[1e-3, 1e-5], [1e-6, -1e-9]])
    orbit = np.random.default_rng(1).uniform(-1, 1, (2, 2, 9))
    data = xr.Dataset(
        {
            "rotation": ("noble", [0.17, 0.18]),
            "period": (("noble", "convergent"), [[23.0, 40.0], [17.0, 29.0]]),
            "residue": (("noble", "convergent"), small),
            "x": (("noble", "point"), orbit[0]),
            "y": (("noble", "point"), orbit[1]),
        }
    )
    figure = module("last_curve").draw(SCENE, data)
    (critical,) = (line for line in figure.artists if line.get_linestyle() == "--")
    top = 1425 / style.DPI
    assert critical.get_ydata()[0] < top - 0.05
    positive = data.assign(residue=abs(data["residue"]))
    assert "hollow: negative" not in texts(module("last_curve").draw(SCENE, positive))


@pytest.fixture(scope="module")
def calm():
    """Families of the least period, without any event."""
    scene = SCENE | {"energy": 0.001, "parameter": "energy", "span": [-0.0039, 0.0035], "drawn": 1}
    held = families(BALL, 0.001, "energy", scene["span"], 1, 2)
    return scene, held, shares(BALL, 0.001, held, "energy", scene["span"], 0.001, 20, 300)


def test_families_without_an_event_are_drawn_with_their_rim_and_a_key_of_what_there_is(calm):
    scene, held, regular = calm
    assert held.sizes["event"] == 0 and held["event_family"].dtype == np.int64
    figure = module("families").draw(scene, held, regular)
    assert not {"hyperbolic", "fold", "an impact grazes"} & set(texts(figure))
    assert {"elliptic", "rim of the section"} <= set(texts(figure))
    pale = [line for line in figure.artists if line.get_color() == style.BACKDROP]
    rims = [line for line in pale if len(line.get_xdata()) > 2]
    assert len(rims) == 2
    low, high = 775 / style.DPI, 1865 / style.DPI
    assert all(low < y < high for line in rims for y in line.get_ydata())


def test_families_along_k_do_not_name_one_k(calm):
    _, held, regular = calm
    span = [0.18, 0.22]
    held = held.assign(k=("point", np.linspace(*span, held.sizes["point"])))
    scene = SCENE | {"parameter": "k", "span": span, "drawn": 1}
    figure = module("families").draw(scene, held, regular)
    assert "$E$ = 0.01, $g$ = 0.04" in texts(figure)
    assert not any("$k$ =" in text for text in texts(figure))


def test_a_start_under_regular_that_is_chaotic_is_no_island():
    data = spread(BALL, 0.01, 4, 2000, 4, [-0.2, 0.6], 1024, 4, 100)
    runs = scene_exponents(BALL, 0.01, [0.6], 500, 4)
    figure = module("spread").draw(SCENE, data, runs)
    assert "Largest exponent in the islands" not in texts(figure)
    assert any("grey: chaotic" in text for text in texts(figure))
    assert style.SEA in colors(figure)
    calm = module("spread").draw(SCENE, data.isel(island=[0]), runs)
    assert "Largest exponent in the islands" in texts(calm) and style.SEA not in colors(calm)


def test_rotation_and_control_at_low_energy_have_no_chaos_in_their_keys():
    data = rotation(BALL, -0.003, [-0.0035], 20, 200, (0.1, 0.2), 200)
    figure = module("rotation").draw(SCENE | {"energy": -0.003}, data)
    assert not {"chaotic", "islands"} & set(texts(figure)) and "regular" in texts(figure)
    data = control(BALL, -0.003, [0.05], 10, 400, 5, [0.1], 0.05, 400, 10, 1)
    figure = module("control").draw(SCENE | {"energy": -0.003}, data)
    assert "chaotic" not in texts(figure) and "regular" in texts(figure)


def test_rotation_names_the_energies_that_are_drawn_beside_their_lines():
    """The curves fall at once to where the key stands otherwise."""
    energies, starts = np.array([0.01, 0.02, 0.03]), 40
    place = np.tile(np.linspace(-0.8, 0.9, starts), (3, 1))
    growth = np.where(place < -0.6, 0.0, 1.0)
    growth[2] = 1.0
    growth[2, 0] = 0.0  # one regular start is no line
    turns = 0.3 - 0.02 * np.minimum(1.0, 20.0 * (place + 0.8))
    orbits = {
        name: ("start", value[0])
        for name, value in (
            ("detail_place", place),
            ("detail_rotation", turns),
            ("detail_exponent", growth),
        )
    }
    for name, value in (("place", place), ("rotation", turns), ("exponent", growth)):
        orbits[name] = ("energy", "start"), value
    orbits |= {
        "energy": ("energy", energies),
        "fixed_place": ("energy", [-0.8] * 3),
        "fixed_rotation": ("energy", [0.3] * 3),
    }
    data = xr.Dataset(orbits, attrs={"impacts": 1000, "detail_impacts": 1000})
    figure = module("rotation").draw(SCENE, data)
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
    shape = ("cut", "lag", "a", "b")
    high = np.full((4, 1, 2, 2), 0.97)
    ends = {
        f"correlation{end}": (shape, high + shift)
        for end, shift in (("", 0), ("_low", -0.01), ("_high", 0.01))
    }
    ends |= {
        f"dependence{end}": (shape[:3], high[..., 0] + shift)
        for end, shift in (("", 0), ("_low", -0.01), ("_high", 0.01))
    }
    ends |= {
        "bin_edge": ("edge", np.linspace(0, 4, 41)),
        "flights": ("bin", np.arange(40.0)),
        "period": ("cut", 40.0 + np.arange(4)),
    }
    data = xr.Dataset(ends, coords={"cut": cuts, "lag": [1]})
    figure = module("clusters").draw(SCENE, data)
    assert_text_is_whole_and_apart(figure)
    words = [text for text in figure.texts if text.get_text().startswith("95 %")]
    marks = [line.get_ydata()[0] for line in figure.artists if line.get_marker() in "os^D"]
    for text in words:
        assert min(abs(text.get_position()[1] - y) for y in marks) > 0.1


def test_flux_without_regions_and_lobes_says_why():
    blank = {name: ("side", [np.nan] * 2) for name in ("area", "region")}
    lines = ("outline_x", "outline_y", "branch_x", "branch_y", "crossing_x")
    blank |= {name: (("side", "n"), np.full((2, 9), np.nan)) for name in lines}
    why = {"missing_inner": "a jump of the map cuts it"}
    data = xr.Dataset(blank, coords={"side": list(SIDES)}, attrs=why)
    figure = module("flux").draw(SCENE, data)
    assert "neither region has an edge that can be drawn" in texts(figure)
    assert "no lobe: a jump of the\nmap cuts it" in texts(figure)
    assert not {style.ORANGE, style.PURPLE} & colors(figure)


def test_a_comparison_draws_both_variants_on_axes_that_hold_both():
    exponents = SCENE | {"picture": "exponents", "starts": [0.6], "impacts": 500}
    blocks = [exponents | {"energy": energy} for energy in (0.01, 0.05)]
    data = [[scene_exponents(BALL, block["energy"], [0.6], 500, 20)] for block in blocks]
    images, words = picture.on_same_axes(blocks, data)
    assert words == ", on the same axes"
    found = [{}, {}]
    for block, axes, datasets in zip(blocks, found, data, strict=True):
        alone = pixels(module("exponents").draw(block | {"completed": axes}, *datasets))
    assert found[0] != found[1]
    labels = [image[:, 90:178] for image in images]  # left of the frame
    assert np.array_equal(*labels)
    first = pixels(module("exponents").draw(blocks[0], *data[0]))
    assert not np.array_equal(alone[:, 90:178], first[:, 90:178])


def test_a_comparison_says_if_axes_cannot_be_the_same():
    ball, low = Ball(k=0.2, g=0.04), {"energies": [-0.003], "energy": -0.003}
    data = rotation(ball, -0.003, [-0.003], 9, 100, (0.1, 0.2), 100)
    blocks = [SCENE | low | {"picture": "rotation"}] * 2
    assert picture.on_same_axes(blocks, [[data]] * 2)[1] == ", each on its own axes"
