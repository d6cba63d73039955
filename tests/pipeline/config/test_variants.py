"""Variants of the config: what they replace, keep and leave out, and what is refused."""

import pytest

from helpers.documents import complaints, faults
from helpers.project import shipped
from pipeline import config
from pipeline.config.results import dataset_paths
from pipeline.config.schema.parts import SETS

NO_SCENE_FITS = {"ball": {"g": 0.0995}}  # energies 0.001 and 0.01 are too high for it


def checked(variants=None, **scenes):
    """Return the checked shipped document with these scenes, and perhaps other variants."""
    document = shipped()
    document["scenes"] |= scenes
    return config.check(document if variants is None else document | {"variants": variants})


def with_variants(**variants):
    """Return all variants of the shipped document with these instead of its own."""
    return checked(variants).variants


AXES = {"t": {"limits": [0, 8], "ticks": [0, 8]}}


@pytest.mark.parametrize(("variant", "scene", "expected"), [
    # Mappings merge, and lists are replaced.
    ({"scenes": {"fig5": {"resolution": {"bend": 20}, "starts": [0.1], "impacts": [5]}}}, "fig5",
     {"resolution": {"distance": 0.01, "bend": 20}, "starts": [0.1]}),
    ({"ball": {"k": 0.3}}, "fig2", {"ball": {"k": 0.3, "g": 0.04}}),
    ({"scenes": {"fig5": {"ball": {"k": 0.3}}}}, "fig5", {"ball": {"k": 0.3, "g": 0.04}}),
    # A scene's own values take precedence.
    ({"energy": 0.002, "scenes": {"fig8": {"energy": 0.003}}}, "fig2", {"energy": 0.002}),
    ({"energy": 0.002, "scenes": {"fig8": {"energy": 0.003}}}, "fig8", {"energy": 0.003}),
    ({"energy": 0.002, "scenes": {"fig3": {"axes": AXES}}}, "fig3", {"axes": AXES}),
    # A scale is exact: as floats, 9.0 * 0.01 is more than 0.09.
    ({"scale": 3}, "fig2", {"energy": 0.09}),
    ({"scale": 2}, "fig8", {"energy": 0.004, "ball": {"k": 0.2, "g": 0.08}}),
    ({"scale": 2, "scenes": {"fig5": {"starts": [{"x": 0.1, "y": 0.02}, 0.5], "impacts": 9}}},
     "fig5", {"starts": [{"x": 0.2, "y": 0.04}, 0.5]}),
])  # fmt: skip
def test_what_a_variant_gives_replaces_the_papers_values(variant, scene, expected):
    assert expected.items() <= with_variants(v=variant)["v"][scene].as_mapping().items()


@pytest.mark.parametrize(("change", "scene", "kept"), [
    ({"energy": 0.002}, "fig2", False),
    ({"ball": {"k": 0.3}}, "fig7", False),
    ({"scale": 2}, "fig8", False),
    ({"scenes": {"fig3": {"duration": 30}}}, "fig3", False),
    ({"scenes": {"fig7": {"impacts": 1000}}}, "fig7", False),
    ({"scenes": {"fig6": {"window": {"x": [-0.1, 0.1]}}}}, "fig6", False),
    ({"scenes": {"fig2": {"impacts": [9] * 8}}}, "fig2", True),
    ({"scenes": {"fig6": {"length": 0.5}}}, "fig6", True),
    ({"energy": 0.01}, "fig2", True),
])  # fmt: skip
def test_the_papers_axes_are_dropped_where_they_no_longer_fit(change, scene, kept):
    assert ("axes" in with_variants(v=change)["v"][scene].as_mapping()) == kept


