"""What the axes of a scene hide is said, and a box holds the energy surface that it shows."""

import json
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from helpers.examples import computed, function
from helpers.project import shipped
from helpers.slowly import slowly
from pipeline.checks.quantities import hidden, reported
from pipeline.config import check
from pipeline.config.schema.kinds import KINDS
from pseudorigid import Ball
from pseudorigid.dynamics.orbits import scene_orbits
from pseudorigid.dynamics.variables import states_of
from pseudorigid.figures.axes.box import Box
from pseudorigid.figures.axes.limits import complete_box, inside
from pseudorigid.figures.axes.view import OccludingEllipsoid
from pseudorigid.figures.canvas import style

SHORT = {
    "fig2": {"impacts": 100}, "fig5": {"impacts": 100, "branches": {"outer": {"length": 0.2}}},
    "fig6": {"length": 0.2}, "fig7": {"impacts": 20_000, "records": 80}, "fig8": {"impacts": 100},
}  # fmt: skip
FIGURES = [f"fig{number}" for number in range(2, 9)]


def axis(low, high):
    return {"limits": [low, high], "ticks": [high]}


def edited(scene, change, ball=None):
    """A complete block of the paper's scene with few impacts and edits; axes are merged."""
    document = shipped()
    given = document["scenes"][scene] | SHORT.get(scene, {}) | change
    given["axes"] = document["scenes"][scene]["axes"] | change.get("axes", {})
    ball = document["ball"] | (ball or {})
    return check({"ball": ball, "scenes": {scene: given}}).scenes[scene].as_mapping()


@cache
def _data(text):
    return computed(json.loads(text))


def data_of(block):
    """Stage -> dataset; blocks that differ only in their axes share them."""
    return _data(json.dumps({key: value for key, value in block.items() if key != "axes"}))


def drawn(block):
    """Draw the block, and return what its axes hide."""
    data, kind = data_of(block), KINDS[block["picture"]]
    assert function(kind.drawn_by)(block, *(data[stage] for stage in kind.stages))
    return hidden(block, data)


@pytest.mark.parametrize("scene", FIGURES)
def test_the_papers_figures_hide_nothing(scene):
    with_upper_panel = {"impacts": 60_000} if scene == "fig7" else {}
    assert drawn(edited(scene, with_upper_panel)) == []


# scene, edit, and how the lines begin
EDITS = [
    ("fig2", {"energy": 0.03},
     ["axes.x.limits [-0.2, 0.6] cut the energy surface at E = 0.03, and hide ",
      "axes.udot.limits [-0.2, 0.4] cut the energy surface at E = 0.03, and hide "]),
    ("fig2", {"axes": {"x": axis(0, 0.2)}}, ["axes.x.limits [0, 0.2] cut the energy surface"]),
    ("fig2", {"energy": 0.005}, []),  # the surface is smaller
    ("fig3", {"energy": 0.03}, ["axes.displacement.limits [-0.4, 0.2] hide 5"]),
    ("fig3", {"duration": 32}, ["axes.t.limits [0, 16] hide 50 % of the lines: widen them to "
                                "[0.0, 32.0], or leave axes.t out"]),
    ("fig6", {"window": {"x": [-0.004, 0.004], "xdot": [-0.001, 0.0007]}},
     ["axes.x.limits [0.21, 0.2116] hide 46.7 % of the window: widen them to [0.2095, "]),
    ("fig7", {"axes": {"exponent": axis(-0.1, 0.1)}},
     ["axes.exponent.limits [-0.1, 0.1] hide 66.7 % of the lines' ends: widen them to",
      "axes.largest is not used: "]),
    ("fig7", {"axes": {"impact": axis(4000, 20_000), "largest": axis(0.1, 0.4)}}, []),
    ("fig7", {"axes": {"impact": axis(0, 20_000), "largest": axis(0.23, 0.24)}},
     ["axes.largest.limits [0.23, 0.24] hide "]),
    # orbits around the fixed point: none is chaotic
    ("fig7", {"starts": [0.1, 0.15, 0.2], "energy": 0.001}, ["axes.largest is not used: "]),
]  # fmt: skip


@pytest.mark.parametrize(("scene", "change", "lines"), EDITS)
def test_an_edited_scene_says_what_its_axes_hide(scene, change, lines):
    for line, start in zip(drawn(edited(scene, change)), lines, strict=True):
        assert line.startswith(start) and line.endswith(" out") and "\n" not in line


def test_axes_that_are_left_out_hide_nothing():
    for scene in FIGURES:
        block = edited(scene, {})
        del block["axes"]
        assert hidden(block, data_of(block)) == []


def test_another_ball_may_not_fit_the_axes():
    (line,) = drawn(edited("fig2", {}, {"g": 0.045}))
    words = "axes.x.limits [-0.2, 0.6] cut the energy surface at E = 0.01: drawn with [-0.2, 0.64]"
    assert line == f"{words}: write these, or leave axes.x out"  # no impact lies beyond


