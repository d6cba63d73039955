"""The numbers of the page of the families are those of the datasets that it describes."""

import re

import numpy as np
import pytest
from project import ROOT

from pipeline.checks.freshness import Freshness
from pipeline.config import load
from pipeline.records import artifacts

PAGE = (ROOT / "src/extensions/families/README.md").read_text(encoding="utf-8")
# The page is wrapped; sentences are compared without line breaks.
TEXT = " ".join(PAGE.split())


@pytest.fixture(scope="module")
def datasets():
    paths = [f"results/families/{stage}_energy.nc" for stage in ("families", "shares")]
    fresh = Freshness(ROOT, load(ROOT / "config.yaml").build_specs())
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


def rows(dataset, *names):
    """Rows of variables, as Python's numbers and words."""
    return list(zip(*(dataset[name].values.tolist() for name in names), strict=True))


def expected(families, shares):
    """The lines of the page's tables, and the count of families."""
    of_fixed = families["period"].values[families["event_family"].values] == 1
    events = rows(families, *(f"event_{name}" for name in ("kind", "turns", "order", "energy")))
    for chosen, (kind, p, q, energy) in zip(of_fixed, events, strict=True):
        if chosen and kind == "resonance":
            yield f"| {p}/{q} | {energy:.12f} |"
    lines = families["line"].values.tolist()
    yield f"{len(lines)} families, {lines.count('none')} of them without symmetry"
    slopes = rows(shares, *(f"slope_{n}" for n in ("from", "to", "change", "family", "part")))
    for first, last, change, *largest in slopes:
        parts = ", ".join(
            f"{named(families, number)} {part:.2f}"
            for number, part in zip(*largest, strict=True)
            if abs(part) >= 0.005
        )
        yield f"| {first:.4f} | {last:.4f} | {change:+.4f} | {parts} |"
    sides = rows(
        shares, *(f"side_{name}" for name in ("at", "family", "part", "event", "event_at"))
    )
    extrema = rows(shares, "extremum_kind", "extremum_at", "cause_event")
    for (kind, at, _), pair in zip(extrema, sides, strict=True):
        for value, number, part, event, place in zip(*pair, strict=True):
            where = f"{kind} {at:.4f} | {value:.4f} | {named(families, number)}"
            yield f"| {where} | {part:.2f} | {event} at {place:.5f} |"
    caused = [f"the {kind} at {at:.4f}, where the {cause}:" for kind, at, cause in extrema
              if cause != "unexplained"]  # fmt: skip
    yield f"**One of five extrema has a cause by this rule**, {caused[0]}"
    assert len(caused) == 1 and len(extrema) == 5
    broken = dict(rows(shares, "breakup_event", "breakup_at"))
    ratios = rows(shares, "resonance_turns", "resonance_order")
    values = rows(shares, "energy", "regular")
    for p, q in ((1, 7), (1, 6), (2, 11), (1, 5), (2, 9)):
        beyond = shares["beyond"].values[:, ratios.index((p, q))]
        last = int(np.flatnonzero(beyond > 0.002)[-1])
        cells = [f"{values[i][0]:.4f} | {beyond[i]:.4f} | {values[i][1]:.4f}"
                 for i in (last, last + 1)]  # fmt: skip
        at = broken[f"last curve beyond {p}/{q} breaks"]
        assert values[last][0] <= at <= values[last + 1][0]
        yield f"| {p}/{q} | {cells[0]} | {cells[1]} | {at:.5f} |"
    yield f"first curve beyond 2/7 forms at {broken['first curve beyond 2/7 forms']:.5f}."


def test_the_page_has_the_tables_of_the_datasets(datasets):
    lines = list(expected(*datasets))
    assert len(lines) > 30
    assert [line for line in lines if line not in PAGE and line not in TEXT] == []
