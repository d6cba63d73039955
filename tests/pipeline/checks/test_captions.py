"""Captions say what was computed and drawn, of any scene, and name a scene after its set."""

from pathlib import Path

import pytest
import yaml

from helpers.examples import PAPER, SHELL, assert_decided, checked, computed, example
from helpers.project import ROOT, SHIPPED
from helpers.slowly import slowly
from pipeline import config
from pipeline.checks import manifest
from pipeline.checks.captions import CAPTIONS, caption_of
from pipeline.checks.quantities import facts
from pipeline.config import PUBLISHED
from pipeline.config.schema.kinds import KINDS

SADDLE = {"ball": PAPER, "period": 6, "type": "hyperbolic", "energy": 0.01, "starts": [-0.2]}
EXPONENTS = {"ball": PAPER, "energy": 0.01, "impacts": 1500, "records": 20}
PORTRAIT = {"ball": PAPER, "energy": 0.01}
ISLANDS = [-0.440981 + 0.014 * i for i in range(26)]
SLOW = 0.9999999999
HIGH_UP = {"displacement": {"limits": [0.2, 0.4], "ticks": [0.3]}}
CHAOS = "neighbours separate exponentially"
REGULAR = "exponents of the regular orbit"


# Kind, fields of its scene beside those of its example, and words that the caption has and has not.
CASES = [
    (
        "exponents",
        {"starts": [-0.44, -0.235, 0.142]},
        [REGULAR],
        [CHAOS, "(a)", "At the end"],
    ),
    (
        "exponents",
        {"starts": [0.6, 0.62]},
        [CHAOS, "(a) the largest ones", "the 2 chaotic"],
        ["regular"],
    ),
    (
        "exponents",
        {"starts": [0.6]},
        ["1 orbit,", "(a) the largest one,"],
        ["one colour", "ones", "dark to light"],
    ),
    ("exponents", {"starts": [-0.2, 0.6]}, ["the chaotic orbit's largest"], ["the regular"]),
    (
        "exponents",
        {"starts": [SLOW, -0.2]},
        ["the regular orbit tend", "an undecided orbit to be neither regular"],
        [CHAOS, "regular orbits"],
    ),
    (
        "exponents",
        {"starts": [SLOW]},
        ["an undecided orbit to be neither"],
        [CHAOS, "tend to zero"],
    ),
    ("exponents", {"starts": [SLOW, 0.6]}, ["the chaotic orbit's largest"], ["regular orbit"]),
    (
        "portrait",
        {"starts": [SLOW, 0.6], "impacts": 9, "view": {"elevation": 20, "azimuth": 240}},
        ["to a chaotic orbit", "Others belong to an undecided orbit"],
        ["losed curve", "seen"],
    ),
    (
        "portrait",
        {"starts": [SLOW, 0.99999, -0.2], "impacts": 9},
        ["2 orbits cannot be seen, because all of their points", "A regular orbit has"],
        ["undecided", "Grey", "chaotic", "number"],
    ),
    (
        "portrait",
        {"ball": {"k": 1e-6, "g": 1e-9}, "energy": 1e-7, "starts": [-0.3, 0.2], "impacts": 200},
        ["1 orbit cannot be seen", "Of 400 points 1 is seen"],
        ["regular"],
    ),
    ("exponents", {"starts": ISLANDS[:8]}, ["one colour per orbit", "dark to light"], ["repeat"]),
    (
        "portrait",
        {"starts": [0.5], "impacts": 1},
        ["1 orbit of 1 impact in"],
        ["regular orbit"],
    ),
    ("portrait", {"starts": [-0.2], "impacts": 100}, ["has a colour:"], ["Grey", "number"]),
    ("portrait", {"starts": [0.5, 0.6], "impacts": 9}, ["2 chaotic orbits"], ["losed curve"]),
    ("portrait", {"starts": ISLANDS, "impacts": 9}, ["A number beside", "dark to light"], []),
    (
        "tangle",
        {"branches": {"inner": {"length": 0.05}}},
        ["leave each point", "over 1 orbit in", "cut off"],
        ["meet", "jump", "sharp fold", "chaotic sea"],
    ),
    (
        "tangle",
        {"branches": {"outer": {"length": 1.2}}},
        ["The outer lines"],
        ["inner", "jump"],
    ),
    (
        "tangle",
        {"ball": SHELL, "energy": 0.1, "period": 1, "type": "inverse hyperbolic"},
        ["(black dot)"],
        ["meet", "neighbour", "dots"],
    ),
    ("tangle", {"branches": {"outer": {"length": 0.05}}}, ["leave each"], ["inner"]),
    (
        "closeup",
        {"period": 6},
        ["(a black dot)"],
        ["of the point", "oscillate", "Each crossing", "thick"],
    ),
    (
        "closeup",
        {k: v for k, v in SADDLE.items() if k != "starts"} | {"point": 1, "length": 0.4},
        ["(green, thick)", "(blue, thin)", "the two coincide"],
        [],
    ),
    ("motion", {}, ["every impact (a dot) and"], []),
    ("motion", {"axes": HIGH_UP}, ["every impact and"], ["a dot"]),
    (
        "rotation",
        {},
        ["80 starts from the fixed point to the rim"],
        ["plateau", "monotone", "triangle", "fraction"],
    ),
    ("spread", {}, ["a length. Bars"], ["triangle", "paper", "grey"]),
    ("spread", {"regular": [0.5]}, ["chaotic orbits are grey"], []),
    ("twist", {"energies": [0.0005, 0.002]}, ["At 2 energies"], ["ring"]),
    ("jumps", {"ball": PAPER, "energy": 0.001, "energies": [0.0012]}, [], ["and after it"]),
    (
        "jumps",
        {"ball": PAPER, "energies": [0.002]},
        ["with the curves", "a further"],
        ["three"],
    ),
    ("graph", {}, ["1 orbit of the section, chaotic (pale)"], ["regular"]),
]