@pytest.mark.parametrize(("name", "block", "parts"), [
    ("a/b", {"energy": 0.002}, ["variants: 'a/b'", "letters, digits, - and _"]),
    ("paper", {"energy": 0.002}, ["variants: 'paper'", "other than paper"]),
    ("fig2", {"energy": 0.002}, ["variants: 'fig2'", "a name that no scene has"]),
    ("v", {}, ["variants.v: {}"]),
    ("v", {"bal": {"k": 0.3}}, ["variants.v.bal: unknown key: did you mean ball?"]),
    ("v", {"ball": {"g": 0.3}}, ["variants.v.ball.g: 0.3", "0 < g < k = 0.2"]),
    ("v", {"energy": 0.06}, ["variants.v.energy: 0.06", "below k/2 - g = 0.06"]),
    ("v", NO_SCENE_FITS, ["variants.v.scenes.fig2.energy: 0.01", "k/2 - g = 0.0005"]),
    ("v", {"scenes": {"figg2": {}}}, ["variants.v.scenes.figg2: no scene", "mean fig2?"]),
    ("v", {"scenes": {"fig2": {"energie": 1}}}, ["v.scenes.fig2.energie: unknown", "energy?"]),
    ("v", {"scenes": {"fig2": {"energy": 1}}}, ["v.scenes.fig2.energy: 1 ", "k/2 - g"]),
    ("v", {"energy": 0.009, "scenes": {"fig2": {"energy": 1}}}, ["v.scenes.fig2.energy: 1 "]),
    ("v", {"scenes": {"fig3": {"picture": "tangle"}}}, ["fig3.picture: 'tangle'", "motion"]),
])  # fmt: skip
def test_a_bad_variant_is_refused_a_line_a_mistake(name, block, parts):
    lines = faults(shipped() | {"variants": {name: block}})
    assert len(lines) == (7 if block == NO_SCENE_FITS else 1)
    for part in parts:
        assert part in lines[0]


def test_equal_stages_of_variants_are_computed_once():
    variants = with_variants(
        first={"scenes": {"fig8": {"impacts": [9] * 6}}},
        second={"scenes": {"fig8": {"impacts": [9] * 6}}},
    )
    assert list(variants) == [*SETS, "first", "second"]
    assert variants["first"].keys() == variants["paper"].keys() == shipped()["scenes"].keys()
    datasets = dataset_paths(variants)
    assert datasets["second", "fig8", "orbits"] == "results/first/orbits_fig8.nc"
    assert datasets["second", "fig2", "orbits"] == "results/paper/orbits_fig2.nc"
    assert datasets["second", "fig4", "periodic"] == "results/paper/periodic_fig4.nc"


SMALL = {"picture": "portrait", "ball": {"k": 0.05, "g": 0.04}, "energy": -0.0155, "starts": [0.1],
         "impacts": 10}  # fmt: skip
POINT = SMALL | {"ball": {"k": 0.2, "g": 0.04}, "energy": 0.01, "starts": [{"x": 0.5, "y": 0.0}]}


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
    assert not any("small" in path for path in document.figures("lower-energy"))


def test_a_method_that_manifolds_cannot_have_leaves_them_out():
    left_out = checked({"v": {"method": {"scan": 0.1, "tolerance": 1e-9}}}).left_out["v"]
    assert set(left_out) == {"fig5", "fig6"}
    assert "method.tolerance: 1e-09" in left_out["fig5"]


@pytest.mark.parametrize(("variant", "line"), [
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
])  # fmt: skip
def test_what_a_variant_says_of_a_scene_is_a_mistake_that_names_it(variant, line):
    document = shipped()
    document["scenes"] |= {"small": SMALL, "point": POINT}
    lines = faults(document | {"variants": {"v": variant}})
    assert line in lines[0] and "variants.v." in lines[0]
    assert len(lines) == (2 if "for fig2" in line else 1)  # the small ball has another bound


def test_the_ball_of_the_file_is_refused_once():
    lines = complaints(shipped() | {"ball": {"k": 0.2, "g": 0.3}})
    assert list(lines) == ["ball.g: 0.3 is not allowed: expected 0 < g < k = 0.2"]


def test_a_faulty_variant_stops_only_itself():
    wrong, right = {"energy": 7}, {"energy": 0.009}
    found = checked({"wrong": wrong, "right": right, "odd": {"bal": 1}})
    assert found.own_variants == ["right"] and [*found.faulty] == ["wrong", "odd"]
    document = shipped() | {"variants": {"odd": {"bal": 1}}, "ball": {"k": 0.2, "g": 0.3}}
    lines = complaints(document)  # with a mistake of the file, all are said at once
    assert [line.partition(":")[0] for line in lines] == ["ball.g", "variants.odd.bal"]


@pytest.mark.parametrize(("path", "values", "names"), [
    ("ball.g", [0.02, 0.03, 0.05], ["r-0p02", "r-0p03", "r-0p05"]),
    ("ball.k", [0.3, 2.5e-1], ["r-0p3", "r-0p25"]),
    ("energy", [-0.001, 1e-05], ["r--0p001", "r-1e-05"]),
    ("scenes.fig3.duration", [10, 20.5], ["r-10", "r-20p5"]),
    ("scenes.fig4.type", ["elliptic", "inverse hyperbolic"],
     ["r-elliptic", "r-inverse-hyperbolic"]),
])  # fmt: skip
def test_a_range_becomes_a_variant_for_each_value(path, values, names):
    found = checked({"r": {"values": {path: values}}})
    assert found.own_variants == names and found.faulty == {}
    assert found.ranges == {"r": (path, dict(zip(names, values, strict=True)))}
    scene, *keys = path.removeprefix("scenes.").split(".")
    for name, value in zip(names, values, strict=True):
        block = found.variants[name]["fig2" if scene in ("ball", "energy") else scene].as_mapping()
        for key in keys if path.startswith("scenes") else path.split("."):
            block = block[key]
        assert block == value and type(block) is type(value)


