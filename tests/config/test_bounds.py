"""What would need memory without bound is refused before the work; its bound is accepted."""

import pytest
import yaml

from pipeline.config import ConfigError, check

BASE = """
ball: {k: 0.2, g: 0.04}
scenes:
  a: {picture: portrait, energy: 0.01, starts: [0.5], impacts: 10}
"""
CLUSTERS = {
    "picture": "clusters", "energy": 0.01, "between": [0.55, 0.68], "orbits": 100,
    "impacts": 100_000, "cuts": [4], "lags": 4, "resamples": 100_000, "seed": 1,
}  # fmt: skip
FLUX = {
    "picture": "flux", "energy": 0.01, "period": 6, "distance": 1e-5, "grid": 3000,
    "between": [0.55, 0.68], "orbits": 1000, "impacts": 10_000,
}  # fmt: skip
JUMPS = {
    "picture": "jumps", "energy": 0.01, "energies": [0.001], "sides": 100_000, "starts": [0.5],
    "impacts": 10,
}  # fmt: skip
LAST_CURVE = {
    "picture": "last_curve", "energy": 0.01, "nobles": [[0, 5, 1, 15], [0, 5, 1, 17]],
    "convergents": 6, "between": [-0.2, -0.03], "impacts": 10_000_000, "drawn": 5_000_000,
}  # fmt: skip
TANGLE = {
    "picture": "tangle", "energy": 0.01, "period": 6, "type": "hyperbolic", "starts": [0.5],
    "impacts": 10, "branches": {"outer": {"length": 4166.0}},
    "resolution": {"distance": 0.01, "bend": 10},
}  # fmt: skip
SWEEP = {
    "k": {"from": 0.01, "to": 0.3, "count": 1000}, "energy": {"from": 1, "to": 9, "count": 1000},
    "starts": 1, "impacts": 100, "block": 1000,
}  # fmt: skip


def refusals(part, block):
    document = yaml.safe_load(BASE)
    document.setdefault(part, {})["b"] = block
    try:
        check(document)
    except ConfigError as error:
        return list(error.lines)
    return []


@pytest.mark.parametrize(
    ("part", "block", "change", "line"),
    [
        ("claims", CLUSTERS, {"impacts": 100_001}, "impacts: 100001 is not allowed: expected at "
         "most 10000000 impacts in all, orbits times impacts: here 100000"),
        ("claims", CLUSTERS, {"orbits": 101, "impacts": 100}, "resamples: 100000 is not allowed: "
         "expected at most 10000000 orbits drawn, orbits times resamples: here 99009"),
        ("claims", CLUSTERS, {"ball": {"k": 0.2, "g": 1e-9}}, "ball.g: 1e-09 is not allowed: "
         "expected one with flights of at most 1000000 at this energy (here 2.83e+08)"),
        ("claims", FLUX, {"grid": 3001}, "grid: 3001 is not allowed: expected a whole number from "
         "10 to 3000"),
        ("claims", FLUX, {"period": 5}, "period: 5 is not allowed: expected a whole number from 2 "
         "to 12, a multiple of 2"),
        ("claims", FLUX, {"orbits": 1001}, "impacts: 10000 is not allowed: expected at most "
         "10000000 impacts in all, orbits times impacts: here 9990"),
        ("claims", JUMPS, {"sides": 99_998}, "sides: 99998 is not allowed: expected a whole number "
         "from 4 to 100000, a multiple of 4"),
        ("claims", JUMPS, {"energies": [0.001, 9]}, "energies[1]: 9 is not allowed: expected a "
         "number below k/2 - g = 0.06, where the ball could flatten to nothing"),
        ("claims", LAST_CURVE, {"drawn": 5_000_001}, "drawn: 5000001 is not allowed: expected at "
         "most 10000000 points drawn, counted over all nobles"),
        ("claims", LAST_CURVE, {"nobles": [[0, 1000, 1000, 1000]]}, "nobles[0]: [0, 1000, 1000, "
         "1000] is not allowed: expected one whose last convergent has a period from 1 to "
         "10000000, not 8005016005"),
        ("scenes", TANGLE, {"branches": {"inner": {"length": 4167}}}, "branches.inner.length: 4167 "
         "is not allowed: expected at most 10000000 times resolution.distance, shared by 24 "
         "branches = 4166.666666666667"),
        ("sweeps", SWEEP, {"k": {"from": 0.01, "to": 0.3, "count": 1001}}, "energy: [1.0, "
         "1.00800800801, 1.01601601602, 1.02402402402, 1.0320... is not allowed: expected axes "
         "with at most 1000000 cells, here 1001 times 1000"),
    ],
)  # fmt: skip
def test_beyond_its_bound(part, block, change, line):
    assert refusals(part, block) == []
    assert refusals(part, block | change) == [f"{part}.b.{line}"]


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
