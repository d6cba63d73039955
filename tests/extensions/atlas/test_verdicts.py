"""The study of verdicts: their errors, and exponents against those of longer runs."""

import numpy as np
import pytest
from project import ROOT

from extensions.atlas import verdicts


@pytest.mark.slow
def test_wrong_verdicts_are_rare():
    data = verdicts.verdicts(cells=6, orbits=64)
    rows = {str(name): i for i, name in enumerate(data["name"].values)}
    safe, fixed = rows["as soon as safe"], rows["growth below 3"]
    assert np.all(data["wrong"].values[:, safe, -1] < 0.02)
    assert np.all(data["cost"].values[:, safe, -1] < 2000)
    assert np.array_equal(data["cost"].values[:, fixed], [data["length"].values] * 2)
    assert np.all(data["missed"].values + data["alarms"].values == data["wrong"].values)
    gaps = (data["exponent"] - data["exponent_long"]).values
    error = data["exponent_error"].values
    assert np.nanmax(np.abs(gaps) / np.maximum(error, 1e-3)) < 4


def test_nothing_runs_beside_the_study_of_verdicts():
    rules = (ROOT / "src/extensions/atlas/rules.smk").read_text()
    (rule,) = (r for r in rules.split("\nuse rule ") if r.startswith("orbits as verdicts "))
    assert "threads: lambda wildcards: workflow.cores" in rule
