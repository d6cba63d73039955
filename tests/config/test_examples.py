"""Every kind of picture away from the committed scenes: examples, refusals, unusual sizes."""

import warnings
from importlib import import_module

import pytest
import yaml
from jinja2 import Environment, StrictUndefined

from pipeline.config import ConfigError, check
from pipeline.config.declared.kinds import KINDS
from pipeline.config.declared.stages import STAGES, behind
from pipeline.config.reference import example
from pseudorigid import Ball
from pseudorigid.figures.canvas.render import render

PAPER = {"k": 0.2, "g": 0.04}
COSTLY = ("flux", "horseshoe", "tangle", "closeup")


def checked(block):
    """A complete block, as the one scene of a config."""
    return check({"ball": PAPER, "scenes": {"one": block}})["scenes"]["one"]


def made(block):
    """The picture, the quantities and the caption of a complete block, computed here."""
    kind, data = KINDS[block["picture"]], {}
    ball, energy = Ball(**block["ball"]), block["energy"]
    for name in behind(kind.stages):
        stage = STAGES[name]
        compute = getattr(import_module(stage.module), stage.function)
        fields = {field: block[field] for field in stage.fields if field in block}
        inputs = [data[other] for other in stage.inputs]
        data[name] = compute(ball, energy, *inputs, **fields)
        data[name].attrs |= {"k": ball.k, "g": ball.g, "energy": float(energy)}
    drawn = import_module(f"pseudorigid.figures.kinds.{block['picture']}").draw
    picture = render(drawn(block, *(data[name] for name in kind.stages)), "png")
    template = Environment(undefined=StrictUndefined).from_string(kind.caption())
    return picture, kind.numbers(block, **data), template.render(s=block)


@pytest.mark.parametrize(
    "name", [pytest.param(n, marks=[pytest.mark.slow] * (n in COSTLY)) for n in KINDS]
)
def test_the_example_of_a_kind_is_made_without_a_warning(name):
    block = checked(yaml.safe_load(example(name)))
    assert (block["ball"], block["energy"]) != (PAPER, 0.01)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        picture, numbers, caption = made(block)
    assert len(picture) > 5000
    assert KINDS[name].telling in numbers
    assert "nan" not in " ".join(numbers.values())
    assert len(caption) > 100


@pytest.mark.parametrize("name", KINDS)
def test_the_examples_are_blocks_of_a_config(name):
    checked(yaml.safe_load(example(name)))


SHELL = {"k": 0.3333333333333333, "g": 0.02}
REFUSED = [
    ("twist", {"ball": SHELL, "energies": [0.01, 0.016], "marks": []}, "energies[1]", "0.0138241"),
    ("rotation", {"ball": SHELL, "energy": 0.015}, "energy: 0.015", "below 0.0138241"),
    ("last_curve", {"ball": SHELL, "energy": 0.015}, "energy: 0.015", "below 0.0138241"),
    ("last_curve", {"between": [0.2, 0.2]}, "between: [0.2, 0.2]", "two fractions that differ"),
    ("horseshoe", {"type": "inverse hyperbolic"}, "type: 'inverse hyperbolic'", "hyperbolic"),
    ("spread", {"regular_impacts": 8}, "regular_impacts: 8", "from 16 to"),
    ("flux", {"period": 5}, "period: 5", "a multiple of 2"),
]  # fmt: skip


@pytest.mark.parametrize(("name", "change", "where", "allowed"), REFUSED)
def test_what_a_kind_cannot_show_is_refused_before_the_run(name, change, where, allowed):
    block = yaml.safe_load(example(name)) | change
    with pytest.raises(ConfigError) as error:
        checked(block)
    (line,) = str(error.value).splitlines()
    assert line.startswith(f"scenes.one.{where}")
    assert allowed in line


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
    ("jumps", {"ball": PAPER, "energy": 0.00177, "energies": [0.00176], "sides": 4}),
    ("last_curve", {"ball": PAPER, "energy": 0.02, "between": [-0.2, 0.2]}),
    ("last_curve", {"nobles": [[0, 5, 1, 15]]}),
    ("twist", {"energies": [0.001, 0.01], "marks": []}),
]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "change"), UNUSUAL)
def test_unusual_values_are_drawn_or_refused_in_words(name, change):
    block = checked(yaml.safe_load(example(name)) | change)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            made(block)
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
