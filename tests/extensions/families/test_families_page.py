"""The numbers of the page of the families are those of the datasets that it describes."""

import re

import numpy as np
import pytest

from helpers.project import ROOT
from pipeline.config import load
from pipeline.records import artifacts
from pipeline.records.provenance import Freshness
from pseudorigid.dynamics.variables import rows

PAGE = (ROOT / "src/extensions/families/README.md").read_text(encoding="utf-8")
EVENTS = (ROOT / "src/extensions/families/events.csv").read_text(encoding="utf-8")
SHARES = ("breakup_at", "energy", "regular", "beyond", "extremum_at", "side_at", "side_event_at",
          "slope_from", "slope_to", "slope_change")  # fmt: skip


@pytest.fixture(scope="module")
def datasets():
    paths = [f"results/families/{stage}_energy.nc" for stage in ("families", "shares")]
    fresh = Freshness(ROOT, load(ROOT / "config.yaml").build_specs())
    if fresh.outdated(paths):
        pytest.skip("the families are not made, or not current: run ./reproduce families")
    return [artifacts.load(ROOT / path) for path in paths]


def test_numbers_are_those_of_events_ends_and_shares(datasets):
    """Of the tables from four digits on, of sentences from five."""
    families, shares = datasets
    energies = [families["energy"].values[part] for part in rows(families)]
    known = [families[name].values for name in ("event_energy", "end_energy")]
    known += [np.array([(part.min(), part.max()) for part in energies])]
    known += [shares[name].values for name in SHARES]
    known = np.abs(np.concatenate([values.ravel() for values in known]))
    number, tables = r"(?<![\d.])0\.\d{%s}(?!\d)", re.findall(r"^\|.*$", PAGE, re.MULTILINE)
    numbers = re.findall(number % "5,12", PAGE + EVENTS)
    numbers += re.findall(number % "4", " ".join(tables))
    assert len(numbers) > 100
    for digits in {len(text) - 2 for text in numbers}:
        rounded = {f"{value:.{digits}f}" for value in known.tolist()}
        assert {text for text in numbers if len(text) - 2 == digits} - rounded == set()
