"""Descriptions of differences between blocks of config and sets of packages."""

import pytest

from pipeline.records.differences import differing_keys, differing_layers

STARTS = [0.1, {"x": 0.2, "xdot": 0.0}, 0.3]


@pytest.mark.parametrize(
    ("before", "after", "expected"),
    [
        ([1500, 2500, 3000, 4000], [1500, 2500, 3000, 4001], [("a[3]", 4000, 4001)]),
        ([1, 2, 3], [9, 9, 3], [("a[0]", 1, 9)]),
        (STARTS, [0.1, {"x": 0.2, "xdot": 0.5}, 0.4], [("a[1].xdot", 0.0, 0.5)]),
        ([1, 2], [1, 2, 3], [("a: number of entries", 2, 3)]),
        ([1, 2], [0], [("a[0]", 1, 0), ("a: number of entries", 2, 1)]),
        ([1, 2], 5, [("a", [1, 2], 5)]),
        ([1], [1.0], [("a[0]", 1, 1.0)]),
        ([True], [1], [("a[0]", True, 1)]),
        ([1, 2], [1, 2], []),
    ],
)
def test_the_first_entry_of_a_list_that_differs_is_named(before, after, expected):
    assert list(differing_keys({"a": before}, {"a": after})) == expected


def test_every_field_and_every_package_that_differs_is_named():
    block = {"impacts": 60, "records": 6, "axes": {"t": {"limits": [0, 1]}}}
    other = {"impacts": 61, "records": 7, "axes": {"t": {"limits": [0, 2]}}, "sea": [1]}
    packages = {"numpy": "1", "numba": "2", "xarray": "3"}
    before = {"config": block, "sources": {"a.py": "0"}, "environment": packages}
    before |= {"inputs": {"a.nc": "0"}, "output": {"sha256": "0"}}
    after = before | {"config": other, "environment": {"numpy": "2", "xarray": "3"}}
    assert differing_layers(before, after) == {
        "config": "axes.t.limits[1] 1 -> 2; impacts 60 -> 61; records 6 -> 7; sea nothing -> [1]",
        "environment": "numba 2 then, not installed here; numpy 1 then, 2 here",
    }
    assert differing_layers(before, before) == {}


VARIABLE = {"dims": ["t"], "dtype": "<f8", "shape": [2050], "attributes": {"units": "0"}}
VARIABLE |= {"sha256": "0", "blocks": "a b c"}
DATA = {"sha256": "0", "attributes": {"energy": "0", "k": "0"}, "variables": {"x": VARIABLE}}
OTHERS = [
    ({"attributes": {"k": "0"}}, "a.nc: attribute energy differs"),
    ({"attributes": {"k": "1", "g": "0"}}, "a.nc: attributes energy, g, k differ"),
    ({"variables": {}}, "a.nc: variable x is gone"),
    ({"variables": {"x": VARIABLE, "y": VARIABLE}}, "a.nc: variable y is new"),
    (
        {"variables": {"x": VARIABLE | {"shape": [2]}}},
        "a.nc: variable x: another shape: [2050] then, [2] now",
    ),
    (
        {"variables": {"x": VARIABLE | {"sha256": "1", "blocks": "a x c"}}},
        "a.nc: variable x differs from value 1,024 of 2,050 on",
    ),
    ({"error": "a.nc: damaged"}, "a.nc: damaged"),
]


@pytest.mark.parametrize(("other", "words"), [*OTHERS, ({}, None)])
def test_data_of_other_bytes_differ_by_their_content(other, words):
    before = {"config": {}, "sources": {}, "environment": {}, "output": {"sha256": "0"}}
    after = before | {"inputs": {"a.nc": DATA | {"sha256": "1"} | other}}
    layers = differing_layers(before | {"inputs": {"a.nc": DATA}}, after)
    assert layers == ({"data": words} if words else {})


@pytest.mark.parametrize(
    ("output", "layers"),
    [
        ({"sha256": "0", "drawing": "0"}, {}),
        ({"sha256": "1"}, {"file": "changed after it was made"}),
        ({"sha256": "1", "drawing": "0"}, {"file": "a.png: the same picture in other bytes"}),
        ({"sha256": "1", "drawing": "1"}, {"drawing": "a.png: another picture"}),
        ({"sha256": "1", "error": "a.png: damaged"}, {"drawing": "a.png: damaged"}),
        ({"sha256": None, "error": "a.png is missing"}, {"file": "a.png is missing"}),
    ],
)
def test_a_picture_differs_in_its_drawing_or_its_file(output, layers):
    record = {"config": {}, "sources": {}, "environment": {}, "inputs": {}}
    before = record | {"output": {"sha256": "0", "drawing": "0"}}
    assert differing_layers(before, record | {"output": {"file": "a.png"} | output}) == layers


def test_an_input_of_another_hash_is_named():
    record = {"config": {}, "sources": {}, "environment": {}, "output": {"sha256": "0"}}
    before, after = ({"a.nc": "0", "b.nc": digest} for digest in ("0", "1"))
    layers = differing_layers(record | {"inputs": before}, record | {"inputs": after})
    assert layers == {"data": "b.nc"}
    for described in (before, after):  # whose content is described in one record alone
        other = record | {"inputs": described | {"b.nc": DATA | {"sha256": "2"}}}
        assert differing_layers(record | {"inputs": before}, other) == layers
        assert differing_layers(other, record | {"inputs": before}) == layers