HERE = [case for case in CASES if case[0] in KINDS]
LONG = {9, 14, 16, 18, 20}  # these take half of the time


@pytest.mark.parametrize(
    ("kind", "change", "said", "unsaid"),
    [each for i, case in enumerate(HERE) for each in (slowly(case) if i in LONG else [case])],
)
def test_a_sentence_stands_where_it_holds_and_nowhere_else(kind, change, said, unsaid):
    common = {"exponents": EXPONENTS, "portrait": PORTRAIT, "tangle": SADDLE}
    block = checked(kind, **common.get(kind, {}) | change)
    caption = caption_of("one", block, facts(block, computed(block)))
    text = " ".join((caption.shows, caption.see, caption.details))
    assert all(words in text for words in said)
    assert not any(words in text for words in unsaid)


def test_every_kind_that_is_drawn_has_a_caption_with_and_without_data():
    """Without data, no sentence stands that needs some; an unknown name in `d` is an error."""
    for scenes in config.load(SHIPPED).variants.values():
        for name, block in scenes.items():
            assert not block.formats or len(caption_of(name, block.as_mapping()).shows) > 100
    assert CAPTIONS.keys() <= KINDS.keys()
    for folder in PUBLISHED.values():
        committed = manifest.read(ROOT, folder)
        for name, drawing in manifest.published(committed).items():
            record = committed["results"][drawing]
            assert caption_of(Path(name).stem, record["config"], record["output"]).shows


def test_no_caption_has_a_condition_or_points_to_another_picture():
    """Of all kinds' examples, and of all scenes without data."""
    variants = config.load(SHIPPED).variants
    names = [name for group in PUBLISHED for name in variants[group]]
    for scenes in variants.values():
        for block in scenes.values():
            assert_decided(caption_of("one", block.as_mapping()), names)
    for kind in CAPTIONS:
        over = KINDS[kind].drawn_over
        block = checked(over) | yaml.safe_load(example(kind)) if over else checked(kind)
        assert_decided(caption_of("one", block), names)


@pytest.mark.parametrize(
    "text",
    [
        *("near their crossing, if they have one", "to the last start, or the rim if none is"),
        *("It stands where there is room.", "The rest is as for claims/flux.", "as in Figure 3"),
        *("Where lines coincide, they take turns.", "A dot, where the axes show it."),
    ],
)
def test_a_condition_is_noticed(text):
    caption = caption_of("one", checked("portrait", **PORTRAIT | {"starts": [0.5], "impacts": 9}))
    with pytest.raises(AssertionError):
        assert_decided(caption._replace(see=text))


def test_a_caption_says_what_the_axes_hide():
    block = checked("portrait", **PORTRAIT | {"starts": [0.5], "impacts": 9})
    known = facts(block, computed(block)) | {"hidden": ["axes.x hides 3 %: widen it"]}
    assert caption_of("one", block, known).shows.endswith(". Note: axes.x hides 3 %: widen it.")