def test_less_than_a_pixel_is_not_hidden():
    given = {"t": axis(0.01, 16), "displacement": axis(-0.3007, 0.2)}
    assert drawn(edited("fig3", {"axes": given})) == []
    assert drawn(edited("fig3", {"axes": given | {"t": axis(0.02, 16)}})) != []


def test_impacts_and_times_are_reported_as_far_as_they_are_drawn():
    block = edited("fig4", {"axes": {"displacement": axis(-0.5, 0.05), "t": axis(10, 50.5)}})
    values = reported(block, data_of(block))
    motion = data_of(block)["motion"]
    t, height = motion["impact_t"].values, -motion["impact_position"].values
    count = int(np.sum((t >= 10) & (t <= 50.5) & (height <= 0.05)))
    assert 0 < count < t.size
    assert values["impacts drawn"] == f"{count}" and values["time"] == "10 to 50.5"


# ---- boxes


def portrait(energy, starts, axes):
    data = scene_orbits(Ball(0.2, 0.04), energy, starts, [400] * len(starts))
    view = {"elevation": 35, "azimuth": 100}
    return {"ball": {"k": 0.2, "g": 0.04}, "energy": energy, "axes": axes, "view": view}, data


PAPER = shipped()["scenes"]["fig2"]["axes"]
WIDE = {name: {"limits": [-9, 9], "ticks": [0]} for name in style.NAMES}


@pytest.mark.parametrize("energy", [0.0125, *slowly(0.003, 0.0599)])
@pytest.mark.parametrize(
    "axes", [PAPER, {"udot": axis(0, 0.3)}, {"x": axis(0.1, 0.2)}, {"xdot": axis(-0.1, 0.05)}, {}]
)
def test_a_box_shows_nothing_that_the_whole_surface_hides(energy, axes):
    scene, data = portrait(energy, [0.1, 0.93], axes)
    scene = complete_box(scene, data)
    ends = OccludingEllipsoid(0.2, 0.04, energy).ends()
    points = np.hstack([states_of(data), OccludingEllipsoid(0.2, 0.04, energy).rim()])
    assert not np.any(Box(scene).seen(points) & ~Box(scene | {"axes": WIDE}).seen(points))
    limits = [scene["axes"][name]["limits"] for name in style.NAMES]
    for (low, high), (least, most) in zip(limits, ends, strict=True):
        assert low <= least + 1e-9 and most - 1e-9 <= high
    for name, own in axes.items():  # kept if they hold the surface
        assert own == scene["axes"][name] or own["limits"] != scene["axes"][name]["limits"]


def test_the_surface_ends_where_its_farthest_points_lie():
    k, g, energy = 0.2, 0.04, 0.01
    turn = np.linspace(0.0, 2.0 * np.pi, 2001)
    across, up = np.meshgrid(np.linspace(0.0, 1.0, 500), turn)
    radius = np.sqrt(2 * energy + g * g / k)
    x, y = g / k + radius / np.sqrt(k) * across * np.cos(up), np.sqrt(1 + k) * radius * across
    states = Ball(k, g).state_xy(x * (1 - 1e-12), y * np.sin(up) * (1 - 1e-12), energy)
    for part, ends in zip(states, OccludingEllipsoid(k, g, energy).ends(), strict=True):
        assert (part.min(), part.max()) == pytest.approx(ends, abs=1e-5)


@given(
    k=st.floats(0.02, 1.0),
    share=st.floats(0.02, 0.98),
    height=st.floats(0.02, 0.98),
    starts=st.lists(st.floats(-0.95, 0.95), min_size=1, max_size=4),
    elevation=st.floats(5, 85),
    azimuth=st.floats(-180, 180),
)
@settings(max_examples=10, deadline=None)
def test_a_box_without_axes_holds_the_whole_surface(k, share, height, starts, elevation, azimuth):
    """No point of the rim is outside, and no line of the grid is seen inside the surface."""
    g = share * k
    low, high = Ball.dimensionless(k).energy_bounds()[0] * g**2, 0.5 * k - g
    energy = low + height * (high - low)
    ball, surface = Ball(k, g), OccludingEllipsoid(k, g, energy)
    data = scene_orbits(ball, energy, starts, [50] * len(starts))
    view = {"elevation": elevation, "azimuth": azimuth}
    scene = {"ball": {"k": k, "g": g}, "energy": energy, "view": view}
    scene = complete_box(scene, data)
    limits = [scene["axes"][name]["limits"] for name in style.NAMES]
    assert inside(limits, surface.rim()).all() and inside(limits, states_of(data)).all()
    wide = {
        name: {"limits": [3 * lo - 2 * hi, 3 * hi - 2 * lo], "ticks": [lo]}
        for name, (lo, hi) in zip(style.NAMES, limits, strict=True)
    }
    points = np.hstack([states_of(data), surface.rim()])
    try:
        box, whole = Box(scene), Box(scene | {"axes": wide})
    except ValueError as error:  # a flat surface seen from its edge
        assert "expected" in str(error)
        return
    assert np.array_equal(box.seen(points), whole.seen(points))
