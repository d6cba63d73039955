"""Descriptions of differences between blocks of config, sets of packages, and datasets."""

import pytest

from pipeline.records.differences import differing_data, differing_keys, differing_layers

STARTS = [0.1, {"x": 0.2, "xdot": 0.0}, 0.3]


@pytest.mark.parametrize(
    ("before", "after", "expected"),
    [
        ([1500, 2500, 3000, 4000], [1500, 2500, 3000, 4001], [("a[3]", 4000, 4001)]),
        ([1, 2, 3], [9, 9, 3], [("a[0]", 1, 9)]),
        (STARTS, [0.1, {"x": 0.2, "xdot": 0.5}, 0.4], [("a[1].xdot", 0.0, 0.5)]),
        ([1, 2], [1, 2, 3], [("a: number of entries", 2, 3)]),
        ([1, 2], [0], [("a[0]", 1, 0), ("a: number of entries", 2, 1)]),
        ([1, 2], 5, [("a", [1, 2], 5)]), ([1], [1.0], [("a[0]", 1, 1.0)]),
        ([True], [1], [("a[0]", True, 1)]), ([1, 2], [1, 2], []),
    ],
)  # fmt: skip
def test_the_first_entry_of_a_list_that_differs_is_named(before, after, expected):
    assert list(differing_keys({"a": before}, {"a": after})) == expected


def test_every_field_and_every_package_that_differs_is_named():
    block = {"impacts": 60, "records": 6, "axes": {"t": {"limits": [0, 1]}}}
    other = {"impacts": 61, "records": 7, "axes": {"t": {"limits": [0, 2]}}, "sea": [1]}
    packages = {"numpy": "1", "numba": "2", "xarray": "3"}
    before = {"config": block, "sources": {"a.py": "0"}, "environment": packages}
    after = before | {"config": other, "environment": {"numpy": "2", "xarray": "3"}}
    assert differing_layers(before, after) == {
        "config": "axes.t.limits[1] 1 -> 2; impacts 60 -> 61; records 6 -> 7; sea nothing -> [1]",
        "environment": "numba 2 then, not installed here; numpy 1 then, 2 here",
    }
    assert differing_layers(before, before) == {}


VARIABLE = {"dims": ["t"], "dtype": "<f8", "shape": [2050], "attributes": {"units": "0"}}
VARIABLE |= {"sha256": "0"}
DATA = {"attributes": {"energy": "0", "k": "0"}, "variables": {"x": VARIABLE}}
OTHERS = [
    ({}, None),
    ({"attributes": {"k": "0"}}, "attribute energy differs"),
    ({"attributes": {"k": "1", "g": "0"}}, "attributes energy, g, k differ"),
    ({"variables": {}}, "variable x is gone"),
    ({"variables": {"x": VARIABLE, "y": VARIABLE}}, "variable y is new"),
    (
        {"variables": {"x": VARIABLE | {"shape": [2]}}},
        "variable x: another shape: [2050] then, [2] now",
    ),
    ({"variables": {"x": VARIABLE | {"sha256": "1"}}}, "variable x differs"),
]


@pytest.mark.parametrize(("other", "words"), OTHERS)
def test_data_of_other_bytes_differ_by_their_content(other, words):
    assert differing_data(DATA, DATA | other) == words
