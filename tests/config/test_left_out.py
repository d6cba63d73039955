"""Scenes that a variant cannot have are left out of it, with the reason, and stop nothing else."""

import random

import pytest
from documents import complaints
from project import shipped

from pipeline import config
from pipeline.config import paths

SMALL = {"picture": "portrait", "ball": {"k": 0.05, "g": 0.04}, "energy": -0.0155, "starts": [0.1],
         "impacts": 10}  # fmt: skip
POINT = SMALL | {"ball": {"k": 0.2, "g": 0.04}, "energy": 0.01, "starts": [{"x": 0.5, "y": 0.0}]}


def checked(variants=None, **scenes):
    """Return the checked shipped document with these scenes, and perhaps other variants."""
    document = shipped()
    document["scenes"] |= scenes
    return config.check(document if variants is None else document | {"variants": variants})


def test_a_scene_that_does_not_suit_a_variant_is_left_out_of_it_alone():
    document = checked(small=SMALL, point=POINT)
    variants, left_out = document.variants, document.left_out
    assert left_out.keys() == shipped()["variants"].keys()
    assert {name: set(scenes) for name, scenes in left_out.items() if scenes} == {
        "lower-energy": {"small"}, "below": {"small", "point"}, "above": {"small", "point"},
        "thin-shell": {"small", "point"},
    }  # fmt: skip
    low = left_out["lower-energy"]["small"]
    assert low.startswith(
        "left out: energy: 0.0098 is not allowed: expected a number below k/2 - g"
    )
    below = left_out["below"]["point"]
    assert below.startswith("left out: starts[0]: {'x': 0.5, 'y': 0.0} is not allowed: expected a")
    assert variants["paper"]["small"].energy == -0.0155
    for name, scenes in left_out.items():
        assert variants[name].keys() == shipped()["scenes"].keys() | {"small", "point"} - set(
            scenes
        )
    assert not any("small" in path for path in paths.figures(variants, "lower-energy"))


@pytest.mark.parametrize("method", [{"scan": 0.1, "tolerance": 1e-9}])
def test_a_method_that_manifolds_cannot_have_leaves_them_out(method):
    left_out = checked({"v": {"method": method}}).left_out["v"]
    assert set(left_out) == {"fig5", "fig6"}
    assert "method.tolerance: 1e-09" in left_out["fig5"]


@pytest.mark.parametrize(
    ("variant", "line"),
    [
        # What is written for the scene in the variant is a mistake.
        ({"scenes": {"small": {"energy": 0.01}}}, "variants.v.scenes.small.energy: 0.01 "),
        ({"scenes": {"point": {"starts": [{"x": 9, "y": 0}]}}}, "v.scenes.point.starts[0]: {'x'"),
        ({"energy": 0.002, "scenes": {"point": {"starts": [{"x": 9, "y": 0}]}}}, "point.starts[0]"),
        ({"scenes": {"fig3": {"ball": {"k": 0.09}}}}, "variants.v.scenes.fig3.energy: 0.01 "),
        ({"energy": 0.009, "scenes": {"fig3": {"ball": {"k": 0.09}}}},
         "variants.v.energy: 0.009 is not allowed: expected a number below k/2 - g = 0.005, "
         "where the ball could flatten to nothing, for fig3"),
        # What suits no scene at all is one.
        ({"energy": 7}, "to nothing, for fig2, fig3, fig4, fig5, fig6, fig7, fig8, point"),
    ],
)  # fmt: skip
def test_what_a_variant_says_of_a_scene_is_a_mistake_that_names_it(variant, line):
    document = shipped()
    document["scenes"] |= {"small": SMALL, "point": POINT}
    lines = complaints(document | {"variants": {"v": variant}})
    assert line in lines[0] and "variants.v." in lines[0]
    assert len(lines) == (2 if "for fig2" in line else 1)  # the small ball has another bound


def test_a_change_that_does_not_help_leaves_a_scene_out_and_one_that_helps_keeps_it():
    variants = {
        "no": {"energy": 0.002, "scenes": {"point": {"sea": []}}},
        "yes": {"energy": 0.002, "scenes": {"point": {"starts": [0.5]}}},
    }
    document = checked(variants, point=POINT)
    assert set(document.left_out["no"]) == {"point"} and not document.left_out["yes"]


def test_the_ball_of_the_file_is_refused_once():
    lines = complaints(shipped() | {"ball": {"k": 0.2, "g": 0.3}})
    assert list(lines) == ["ball.g: 0.3 is not allowed: expected 0 < g < k = 0.2"]


@pytest.mark.slow
def test_points_that_the_explorer_copies_suit_the_shipped_variants_or_are_left_out():
    draw = random.Random(7).uniform
    for _ in range(30):
        k = round(draw(0.02, 1 / 3), 4)
        g = round(draw(0.05, 0.45) * k, 4)
        lowest = -g * g / (2 * k)
        energy = round(lowest + draw(0.01, 1) ** 2 * (k / 2 - g - lowest), 6)
        radius = ((2 * energy + g * g / k) / k) ** 0.5
        x, y = (draw(-0.7, 0.7) * radius for _ in range(2))
        start = {"x": g / k + x, "y": y * (k + k * k) ** 0.5}
        block = POINT | {"ball": {"k": k, "g": g}, "energy": energy, "starts": [start]}
        for other in ({}, {"picture": "exponents", "records": 2}):
            document = checked(explored=block | other)
            assert {*document.left_out["doubled"]} == set()
            for name, scenes in document.left_out.items():
                assert set(scenes) <= {"explored"}
                assert ("explored" in document.variants[name]) == (not scenes)
