"""Pictures of proofs away from the committed ones: bounds, limits and unusual sizes."""

import numpy as np
import pytest
import xarray as xr

from extensions.proofs import part
from extensions.proofs.figures.escape import draw as draw_escape
from extensions.proofs.figures.graph import draw as draw_graph
from extensions.proofs.figures.horseshoe import draw as draw_horseshoe
from extensions.proofs.figures.twist import draw
from extensions.proofs.theorems.scenes import scene_horseshoe
from helpers.examples import OTHER, SHELL, assert_bounded, checked, made, no_clipping
from helpers.keys import SCENE, texts
from helpers.legible import assert_legible, frames_of, pixels_in_frames
from helpers.project import shipped
from helpers.sections import BALL
from pipeline.checks.quantities import hidden
from pipeline.config.results import files_of
from pipeline.config.schema.parts import STAGES
from pseudorigid import symmetric_orbits
from pseudorigid.dynamics.manifolds import scene_manifolds
from pseudorigid.dynamics.variables import chart, states_of
from pseudorigid.figures.canvas import style

MARKS = {"marks": []}


def test_a_stage_that_can_read_certificates_says_so():
    reader = "src/extensions/proofs/theorems/statements.py"
    stages = [stage for stage in STAGES.values() if reader in files_of(stage.function)]
    assert stages and all(stage.reads.startswith(part.CERTIFICATES) for stage in stages)


@pytest.mark.parametrize(("kind", "at_bound", "beyond", "line"), [
    ("graph", {}, {"energy": 0.006}, "energy: 0.006 ... k = 0.2 and this g, one of 0.005, 0.01"),
    ("graph", {}, {"ball": {"k": 0.3, "g": 0.04}}, "energy: 0.005 ... with k = 0.2"),
    ("curves", {}, {"rotation_numbers": [0.104, 0.25]},
     "rotation_numbers[1]: 0.25 ... "
     "too close to a fraction of small integers: the nearest that are not are 0.2499 and 0.25"),
    ("curves", {}, {"ball": SHELL, "energy": 0.015}, "energy: 0.015 ... below 0.0138241"),
    ("twist", MARKS, {"ball": SHELL, "energies": [0.01, 0.016]}, "energies[1] ... 0.0138241"),
])  # fmt: skip
def test_beyond_its_bound(kind, at_bound, beyond, line):
    assert_bounded("proofs", kind, at_bound, beyond, line)


def test_the_twist_is_drawn_within_its_frame():
    energies = [0.001, 0.004, 0.014]
    with no_clipping():
        made(checked("twist", ball=OTHER, energies=energies, marks=[0.001]))


def test_energies_and_values_outside_the_axes_are_reported():
    axes = {"energy": {"limits": [0, 0.004], "ticks": [0]}}
    data = {"twist": twist_data([0.001, 0.004, 0.006], [1.0, 4.0, 6.0])}
    assert hidden(SCENE | {"picture": "twist"}, data) == []
    (line,) = hidden(SCENE | {"picture": "twist", "axes": axes}, data)
    words = "hide 33.3 % of 3 energies: widen them to [0.0, 0.006], or leave axes.energy out"
    assert line == f"axes.energy.limits [0, 0.004] {words}"
    axes["twist"] = {"limits": [2, 6], "ticks": [2]}
    assert len(hidden(SCENE | {"picture": "twist", "axes": axes}, data)) == 2


# ---- the picture of the twist


def twist_data(energies, twist):
    """Twists that vanish nowhere."""
    return xr.Dataset({"energy": ("e", energies), "twist": ("e", twist), "zero": np.nan})


def picture(energies, twist, **scene):
    """Draw twists that vanish nowhere."""
    return draw(SCENE | scene, twist_data(energies, twist))


def test_no_mark_of_a_twist_lies_outside_its_frame():
    energies = np.array([0.001, 0.002, 0.004, 0.006])
    axes = {"energy": {"limits": [0.003, 0.006], "ticks": [0.004]}}
    figure = picture(energies, 1e3 * energies, marks=[0.001, 0.004], axes=axes)
    assert [text for text in texts(figure) if "$E$ =" in text] == ["$E$ = 0.004"]


