"""The pictures of claims, proofs and families show their data."""

from functools import cache

import numpy as np
import pytest

from extensions.families.dataset import families
from extensions.families.shares import shares
from extensions.proofs.escape import escape
from extensions.proofs.theorems import scenes
from helpers.legible import assert_legible
from helpers.parts.small_curve import SMALL
from helpers.readable import assert_readable
from helpers.samples import module
from helpers.sections import BALL
from pseudorigid import symmetric_orbits
from pseudorigid.dynamics.manifolds import scene_manifolds
from pseudorigid.dynamics.orbits import scene_orbits
from pseudorigid.dynamics.variables import rows
from pseudorigid.figures.canvas import style
from pseudorigid.figures.canvas.render import pixels

SCENE = {"energy": 0.01, "ball": {"k": 0.2, "g": 0.04}}
FAMILIES = SCENE | {
    "picture": "families", "parameter": "energy", "span": [0.004, 0.02], "period": 6, "levels": 8,
    "drawn": 6, "step": 0.002, "starts": 40, "impacts": 1000,
}  # fmt: skip
AXES = {name: {"limits": [-1.4, 1.4], "ticks": [-1, 0, 1]} for name in "xypq"}
SCENES = {
    "families": FAMILIES, "residues": FAMILIES, "twist": SCENE | {"marks": [0.001, 0.01]},
    "curves": SCENE,
    "horseshoe": SCENE | {"axes": AXES}, "graph": SCENE | {"energy": 0.005},
    "escape": SCENE | {"energy": 0.0374, "beside": [0, 1e-4], "distance": 0.01},
    "exclusion": SCENE | {"followed": 80},
}  # fmt: skip
# A kind, the number of one of its datasets, a variable, and a change of it that must show.
CHANGES = [
    ("spread", 0, "exponent", lambda v: v + 0.003),
    ("clusters", 0, "dependence", lambda v: 0.5 * v),
    ("rotation", 0, "rotation", lambda v: v + 2e-3), ("jumps", 0, "y", lambda v: 0.9 * v),
    ("flux", 0, "branch_x", lambda v: v + 0.001 * np.arange(v.shape[1]) / v.shape[1]),
    ("last_curve", 0, "residue", lambda v: 3.0 * v), ("control", 0, "a", lambda v: 0.5 * v),
    ("control_shares", 0, "class_share", lambda v: 0.5 * v),
    ("exclusion", 0, "excluded", lambda v: np.minimum(v, 5)),
    ("exclusion", 0, "share", lambda v: 0.9 * v), ("exclusion", 1, "x", lambda v: v + 0.005),
    ("twist", 0, "twist", lambda v: 1.1 * v), ("curves", 0, "x", lambda v: v + 0.005),
    ("horseshoe", 1, "image_p", lambda v: 1.1 * v), ("graph", 0, "corner_x", lambda v: v + 0.005),
    ("escape", 0, "distance", lambda v: v * np.linspace(1, 2, v.shape[1])),
    ("families", 0, "x", lambda v: v + 0.02), ("residues", 0, "trace", lambda v: v + 0.2),
    ("families", 0, "type", lambda v: np.full(v.shape, "hyperbolic", dtype=object)),
    ("families", 1, "regular", lambda v: 0.5 * v),
]  # fmt: skip


def families_along(parameter, span, levels, step, starts, impacts):
    held = families(BALL, 0.01, parameter, span, 6, levels)
    with pytest.MonkeyPatch.context() as patch:  # not drawn, and takes seconds
        patch.setattr("extensions.families.shares.breakup", lambda *_: np.nan)
        return held, shares(BALL, 0.01, held, parameter, span, step, starts, impacts)


@cache
def curves():
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(scenes, "theorems_at", lambda *_: [SMALL])
        data = scenes.scene_curves(BALL, 0.01, [0.17865])
    return data, scene_orbits(BALL, 0.01, [0.1, 0.9], [200, 800])


