"""Sweeps of the config: their axes written out, and what is refused."""

import numpy as np
import pytest

from helpers.documents import complaint, good
from pipeline import config

SMALL = {"k": [0.1, 0.2], "energy": [0.3, 2.0, 6.25], "starts": 12, "impacts": 200, "block": 2}
RANGE = {"from": 0.1, "to": 10, "count": 3}
LOG = {"spacing": "log"}


def document(**fields):
    return good() | {"sweeps": {"a": SMALL | fields}}


def check(**fields):
    return config.check(document(**fields)).variants["atlas"]["a"].as_mapping()


def test_axes_are_the_decimals_they_are_meant_to_be():
    sweep = check(k={"from": 0.016, "to": 0.328, "count": 40}, energy=RANGE | LOG)
    assert sweep["k"][:4] == [0.016, 0.024, 0.032, 0.04]
    assert sweep["k"][23] == 0.2
    assert sweep["energy"] == [0.1, 1.0, 10.0]
    many = check(energy={"from": 0.1, "to": 40, "count": 40} | LOG)["energy"]
    assert (many[1], many[-2]) == (0.116606, 34.3037)
    ratios = np.array(many[1:]) / np.array(many[:-1])
    assert ratios.max() / ratios.min() < 1 + 2e-5


@pytest.mark.parametrize(("fields", "start", "allowed"), [
    ({"k": []}, "k: []", "at least one"),
    ({"k": "all"}, "k: 'all'", "a list of numbers, or a mapping with from, to and count"),
    ({"energy": RANGE | {"to": 0.1}}, "energy.to: 0.1", "above from = 0.1"),
    ({"energy": RANGE | {"spacing": "lg"}}, "energy.spacing: 'lg'", "one of even, log"),
    ({"energy": RANGE | {"form": 3}}, "energy.form", "did you mean from?"),
    ({"energy": [2, 1]}, "energy: [2, 1]", "increasing"),
    ({"energy": LOG | {"from": 1, "to": 1.00001, "count": 90}}, "energy: ", "six digits"),
    ({"k": [0, 0.2]}, "k: 0", "0 < k <= 1"),
    ({"energy": [-2.5, 1]}, "energy: -2.5", "above -1/(2k) = -2.5"),
    ({"g": 0.1}, "g: 0.1", "0 < g < k = 0.1"),
    ({"g": 0.04}, "energy: 6.25", "below (k/2 - g)/g^2 = 6.25"),
    ({"starts": 10**6, "impacts": 10**7}, "impacts: 10000000", "in a sweep"),
    ({"energy": {"from": 1, "to": 9, "count": 10_000}}, "block: 2", "at least 4 cells"),
    ({"energy": {"from": 1, "to": 9, "count": 1001}}, "energy: [1.0,", "at most 1000 energies"),
    ({"k": {"from": 0.1, "to": 0.9, "count": 1601}}, "energy: [0.3,", "1600 values of k"),
])  # fmt: skip
def test_a_sweep_that_cannot_be_is_refused_in_one_line(fields, start, allowed):
    line = complaint(document(**fields))
    assert line.startswith(f"sweeps.a.{start}") and allowed in line
