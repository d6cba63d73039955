"""Scenes of claims away from the committed ones: bounds, variants, names and unusual sizes."""

import pytest

from helpers.examples import OTHER, PAPER, SHELL, assert_bounded, checked, made, no_clipping
from helpers.project import shipped
from helpers.slowly import slowly
from pipeline import config

CLUSTERS = ("clusters", {"orbits": 100, "impacts": 1_000_000, "resamples": 100_000})
FLUX = ("flux", {"orbits": 1000, "impacts": 10_000})
CONTROL = ("control", {"orbits": 100_000, "impacts": 3_333_333})
JUMPS, SPREAD = ("jumps", {}), ("spread", {})
LAST_CURVE = (
    "last_curve",
    {"nobles": [[0, 5, 1, 15], [0, 5, 1, 17]], "drawn": 5_000_000},
)
LONG_CUT = ("clusters", {"ball": PAPER, "energy": 0.01, "cuts": [4, 8]})


@pytest.mark.parametrize(("scene", "beyond", "line"), [
    (CLUSTERS, {"impacts": 1_000_001}, "impacts: 1000001 ... here 1000000"),
    (CLUSTERS, {"orbits": 101, "impacts": 100}, "resamples: 100000 ... here 99009"),
    (CLUSTERS, {"ball": {"k": 0.2, "g": 1e-9}}, "energy:  ... flights up to 1000000/omega"),
    (CLUSTERS, {"lags": 99, "impacts": 100, "orbits": 2}, "lags: 99 ... impacts - 2 = 98"),
    (LONG_CUT, {"cuts": [4, 10]}, "cuts[1]: 10 ... below 8.367, which no flight at this energy"),
    (CONTROL, {"shown": 0.02}, "shown: 0.02 ... one of strengths: 0.01, 0.05"),
    (CONTROL, {"drawn": 3_333_334}, "drawn: 3333334 ... at most impacts = 3333333"),
    (FLUX, {"period": 5}, "period: 5 ... a multiple of 2"),
    (JUMPS, {"energies": [0.001, 9]}, "energies[1]: 9 ... k/2 - g = 0.1466"),
    (LAST_CURVE, {"nobles": [[0, 1000, 1000, 1000]], "convergents": 6},
     "nobles[0]:  ... to 10000000, not 8005016005"),
    (LAST_CURVE, {"ball": SHELL, "energy": 0.015}, "energy: 0.015 ... below 0.0138241"),
    (LAST_CURVE, {"between": [0.2, 0.2]}, "between: [0.2, 0.2] ... two fractions that differ"),
    (SPREAD, {"blocks": 30}, "blocks: 30 ... a divisor of length = 2000"),
])  # fmt: skip
def test_beyond_its_bound(scene, beyond, line):
    assert_bounded("claims", *scene, beyond, line)


@pytest.mark.parametrize(("name", "change"), [
    ("rotation", {"ball": OTHER, "energy": 0.008, "energies": [0.002, 0.012]}),
    ("clusters", {"ball": {"k": 0.3, "g": 0.005}, "energy": 0.01, "lags": 20,
                  "cuts": [10, 20, 30, 35, 40, 45, 50]}),
    ("jumps", {"ball": PAPER, "energy": 0.001, "energies": [0.0005]}),
    ("last_curve", {"ball": PAPER, "energy": 0.01, "between": [-0.2, -0.0325639],
                    "nobles": [[0, 5, 1, 10 + i] for i in range(8)]}),
    ("spread", {"ball": PAPER, "energy": 0.005, "orbits": 4, "blocks": 2, "length": 100_000}),
    *slowly(
        ("control", {"ball": OTHER, "energy": 0.008, "strengths": [0.02], "shown": 0.02}),
    ),
])  # fmt: skip
def test_no_data_are_clipped_to_the_frame(name, change):
    with no_clipping():
        made(checked(name, **change))


def test_a_scale_multiplies_every_energy_and_no_number_of_starts():
    document = shipped()
    document["scenes"] = {name: document["claims"][name] for name in ("rotation", "jumps")}
    document["scenes"]["along_energy"] = document["families"]["energy"]
    against_k = {"parameter": "k", "span": [0.15, 0.3], "step": 0.01}
    document["scenes"]["against_k"] = document["scenes"]["along_energy"] | against_k
    document |= {"variants": {"v": {"scale": 2}}, "claims": {}, "families": {}}
    scenes = config.check(document).variants["v"]
    assert (scenes["rotation"].energies[0], scenes["rotation"].starts) == (0.004, 600)
    assert scenes["jumps"].energies == [0.004, 0.0072, 0.01, 0.02]
    families = scenes["along_energy"]
    assert (families.span, families.step) == ([-0.0156, 0.2396], 0.002)
    assert (scenes["against_k"].span, scenes["against_k"].step) == ([0.15, 0.3], 0.01)