def horseshoe():
    six = symmetric_orbits(BALL, 0.01, 6)
    saddle, both = (six, 6, "hyperbolic"), {side: {"length": 0.5} for side in ("outer", "inner")}
    resolution = {"distance": 0.05, "bend": 40}
    manifolds = scene_manifolds(BALL, 0.01, *saddle, resolution, branches=both)
    return manifolds, scenes.scene_horseshoe(BALL, 0.01, *saddle, "outer")


OTHERS = {
    "twist": lambda: [scenes.scene_twist(BALL, 0.01, [0.001, 0.01, 0.029, 0.03])],
    "curves": curves,
    "horseshoe": horseshoe,
    "escape": lambda: [escape(BALL, 0.0374, [0.0, 1e-4], 0.01, 16, 2000)],
    "graph": lambda: [
        scenes.scene_graph(BALL, 0.005), scene_orbits(BALL, 0.005, [0.6], [500])
    ],
    "residues": lambda: OTHERS["families"]()[:1],
    "families": lambda: families_along("energy", FAMILIES["span"], 8, 0.002, 40, 1000),
}  # fmt: skip


@pytest.fixture(scope="module")
def data(request):
    """(kind) -> the datasets that it draws."""
    others = {"spread": ["fig7/lyapunov"], "jumps": ["fig2/orbits"]}

    @cache
    def data(kind):
        if kind in OTHERS:
            return OTHERS[kind]()
        datasets = request.getfixturevalue("datasets")
        stage = kind.removesuffix("_shares")
        found = [datasets[name] for name in (f"{stage}/{stage}", *others.get(kind, []))]
        return found + [*curves()] * (kind == "exclusion")

    return data


@pytest.fixture(scope="module")
def unchanged(data):
    """(kind) -> the pixels of its picture."""
    return cache(lambda kind: pixels(draw(kind, data(kind))))


def draw(name, datasets, **changes):
    return module(name).draw(SCENES.get(name, SCENE) | changes, *datasets)


@pytest.mark.parametrize(("name", "index", "variable", "change"), CHANGES)
def test_a_change_of_the_data_shows(data, unchanged, name, index, variable, change):
    changed = [*data(name)]
    old = changed[index][variable]
    changed[index] = changed[index].assign({variable: old.copy(data=change(old.values))})
    assert np.any(pixels(draw(name, changed)) != unchanged(name))


@pytest.mark.parametrize(("name", "change"), [("families", {"drawn": 1}), ("twist", {"marks": []})])
def test_a_change_of_the_scene_shows(data, unchanged, name, change):
    assert np.any(pixels(draw(name, data(name), **change)) != unchanged(name))


def test_text_of_families_is_whole_and_apart_along_energy_and_k(data):
    along_k = families_along("k", [0.18, 0.22], 4, 0.01, 20, 500)
    other = draw("families", along_k, parameter="k", span=[0.18, 0.22], step=0.01)
    for figure in (draw("families", data("families")), draw("residues", data("residues")), other):
        assert_legible(figure, slack=5)


def test_the_parts_of_the_excluded_region_can_be_read(data):
    assert_readable(draw("exclusion", data("exclusion")))


def test_a_residue_beyond_its_axis_is_marked_where_it_leaves(data):
    (held,) = data("residues")
    span, energy = rows(held)[0], held["energy"].values
    residue = np.full(energy.size, 0.5)
    residue[span] = np.linspace(0.5, 4.0, residue[span].size)
    figure = draw("residues", [held.assign(trace=("point", 2.0 - 4.0 * residue))])
    marks = [line for line in figure.artists if line.get_marker() in ("^", "v")]
    places = np.hstack([line.get_data() for line in marks]) * style.DPI
    (x,) = places[0]
    low, high = FAMILIES["span"]
    leaves = np.interp(1.6, residue[span], energy[span])
    assert x == pytest.approx(125 + 875 * (leaves - low) / (high - low), abs=0.1)
