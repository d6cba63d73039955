"""Bounds: a value beyond one is refused before the work, a value at it is accepted."""

import pytest
import yaml

from pipeline.config import ConfigError, check
from pipeline.config.reference import example

BASE = """
ball: {k: 0.2, g: 0.04}
scenes:
  a: {picture: portrait, energy: 0.01, starts: [0.5], impacts: 10}
"""
SWEEP = {
    "k": {"from": 0.01, "to": 0.3, "count": 1000}, "energy": {"from": 1, "to": 9, "count": 1000},
    "starts": 1, "impacts": 100, "block": 1000,
}  # fmt: skip
# Blocks at their bounds: changes of the kinds' examples, or whole blocks.
CLUSTERS = ("claims", "clusters", {"orbits": 100, "impacts": 100_000, "resamples": 100_000})
FLUX = ("claims", "flux", {"orbits": 1000, "impacts": 10_000})
CONTROL = ("claims", "control", {"orbits": 100_000, "resamples": 100, "impacts": 3_333_333})
JUMPS = ("claims", "jumps", {})
LAST_CURVE = (
    "claims", "last_curve",
    {"nobles": [[0, 5, 1, 15], [0, 5, 1, 17]], "impacts": 10_000_000, "drawn": 5_000_000},
)  # fmt: skip
TANGLE = (
    "scenes", "tangle",
    {"period": 6, "branches": {"outer": {"length": 4166.0}},
     "resolution": {"distance": 0.01, "bend": 10}},
)  # fmt: skip
PLANE = ("sweeps", None, SWEEP)
LONG_CUT = ("claims", "clusters", {"ball": {"k": 0.2, "g": 0.04}, "energy": 0.01, "cuts": [4, 8]})
GRAPH, CURVES = ("proofs", "graph", {}), ("proofs", "curves", {})
FAMILIES = ("families", "families", {"ball": {"k": 0.2, "g": 0.04}})
SHELL = {"k": 0.3333333333333333, "g": 0.02}
TWIST = ("proofs", "twist", {"marks": []})
ROTATION, SPREAD = ("claims", "rotation", {}), ("claims", "spread", {})


def refusals(part, block):
    document = yaml.safe_load(BASE)
    document.setdefault(part, {})["b"] = block
    try:
        check(document)
    except ConfigError as error:
        return list(error.lines)
    return []


@pytest.mark.parametrize(
    ("bounded", "change", "key", "bound"),
    [
        (CLUSTERS, {"impacts": 100_001}, "impacts: 100001", "here 100000"),
        (CLUSTERS, {"orbits": 101, "impacts": 100}, "resamples: 100000", "here 99009"),
        (CLUSTERS, {"ball": {"k": 0.2, "g": 1e-9}}, "energy: ", "flights up to 1000000/omega"),
        (CLUSTERS, {"between": [0.68, 0.55]}, "between: [0.68, 0.55]", "two increasing"),
        (CLUSTERS, {"lags": 99, "impacts": 100, "orbits": 2}, "lags: 99", "impacts - 2 = 98"),
        (LONG_CUT, {"cuts": [4, 10]}, "cuts[1]: 10", "below 8.367, which no flight at this energy"),
        (GRAPH, {"energy": 0.006}, "energy: 0.006", "k = 0.2 and this g, one of 0.005, 0.01"),
        (GRAPH, {"ball": {"k": 0.3, "g": 0.04}}, "energy: 0.005", "with k = 0.2"),
        (CURVES, {"rotation_numbers": [0.104, 0.25]}, "rotation_numbers[1]: 0.25",
         "too close to a fraction of small integers: the nearest that are not are 0.2499 and 0.25"),
        (CURVES, {"ball": SHELL, "energy": 0.015}, "energy: 0.015", "below 0.0138241"),
        (FAMILIES, {"step": 0.03}, "step: 0.03", "two multiples or more in the span"),
        (CONTROL, {"shown": 0.02}, "shown: 0.02", "one of strengths: 0.01, 0.05"),
        (CONTROL, {"strengths": [0.05, 0.01]}, "strengths: ", "a rising list"),
        (CONTROL, {"impacts": 3_333_334}, "impacts: 3333334", "at most 10000000"),
        (CONTROL, {"drawn": 3_333_334}, "drawn: 3333334", "at most impacts = 3333333"),
        (CONTROL, {"resamples": 101}, "resamples: 101", "here 100"),
        (FLUX, {"period": 5}, "period: 5", "a multiple of 2"),
        (FLUX, {"orbits": 1001}, "impacts: 10000", "here 9990"),
        (JUMPS, {"energies": [0.001, 9]}, "energies[1]: 9", "k/2 - g = 0.1466"),
        (LAST_CURVE, {"drawn": 5_000_001}, "drawn: 5000001", "at most 10000000"),
        (LAST_CURVE, {"nobles": [[0, 1000, 1000, 1000]], "convergents": 6}, "nobles[0]: ",
         "to 10000000, not 8005016005"),
        (TANGLE, {"branches": {"inner": {"length": 4167}}}, "branches.inner.length: 4167",
         "24 branches = 4166.666666666667"),
        (PLANE, {"k": {"from": 0.01, "to": 0.3, "count": 1001}}, "energy: [1.0, ",
         "at most 1000000 cells"),
        (FAMILIES, {"span": [-0.004, 0.01]}, "span[0]: -0.004", "above -g^2/(2k)"),
        (FAMILIES, {"parameter": "k", "span": [0, 0.3]}, "span: [0, 0.3]", "0 < k <= 1"),
        (FAMILIES, {"step": 1e-6}, "step: 1e-06", "2000 values in the span"),
        (FAMILIES, {"drawn": 7}, "drawn: 7", "at most period = 6"),
        # What a kind cannot show.
        (TWIST, {"ball": SHELL, "energies": [0.01, 0.016]}, "energies[1]", "0.0138241"),
        (ROTATION, {"ball": SHELL, "energy": 0.015}, "energy: 0.015", "below 0.0138241"),
        (LAST_CURVE, {"ball": SHELL, "energy": 0.015}, "energy: 0.015", "below 0.0138241"),
        (LAST_CURVE, {"between": [0.2, 0.2]}, "between: [0.2, 0.2]", "two fractions that differ"),
        (SPREAD, {"blocks": 30}, "blocks: 30", "a divisor of length = 2000"),
    ],
)  # fmt: skip
def test_beyond_its_bound(bounded, change, key, bound):
    part, kind, block = bounded
    if kind:
        block = yaml.safe_load(example(kind)) | block
    assert refusals(part, block) == []
    (line,) = refusals(part, block | change)
    assert line.startswith(f"{part}.b.{key}") and bound in line


def test_a_value_of_any_size_is_shortened_to_a_line():
    text = "&a [x, x, x, x, x, x, x, x, x, x]"
    for name in "bcdefghi":  # 10^9 values, and more as text than memory holds
        text += f", &{name} [{', '.join(['*' + chr(ord(name) - 1)] * 10)}]"
    document = yaml.safe_load(BASE.replace("[0.5]", f"[{text}]"))
    document["scenes"]["a"]["impacts"] = 16**5000
    with pytest.raises(ConfigError) as error:
        check(document)
    assert all(len(line) < 250 for line in error.value.lines)
    assert len(error.value.lines) == 10