def test_other_fields_of_a_range_hold_for_all_and_none_is_changed():
    block = {
        "values": {"ball.g": [0.02, 0.03]},
        "ball": {"k": 0.3},
        "scenes": {"fig3": {"period": 2}},
    }
    document = shipped() | {"variants": {"r": block}}
    for name, scenes in config.check(document).variants.items():
        if name.startswith("r-"):
            assert scenes["fig2"].ball.k == 0.3 and scenes["fig3"].period == 2
    assert block["values"] == {"ball.g": [0.02, 0.03]} and block["ball"] == {"k": 0.3}


@pytest.mark.parametrize(("block", "lines", "left"), [
    # A mistake in a value names the value, and stops this variant alone.
    ({"values": {"ball.g": [0.02, 0.3]}}, ["variants.r.values.ball.g[1]: 0.3 is not"], ["r-0p02"]),
    ({"values": {"ball.g": [0.02, "x"]}}, ["variants.r.values.ball.g[1]: 'x' is not"], ["r-0p02"]),
    ({"values": {"ball.g": [0.02, 0.0995]}, "scenes": {}},
     [f"variants.r.values.ball.g[1]: scenes.fig{i}.energy: 0.0" for i in range(2, 9)], ["r-0p02"]),
    # A mistake in the path, or in what all have, is said once.
    ({"values": {"scenes.fig3.durration": [9, 8]}},
     ["variants.r.values.scenes.fig3.durration: unknown key: did you mean duration?"], []),
    ({"values": {"scenes.fig33.duration": [9, 8]}},
     ["variants.r.values.scenes.fig33.duration: no scene fig33: did"], []),
    ({"values": {"energy": [0.009, 0.008]}, "scenes": {"fig2": {"impacts": 0}}},
     ["variants.r.scenes.fig2.impacts: 0 is not allowed"], []),
    ({"values": {"energy": [0.009]}, "bal": {}}, ["variants.r.bal: unknown key"], []),
    # What is no range.
    ({"values": {"bal.g": [0.02]}}, ["variants.r.values: {'bal.g': [0.02]} is not allowed"], []),
    ({"values": {"scale": [2]}}, ["variants.r.values: {'scale': [2]} is not allowed"], []),
    ({"values": {"energy": [0.01], "ball.g": [0.1]}}, ["variants.r.values: {'energy'"], []),
    ({"values": {}}, ["variants.r.values: {} is not allowed: expected a mapping from one"], []),
    ({"values": {"energy": 0.01}}, ["variants.r.values.energy: 0.01 is not allowed"], []),
    ({"values": {"energy": [0.01, 0.010]}}, ["variants.r.values.energy: [0.01, 0.01] is"], []),
    ({"values": {"energy": [True]}}, ["variants.r.values.energy[0]: true is not allowed"], []),
    ({"values": {"scenes.fig4.type": ["a b", "a-b"]}},
     ["variants.r.values.scenes.fig4.type: ['a b', 'a-b'] is not allowed: expected values"], []),
])  # fmt: skip
def test_mistakes_of_a_range_are_named_where_they_are_written(block, lines, left):
    document = shipped() | {"variants": {"r": block}}
    found = faults(document)
    assert len(found) == len(lines)
    for line, start in zip(found, lines, strict=True):
        assert line.startswith(start)
    assert config.check(document).own_variants == left


def test_a_variant_of_a_range_has_a_name_of_its_own():
    found = checked({"r-0p009": {"energy": 0.002}, "r": {"values": {"energy": [0.009]}}})
    assert found.own_variants == ["r-0p009"] and [*found.faulty] == ["r"]
    (mistake,) = found.faulty["r"]
    assert str(mistake).startswith("variants.r.values.energy: [0.009] is not allowed: expected val")
    assert found.variants["r-0p009"]["fig2"].energy == 0.002


def test_the_shipped_variants_have_no_mistakes():
    assert checked().faulty == {}
