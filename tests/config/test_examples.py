"""Every kind of picture away from the committed scenes: examples, refusals, unusual sizes."""

import warnings
from importlib import import_module

import numpy as np
import pytest
import yaml
from legible import assert_text_is_whole_and_apart
from slowly import slowly

from pipeline.checks.report.captions import caption_of
from pipeline.config import check
from pipeline.config.reference import example
from pipeline.config.schema.kinds import KINDS
from pipeline.config.schema.stages import STAGES, upstream
from pseudorigid import Ball
from pseudorigid.figures.axes.panel import Panel
from pseudorigid.figures.canvas.render import render

PAPER = {"k": 0.2, "g": 0.04}
COSTLY = ("flux", "horseshoe", "tangle", "closeup", "curves", "families")


def checked(block):
    """Complete a block, as the one scene of a config."""
    return check({"ball": PAPER, "scenes": {"one": block}})["scenes"]["one"]


def computed(block):
    """Stage -> its dataset, of a complete block."""
    data, ball, energy = {}, Ball(**block["ball"]), block["energy"]
    for name in upstream(KINDS[block["picture"]].stages):
        stage = STAGES[name]
        compute = getattr(import_module(stage.module), stage.function)
        fields = {field: block[field] for field in stage.fields if field in block}
        inputs = [data[used] for used in stage.inputs]
        data[name] = compute(ball, energy, *inputs, **fields)
        data[name].attrs |= {"k": ball.k, "g": ball.g, "energy": float(energy)}
    return data


def made(block, data=None, legible=True):
    """Draw a complete block; return the picture, its quantities and its caption."""
    kind, data = KINDS[block["picture"]], data or computed(block)
    draw = import_module(f"pseudorigid.figures.kinds.{block['picture']}").draw
    figure = draw(block, *(data[name] for name in kind.stages))
    if legible:
        assert_text_is_whole_and_apart(figure, margin=1, slack=5)  # 10^-5 and 10^1 at a corner
    picture = render(figure, "png")
    return picture, kind.numbers(block, **data), caption_of("one", block).shows


@pytest.fixture
def no_clipping(monkeypatch):
    """Let drawings fail whose data lie outside their axes."""
    place, dots = Panel.place, Panel.dots

    def assert_inside(axis, values):
        part = axis.fraction(values)
        assert not np.any((part < -1e-9) | (part > 1.0 + 1e-9)), axis.name

    def checked_place(self, x, y):
        if self.clip_range == (0.0, 1.0):
            assert_inside(self.up, y)
        return place(self, x, y)

    def checked_dots(self, x, y, *args, **kwargs):
        assert_inside(self.across, x)
        dots(self, x, y, *args, **kwargs)

    monkeypatch.setattr(Panel, "place", checked_place)
    monkeypatch.setattr(Panel, "dots", checked_dots)


@pytest.mark.parametrize(
    "name", [pytest.param(n, marks=[pytest.mark.slow] * (n in COSTLY)) for n in KINDS]
)
def test_the_example_of_a_kind_is_made_without_a_warning(name, request):
    if name in ("rotation", "clusters", "jumps"):
        request.getfixturevalue("no_clipping")
    block = checked(yaml.safe_load(example(name)))
    assert (block["ball"], block["energy"]) != (PAPER, 0.01)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        picture, numbers, caption = made(block)
    assert len(picture) > 5000 and len(caption) > 100
    assert KINDS[name].headline in numbers
    assert "nan" not in " ".join(numbers.values())


OTHER = {"k": 0.25, "g": 0.03}
ELSEWHERE = [
    ("rotation", {"ball": OTHER, "energy": 0.008, "energies": [0.002, 0.012]}),
    ("clusters", {"ball": {"k": 0.3, "g": 0.005}, "energy": 0.01, "lags": 20,
                  "cuts": [10, 20, 30, 35, 40, 45, 50]}),
    ("jumps", {"ball": PAPER, "energy": 0.001, "energies": [0.0005]}),
    ("last_curve", {"ball": PAPER, "energy": 0.01, "between": [-0.2, -0.0325639],
                    "nobles": [[0, 5, 1, 10 + i] for i in range(8)]}),
    ("spread", {"ball": PAPER, "energy": 0.005, "orbits": 4, "blocks": 2, "length": 100_000}),
    *slowly(
        ("rotation", {"detail": [-0.25, -0.24999]}),
        ("control", {"ball": OTHER, "energy": 0.008, "strengths": [0.02], "shown": 0.02}),
        ("last_curve", {"ball": PAPER, "energy": 0.02, "between": [-0.2, 0.2], "convergents": 8}),
        ("spread", {"regular_impacts": 1_000_000}),
    ),
    ("twist", {"ball": OTHER, "energies": [0.001, 0.004, 0.014], "marks": [0.001]}),
]  # fmt: skip


