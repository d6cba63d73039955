"""Bounds: a value beyond one is refused before the work, a value at it is accepted."""

import pytest
from documents import good
from examples import assert_bounded

from pipeline.config import ConfigError, check


def test_beyond_a_bound_of_several_fields():
    at_bound = {"period": 6, "branches": {"outer": {"length": 4166.0}},
                "resolution": {"distance": 0.01, "bend": 10}}  # fmt: skip
    line = "branches.inner.length: 4167 ... 24 branches = 4166.666666666667"
    beyond = {"branches": {"inner": {"length": 4167}}}
    assert_bounded("scenes", "tangle", at_bound, beyond, line)


def test_a_value_of_any_size_is_shortened_to_a_line():
    value = "x"
    for _ in range(9):  # 10^9 values, and more as text than memory holds
        value = [value] * 10
    document = good()
    document["scenes"]["a_portrait"] |= {"starts": value, "impacts": 16**5000}
    with pytest.raises(ConfigError) as error:
        check(document)
    assert all(len(line) < 250 for line in error.value.lines)
    assert len(error.value.lines) == 11
