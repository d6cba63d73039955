"""A correct config, and ways to spoil it."""

import json

import pytest
import yaml

from pipeline import config

AXES = {"limits": [-1, 1], "ticks": [0]}
SCENES = yaml.safe_load("""
a_portrait:
  {picture: portrait, energy: 0.01, starts: [-0.5, 0.5], impacts: [10, 20],
   view: {elevation: 40, azimuth: 115},
   axes: {x: &axis {limits: [-1, 1], ticks: [0]}, xdot: *axis, udot: *axis}}
a_motion:
  {picture: motion, energy: 0.01, period: 6, type: elliptic, duration: 16,
   formats: [png, svg, pdf],
   axes: {t: {limits: [0, 16], ticks: [0, 16]}, displacement: *axis}}
a_tangle:
  {picture: tangle, energy: 0.01, period: 6, type: hyperbolic, branches: {outer: {length: 2}},
   resolution: &resolution {distance: 0.01, bend: 10}, starts: [0.5], impacts: [10],
   view: {elevation: 40, azimuth: 115}, axes: {x: *axis, xdot: *axis, udot: *axis}}
a_closeup:
  {picture: closeup, energy: 0.01, period: 6, type: hyperbolic, point: 5,
   window: {x: [-0.1, 0.1], xdot: [-0.1, 0.1]}, length: 2, resolution: *resolution,
   axes: {x: *axis, xdot: *axis}}
exponents:
  {picture: exponents, energy: 0.01, starts: [0.5, 0.6], impacts: [2000, 1000], records: 10,
   axes: {impact: {limits: [0, 1000], ticks: [0, 1000]}, exponent: *axis}}
""")
GOOD = {"ball": {"k": 0.2, "g": 0.04}, "scenes": SCENES}


def good():
    """A deep copy of GOOD."""
    return json.loads(json.dumps(GOOD))


def changed(path, value):
    """A copy of GOOD with the value at a dotted path replaced; `...` removes the key."""
    document = good()
    block = document
    *parents, last = (int(key) if key.isdigit() else key for key in path.split("."))
    for key in parents:
        block = block[key]
    if value is ...:
        del block[last]
    else:
        block[last] = value
    return document


def complaints(document):
    """The lines of the error for an incorrect document."""
    with pytest.raises(config.ConfigError) as raised:
        config.check(document)
    assert str(raised.value).splitlines() == list(raised.value.lines)
    return raised.value.lines


def faults(document):
    """The lines about the mistakes in variants of a document that is otherwise correct."""
    found = config.check(document).faulty.values()
    return [*dict.fromkeys(str(mistake) for mistakes in found for mistake in mistakes)]


def complaint(document):
    """The line of the error for a document with one mistake."""
    (line,) = complaints(document)
    return line