@pytest.mark.parametrize(("name", "change"), ELSEWHERE)
def test_no_data_are_clipped_to_the_frame(name, change, no_clipping):
    made(checked(yaml.safe_load(example(name)) | change))


def test_a_horseshoe_shows_only_what_lies_within_its_limits():
    given = {"x": {"limits": [0, 0.1], "ticks": [0]}, "q": {"limits": [-0.9, 0.9], "ticks": [0]}}
    block = yaml.safe_load(example("horseshoe"))
    data = computed(checked(block))
    made(checked(block | {"axes": given}), data)
    with pytest.raises(ValueError, match=r"axes.x.limits \[1.0, 2.0\]: all data lie beyond them"):
        far = {"x": {"limits": [1.0, 2.0], "ticks": [1]}}
        made(checked(block | {"axes": far}), data)


@pytest.mark.parametrize("name", COSTLY)
def test_the_examples_are_blocks_of_a_config(name):
    checked(yaml.safe_load(example(name)))


SHELL = {"k": 0.3333333333333333, "g": 0.02}
UNUSUAL = [
    ("portrait", {"ball": PAPER, "energy": -0.003999, "starts": [0.1], "impacts": 1, "sea": []}),
    ("motion", {"ball": PAPER, "energy": 0.05, "period": 1, "type": "elliptic"}),
    ("motion", {"duration": 1.0e-9}),
    ("exponents", {"impacts": 2, "records": 2}),
    ("exponents", {"ball": PAPER, "energy": 0.001, "impacts": [2000, 50]}),
    ("rotation", {"starts": 2, "impacts": 100, "detail": [0.5, 0.6], "detail_impacts": 100}),
    ("rotation", {"ball": SHELL, "energy": 0.01, "energies": [-0.0001], "detail": [0.5, 0.9]}),
    ("rotation", {"ball": PAPER, "energy": 0.05, "energies": [0.055]}),
    ("spread", {"ball": PAPER, "energy": 0.01, "length": 10_000}),
    ("spread", {"orbits": 4, "length": 1000, "blocks": 2, "starts": [0.3], "impacts": 2000}),
    ("clusters", {"orbits": 2, "impacts": 1000, "lags": 1, "resamples": 10}),
    ("clusters", {"ball": PAPER, "energy": 0.001, "cuts": [3]}),
    ("control", {"ball": PAPER, "energy": -0.003999, "period": 12}),
    ("control", {"ball": PAPER, "energy": 0.05, "strengths": [1e-6, 0.5], "shown": 0.5}),
    ("control", {"orbits": 10, "impacts": 64, "drawn": 1, "resamples": 10}),
    ("jumps", {"ball": PAPER, "energy": 0.00177, "energies": [0.00176], "sides": 4}),
    ("last_curve", {"ball": PAPER, "energy": 0.02, "between": [-0.2, 0.2]}),
    ("last_curve", {"nobles": [[0, 5, 1, 15]]}),
    ("twist", {"energies": [0.001, 0.01], "marks": []}),
]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "change"), UNUSUAL)
def test_unusual_values_are_drawn_or_refused_in_one_line(name, change):
    block = checked(yaml.safe_load(example(name)) | change)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            made(block, legible=False)
        except ValueError as error:
            assert "\n" not in str(error)
            for word in ("array", "convert float", "reduction", "broadcast", "shape"):
                assert word not in str(error)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("change", "sides"),
    [({"ball": PAPER, "energy": 0.009}, 2), ({"ball": PAPER, "energy": 0.011}, 1),
     ({"ball": PAPER, "energy": 0.002, "period": 10}, 2),
     ({"ball": {"k": 0.3, "g": 0.02}, "energy": 0.002}, 1)],
)  # fmt: skip
def test_flux_has_the_lobes_that_exist_and_says_why_others_do_not(change, sides):
    block = checked(yaml.safe_load(example("flux")) | {"between": [0.6, 0.7]} | change)
    _, numbers, _ = made(block)
    assert len(numbers["lobes"].split(", ")) == sides
    if sides == 1:
        assert numbers["no outer lobes"].startswith("a jump of the map cuts the branch")
    assert ("no inner region" in numbers) == (block["ball"]["k"] == 0.3)
