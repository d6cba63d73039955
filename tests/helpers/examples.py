"""The examples of the kinds of picture, computed and drawn."""

import re
import warnings
from contextlib import contextmanager
from importlib import import_module
from textwrap import dedent
from unittest.mock import patch

import numpy as np
import yaml

from helpers.legible import assert_legible
from pipeline.checks.captions import caption_of
from pipeline.checks.quantities import facts, reported
from pipeline.config import ConfigError, check
from pipeline.config.schema.kinds import KINDS
from pipeline.config.schema.parts import STAGES, upstream
from pipeline.declaration import files
from pseudorigid import Ball
from pseudorigid.figures.axes.panel import Panel
from pseudorigid.figures.canvas.render import render

PAPER = {"k": 0.2, "g": 0.04}
SHELL = {"k": 0.3333333333333333, "g": 0.02}
OTHER = {"k": 0.25, "g": 0.03}
# Words of a caption that leaves a condition to the reader, or to another picture.
UNDECIDED = re.compile(
    r"""\b(?: if | may | might | unless | otherwise | perhaps | Where | none\sis | as\sfar\sas
    | where\s(?:there|these|other|the\saxes) | (?:or|and),\swhere
    | rest\sis | (?:as|like)\s(?:for|in|of|on)\s(?:Figure|[`\w]+/|the\s\w+\spicture) )\b""",
    re.VERBOSE,
)


def example(kind):
    """The YAML text of the example scene of a kind."""
    for file in files("examples.yaml").values():
        _, _, text = f"\n{file.read_text(encoding='utf-8')}".partition(f"\n{kind}:\n")
        if text:
            return dedent(text.partition("\n\n")[0]).rstrip()
    raise LookupError(f"{kind}: no example")


def checked(kind, **change):
    """Complete the example of a kind with some fields changed, as the one scene of a config."""
    block = yaml.safe_load(example(kind)) | change
    return check({"ball": PAPER, "scenes": {"one": block}}).scenes["one"].as_mapping()


def function(name):
    """Return the function module.function."""
    module, _, name = name.rpartition(".")
    return getattr(import_module(module), name)


def computed(block):
    """Stage -> its dataset, of a complete block."""
    data, ball, energy = {}, Ball(**block["ball"]), block["energy"]
    for name in upstream(KINDS[block["picture"]].stages):
        stage = STAGES[name]
        fields = {field: block[field] for field in stage.fields.split() if field in block}
        inputs = [data[used] for used in stage.inputs]
        data[name] = function(stage.function)(ball, energy, *inputs, **fields)
        data[name].attrs |= {"k": ball.k, "g": ball.g, "energy": float(energy)}
    return data


def made(block, data=None, legible=True):
    """Draw a complete block; return the picture, its quantities and its caption."""
    kind, data = KINDS[block["picture"]], data or computed(block)
    figure = function(kind.drawn_by)(block, *(data[name] for name in kind.stages))
    if legible:
        assert_legible(figure, slack=5)  # 10^-5 and 10^1 at a corner
    caption = caption_of("one", block, facts(block, data))
    assert_decided(caption)
    return render(figure, "png"), reported(block, data), caption.shows


def assert_decided(caption, others=()):
    """Assert that a caption says what is in its picture, without a condition or another picture."""
    text = " ".join(caption[1:])
    assert not UNDECIDED.search(text), (caption.name, UNDECIDED.search(text)[0])
    for other in others:  # the name of a scene may be an ordinary word
        name = f"`{other}`" if other.isalpha() else rf"(?<![\w/]){other}(?![\w/])"
        assert caption.name == other or not re.search(name, text), other


def assert_made_or_refused_in_one_line(block):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            made(block, legible=False)
        except ValueError as error:
            assert "\n" not in str(error)
            for word in ("array", "convert float", "reduction", "broadcast", "shape"):
                assert word not in str(error)


@contextmanager
def no_clipping():
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

    with patch.object(Panel, "place", checked_place), patch.object(Panel, "dots", checked_dots):
        yield


def refusals(part, block):
    """Return the lines about a block of a part of a config."""
    start = {"picture": "portrait", "energy": 0.01, "starts": [0.5], "impacts": 10}
    document = {"ball": PAPER, "scenes": {"a": start}}
    try:
        check(document | {part: document.get(part, {}) | {"b": block}})
    except ConfigError as error:
        return list(error.lines)
    return []


def assert_bounded(part, kind, at_bound, beyond, line):
    """Assert that a scene at its bound is correct, and beyond it refused in this line.

    Both are changes of the example of the kind. `line` has ... between its parts.
    """
    block = yaml.safe_load(example(kind)) | at_bound
    assert refusals(part, block) == []
    (found,) = refusals(part, block | beyond)
    start, end = line.split(" ... ")
    assert found.startswith(f"{part}.b.{start}") and end in found