# ---- the pictures of escapes and of a horseshoe


@pytest.mark.parametrize("count", [1, 6])
def test_lines_of_escapes_that_coincide_are_all_seen_above_the_start(count):
    impact, distance = np.array([1, 10, 100, 1000]), np.full((count, 4), 0.05)
    distance[:, ::2] *= 1.5
    data = xr.Dataset({"impact": ("i", impact), "distance": (("e", "i"), distance)})
    scene = {"beside": [1e-4 * i for i in range(count)], "distance": 0.02}
    figure = draw_escape(SCENE | scene, data)
    for hue in style.ordered(count):
        assert pixels_in_frames(figure, hue)[0] > 100
    assert "at the start" in texts(figure)
    lines = (a for a in figure.artists if a.get_color() == style.FRAME and a.get_ls() == "--")
    (start,) = (a for a in lines if np.ptp(a.get_xdata()) > 2)
    left, low, right, _ = frames_of(figure)[0].extents
    assert low + 5 < start.get_ydata()[0] * style.DPI < low + 300
    line, *_ = (x for x in (a.get_xdata() * style.DPI for a in figure.artists) if len(x) == 4)
    assert line == pytest.approx(left + 0.001 * impact * (right - left), abs=1)  # a linear axis
    assert_legible(figure)


def test_the_sets_of_the_committed_horseshoe_lie_on_branches_that_are_drawn():
    block = shipped()["proofs"]["horseshoe"]
    orbit = symmetric_orbits(BALL, 0.01, 6), 6, "hyperbolic"
    resolution = {"distance": 0.02, "bend": 20}
    manifolds = scene_manifolds(BALL, 0.01, *orbit, resolution, block["branches"])
    sets = scene_horseshoe(BALL, 0.01, *orbit, block["connection"])
    figure = draw_horseshoe(SCENE | block, manifolds, sets)
    above, (rim,) = frames_of(figure)[0], (a for a in figure.artists if len(a.get_xdata()) > 300)
    assert all(above.contains(*at) for at in rim.get_xydata() * style.DPI)  # the whole section
    lines = np.stack(chart(0.2, *states_of(manifolds)))
    for x, y in zip(sets["x"].values, sets["y"].values, strict=True):
        off = np.abs(lines - np.array([[x], [y]])).max(axis=0)
        assert np.nanmin(off) < 0.004


def test_a_mark_of_the_graph_is_a_connection_from_its_column_to_its_row():
    corner_x = np.array([0.4, 0.1, 0.3, 0.3, 0.2])[:, None] + [-0.01, 0.01, 0.01, -0.01]
    corner_y = np.array([0.0, 0.05, 0.1, -0.1, 0.0])[:, None] + [-0.01, -0.01, 0.01, 0.01]
    graph = xr.Dataset({
        "corner_x": (("set", "corner"), corner_x), "corner_y": (("set", "corner"), corner_y),
        "source": ("connection", [0, 1, 3]), "target": ("connection", [1, 3, 3]),
    }).assign_coords(connection=("set", [-1, -1, -1, -1, 0]))  # fmt: skip
    orbits = xr.Dataset(
        {name: ("point", [0.1]) for name in ("x", "xdot", "udot")}
        | {"row_size": ("orbit", [1]), "type": ("orbit", ["chaotic"])}
    )
    figure = draw_graph(SCENE, graph, orbits)
    section, matrix = frames_of(figure)
    (marks,) = (a for a in figure.artists if a.get_color() == style.BLUE)
    places = (marks.get_xydata() * style.DPI - matrix.p0) / matrix.size * 5
    assert places == pytest.approx(np.array([[4, 1], [1, 2], [2, 2]]), abs=0.01)
    texts = [(text.get_text(), np.array(text.get_position()) * style.DPI) for text in figure.texts]
    at = {name: place for name, place in texts if section.contains(*place)}
    assert at["1"][0] < at["2"][0] < at["4"][0] and at["2"][1] < at["3"][1]
