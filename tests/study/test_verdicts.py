"""The study of verdicts: what it counts, against runs a hundred times as long."""

import numpy as np
import pytest

from pseudorigid.study import verdicts


@pytest.mark.slow
def test_wrong_verdicts_are_rare():
    """Against runs a hundred times as long as 4,000 impacts, on cells of their own."""
    data = verdicts.verdicts(cells=6, orbits=64)
    last = {str(name): i for i, name in enumerate(data["name"].values)}
    safe, before = last["as soon as safe"], last["growth below 3"]
    assert np.all(data["wrong"].values[:, safe, -1] < 0.02)
    assert np.all(data["cost"].values[:, safe, -1] < 2000)
    assert np.array_equal(data["cost"].values[:, before], [data["length"].values] * 2)
    assert np.all(data["missed"].values + data["alarms"].values == data["wrong"].values)
    gaps = (data["exponent"] - data["exponent_long"]).values
    error = data["exponent_error"].values
    assert np.nanmax(np.abs(gaps) / np.maximum(error, 1e-3)) < 4
