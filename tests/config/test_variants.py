"""Variants of the config: what they replace, what they keep, and what is refused."""

import pytest
from documents import complaints
from project import shipped

from pipeline import config
from pipeline.config import paths
from pipeline.config.schema.sets import SETS

BASE = shipped()
NO_SCENE_FITS = {"ball": {"g": 0.0995}}  # energies 0.001 and 0.01 are too high for it


def with_variants(**variants):
    """Return all variants of the shipped document with these instead of its own."""
    return config.check(shipped() | {"variants": variants}).variants


def test_the_paper_comes_first_and_variants_are_complete():
    variants = with_variants(thin={"ball": {"k": 0.3}})
    assert list(variants) == [*SETS, "thin"]
    assert variants["thin"]["fig2"].ball.as_mapping() == {"k": 0.3, "g": 0.04}
    assert variants["thin"].keys() == variants["paper"].keys() == BASE["scenes"].keys()


AXES = {"t": {"limits": [0, 8], "ticks": [0, 8]}}


@pytest.mark.parametrize(
    ("variant", "scene", "expected"),
    [
        # Mappings merge, and lists are replaced.
        ({"scenes": {"fig5": {"resolution": {"bend": 20}, "starts": [0.1], "impacts": [5]}}},
         "fig5", {"resolution": {"distance": 0.01, "bend": 20}, "starts": [0.1]}),
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
    ],
)  # fmt: skip
def test_what_a_variant_gives_replaces_the_papers_values(variant, scene, expected):
    assert expected.items() <= with_variants(v=variant)["v"][scene].as_mapping().items()


@pytest.mark.parametrize(
    ("change", "scene", "kept"),
    [
        ({"energy": 0.002}, "fig2", False),
        ({"ball": {"k": 0.3}}, "fig7", False),
        ({"scale": 2}, "fig8", False),
        ({"scenes": {"fig3": {"duration": 30}}}, "fig3", False),
        ({"scenes": {"fig7": {"impacts": 1000}}}, "fig7", False),
        ({"scenes": {"fig6": {"window": {"x": [-0.1, 0.1]}}}}, "fig6", False),
        ({"scenes": {"fig2": {"impacts": [9] * 8}}}, "fig2", True),
        ({"scenes": {"fig6": {"length": 0.5}}}, "fig6", True),
        ({"energy": 0.01}, "fig2", True),
    ],
)
def test_the_papers_axes_are_dropped_where_they_no_longer_fit(change, scene, kept):
    assert ("axes" in with_variants(v=change)["v"][scene].as_mapping()) == kept


@pytest.mark.parametrize(
    ("name", "block", "parts"),
    [
        ("a/b", {"energy": 0.002}, ["variants: 'a/b'", "letters, digits, - and _"]),
        ("-n", {"energy": 0.002}, ["variants: '-n'", "not begin with -"]),
        ("paper", {"energy": 0.002}, ["variants: 'paper'", "other than paper, study"]),
        ("v", None, ["variants.v: nothing", "ball, energy, method, scenes and"]),
        ("v", {}, ["variants.v: {}"]),
        ("v", {"bal": {"k": 0.3}}, ["variants.v.bal: unknown key: did you mean ball?"]),
        ("v", {"ball": {"g": 0.3}}, ["variants.v.ball.g: 0.3", "0 < g < k = 0.2"]),
        ("v", {"ball": {"k": 0.01}}, ["variants.v.ball.g: 0.04", "0 < g < k = 0.01"]),
        ("v", {"energy": 0.06}, ["variants.v.energy: 0.06", "below k/2 - g = 0.06"]),
        ("v", NO_SCENE_FITS, ["variants.v.scenes.fig2.energy: 0.01", "k/2 - g = 0.0005"]),
        ("v", {"scenes": {"figg2": {}}}, ["variants.v.scenes.figg2: no scene", "mean fig2?"]),
        ("v", {"scenes": {"fig2": 3}}, ["variants.v.scenes.fig2: 3", "a mapping"]),
        ("v", {"scenes": {"fig2": {"energie": 1}}}, ["v.scenes.fig2.energie: unknown", "energy?"]),
        ("v", {"scenes": {"fig2": {"energy": 1}}}, ["v.scenes.fig2.energy: 1 ", "k/2 - g"]),
        ("v", {"scenes": {"fig5": {"resolution": {"bend": 0}}}}, ["fig5.resolution.bend: 0"]),
        ("v", {"scenes": {"fig3": {"picture": "tangle"}}}, ["fig3.picture: 'tangle'", "motion"]),
    ],
)
def test_a_bad_variant_is_refused_a_line_a_mistake(name, block, parts):
    lines = complaints(shipped() | {"variants": {name: block}})
    assert len(lines) == (7 if block == NO_SCENE_FITS else 1)
    for part in parts:
        assert part in lines[0]


def test_equal_stages_of_variants_are_computed_once():
    variants = with_variants(
        first={"scenes": {"fig8": {"impacts": [9] * 6}}},
        second={"scenes": {"fig8": {"impacts": [9] * 6, "sea": []}}},
    )
    artifact_paths = paths.artifact_paths(variants)
    assert artifact_paths["second", "fig8", "orbits"] == "results/first/orbits_fig8.nc"
    assert artifact_paths["second", "fig2", "orbits"] == "results/paper/orbits_fig2.nc"
    assert artifact_paths["second", "fig4", "periodic"] == "results/paper/periodic_fig4.nc"
