"""Every kind of picture away from the committed scenes: examples and unusual sizes."""

import warnings

import pytest

from helpers.examples import PAPER, assert_made_or_refused_in_one_line, checked, made
from pipeline.config.schema.kinds import KINDS
from pipeline.config.schema.scene import Scene

COSTLY = ("flux", "horseshoe", "tangle", "closeup", "curves", "families", "control", "graph")
COSTLY += ("exclusion",)
SCENES = [name for name, kind in KINDS.items() if issubclass(kind, Scene) and kind.headline]


@pytest.mark.parametrize(
    "name", [pytest.param(n, marks=[pytest.mark.slow] * (n in COSTLY)) for n in SCENES]
)
def test_the_example_of_a_kind_is_made_without_a_warning(name):
    block = checked(name)
    assert (block["ball"], block["energy"]) != (PAPER, 0.01)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        picture, numbers, caption = made(block)
    assert len(picture) > 5000 and len(caption) > 100
    assert KINDS[name].headline in numbers
    assert "nan" not in " ".join(numbers.values())


@pytest.mark.parametrize("name", sorted({*COSTLY} & {*KINDS}))
def test_the_examples_are_blocks_of_a_config(name):
    checked(name)


ONE_IMPACT = {"starts": [0.1], "impacts": 1}


@pytest.mark.slow
@pytest.mark.parametrize(("name", "change"), [
    ("portrait", {"ball": PAPER, "energy": -0.003999} | ONE_IMPACT),
    ("motion", {"duration": 1.0e-9}),
    ("exponents", {"ball": PAPER, "energy": 0.001, "impacts": [2000, 50]}),
])  # fmt: skip
def test_unusual_values_are_drawn_or_refused_in_one_line(name, change):
    assert_made_or_refused_in_one_line(checked(name, **change))
