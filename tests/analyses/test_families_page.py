"""The numbers of docs/families.md are those of the datasets that ./reproduce families makes."""

import re

import numpy as np
import pytest
from project import ROOT

from pipeline.checks.freshness import Freshness
from pipeline.config import build_specs, load
from pipeline.records import artifacts

PAGE = (ROOT / "docs" / "families.md").read_text(encoding="utf-8")
# The page is wrapped; sentences are compared without line breaks.
TEXT = " ".join(PAGE.split())


@pytest.fixture(scope="module")
def datasets():
    paths = [f"results/families/{stage}_energy.nc" for stage in ("families", "shares")]
    fresh = Freshness(ROOT, build_specs.of_all(load(ROOT / "config.yaml")))
    if fresh.outdated(paths):
        pytest.skip("the families are not made, or not current: run ./reproduce families")
    return [artifacts.load(ROOT / path) for path in paths]


def named(families, number):
    """A family as the page names it: by its period and the range of its energies."""
    period = int(families["period"].values[number])
    if period == 1:
        return "fixed point"
    size = families["row_size"].values
    end = int(np.cumsum(size)[number])
    energies = families["energy"].values[end - size[number] : end]
    return f"period {period} ({energies.min():.4f} to {energies.max():.4f})"


def test_long_numbers_are_energies_of_events_or_ends(datasets):
    families, shares = datasets
    known = np.concatenate(
        [families[name].values.ravel() for name in ("event_energy", "end_energy")]
        + [shares["breakup_at"].values]
    )
    numbers = re.findall(r"(?<![\d.])-?0\.\d{5,12}(?!\d)", PAGE)
    assert len(numbers) > 50
    for text in numbers:
        digits = len(text.partition(".")[2])
        assert text in {f"{value:.{digits}f}" for value in known.tolist()}, text


def test_the_resonances_of_the_fixed_point_are_listed(datasets):
    families, _ = datasets
    of_fixed = families["period"].values[families["event_family"].values] == 1
    chosen = of_fixed & (families["event_kind"].values == "resonance")
    assert np.sum(chosen) >= 12
    for i in np.flatnonzero(chosen).tolist():
        p, q = (int(families[f"event_{name}"].values[i]) for name in ("turns", "order"))
        assert f"| {p}/{q} | {families['event_energy'].values[i]:.12f} |" in PAGE


def test_ends_are_counted(datasets):
    families, _ = datasets
    kinds = families["end_kind"].values
    assert families.attrs["unresolved"] == 0
    lines = families["line"].values
    text = f"{lines.size} families, {np.sum(lines == 'none')} of them without symmetry"
    assert text in TEXT
    assert np.all(np.isin(kinds, ["range", "resonance", "doubling", "pitchfork", "touch", "rim"]))


def test_the_table_of_slopes_is_that_of_the_dataset(datasets):
    families, shares = datasets
    for i in range(shares.sizes["slope"]):
        first, last, change = (
            float(shares[f"slope_{name}"].values[i]) for name in ("from", "to", "change")
        )
        parts = ", ".join(
            f"{named(families, number)} {part:.2f}"
            for number, part in zip(
                shares["slope_family"].values[i].tolist(),
                shares["slope_part"].values[i].tolist(),
                strict=True,
            )
            if abs(part) >= 0.005
        )
        assert f"| {first:.4f} | {last:.4f} | {change:+.4f} | {parts} |" in PAGE


def test_the_table_of_extrema_is_that_of_the_dataset(datasets):
    families, shares = datasets
    for i in range(shares.sizes["extremum"]):
        kind, at, cause = (
            shares[name].values[i] for name in ("extremum_kind", "extremum_at", "cause_event")
        )
        for side in (0, 1):
            value, number, part, event, place = (
                shares[f"side_{name}"].values[i, side]
                for name in ("at", "family", "part", "event", "event_at")
            )
            where = f"{kind} {at:.4f} | {value:.4f} | {named(families, int(number))}"
            assert f"| {where} | {part:.2f} | {event} at {place:.5f} | {cause} |" in PAGE


def test_the_table_of_the_main_island_is_that_of_the_dataset(datasets):
    _, shares = datasets
    turns, orders = (shares[f"resonance_{name}"].values.tolist() for name in ("turns", "order"))
    ratios = list(zip(turns, orders, strict=True))
    energies, regular = shares["energy"].values, shares["regular"].values
    events = shares["breakup_event"].values.tolist()
    for p, q in ((1, 7), (1, 6), (2, 11), (1, 5), (2, 9)):
        beyond = shares["beyond"].values[:, ratios.index((p, q))]
        last = max(i for i in range(beyond.size) if beyond[i] > 0.002)
        cells = [
            f"{energies[i]:.4f} | {beyond[i]:.4f} | {regular[i]:.4f}" for i in (last, last + 1)
        ]
        broken = shares["breakup_at"].values[events.index(f"last curve beyond {p}/{q} breaks")]
        assert energies[last] <= broken <= energies[last + 1]
        assert f"| {p}/{q} | {cells[0]} | {cells[1]} | {broken:.5f} |" in PAGE


def test_the_first_minimum_has_the_last_curve_beyond_a_fifth_as_its_cause(datasets):
    _, shares = datasets
    assert shares["cause_event"].values.tolist().count("unexplained") == 4
    assert shares["cause_event"].values[0] == "last curve beyond 1/5 breaks"
    events = dict(zip(shares["breakup_event"].values, shares["breakup_at"].values, strict=True))
    forms = events["first curve beyond 2/7 forms"]
    assert f"first curve beyond 2/7 forms at {forms:.5f}." in TEXT
    assert forms > 0.0550 + 0.0005


def test_at_the_papers_energy_regular_orbits_are_in_the_island_or_in_its_six(datasets):
    families, shares = datasets
    (row,) = np.flatnonzero(np.isclose(shares["energy"].values, 0.01))
    share = shares["share"].values[row]
    held = sorted(int(families["period"].values[i]) for i in np.flatnonzero(share))
    assert held == [1, 6]
    assert share.sum() == pytest.approx(float(shares["regular"].values[row]))
