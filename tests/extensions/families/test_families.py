"""Families end where events or grazings say so, and go on beyond them; the stage keeps them."""

import json

import pytest

from extensions.families.continuation import search
from extensions.families.continuation.half_orbit import ENERGY, INERTIA
from extensions.families.continuation.symmetric import Parameter
from extensions.families.dataset import families
from helpers.dataset_hash import content_hash
from helpers.parts.family_search import PAPER, crossings, energy_of, rho, searched, up_to_period_six
from pseudorigid import symmetric_orbits


def test_every_end_has_a_name():
    six = up_to_period_six()
    for family in six.families:
        for end in family.ends:
            assert end.kind in {"range", "resonance", "doubling", "pitchfork", "touch", "rim"}
            if end.kind not in ("range", "touch"):
                assert end.family >= 0
            if end.kind == "resonance":
                assert family.period == end.order * six.families[end.family].period


def test_a_family_begins_at_each_pitchfork_doubling_and_resonance():
    """It has the event's period times the order, and less symmetry beside a pitchfork."""
    six = up_to_period_six()
    begun = {
        (end.family, end.kind, end.p): family for family in six.families for end in family.ends
    }
    kinds = set()
    for parent in six.families:
        for event in parent.events:
            if event.kind != "fold" and event.order * parent.period <= six.longest:
                family = begun[parent.number, event.kind, event.point.p]
                assert family.period == event.order * parent.period
                assert family.symmetric == (event.kind != "pitchfork")
                kinds.add(event.kind)
    assert kinds == {"pitchfork", "doubling", "resonance"}


def test_families_go_on_where_an_impact_grazes():
    """From a level below the grazing, the search finds the family that begins there."""
    found = search.Search(Parameter(ENERGY, 0.2, rho(PAPER, 0.0115), rho(PAPER, 0.0135)), 6)
    for _ in found.sweep([rho(PAPER, 0.0120)]):
        pass
    assert 5 not in {family.period for family in found.families}
    for _ in found.complete():
        pass
    (five,) = (family for family in found.families if family.period == 5)
    (end,) = (end for end in five.ends if end.kind == "touch")
    assert energy_of(found, end.p) == pytest.approx(0.012520264234, abs=1e-12)
    assert found.families[end.family].period == 6


def test_families_without_symmetry_go_on_where_an_impact_grazes():
    """Period 9 ends where a flight touches the floor, and there begins one of period 10."""
    found = searched(PAPER, 0.0414, 0.0437, 10, 4)
    (nine,) = (f for f in found.families if (f.period, f.line) == (9, -1))
    assert [end.kind for end in nine.ends] == ["pitchfork", "touch"]
    (ten,) = (f for f in found.families if f.number == nine.ends[1].family)
    (end,) = (end for end in ten.ends if end.kind == "rim")
    assert (ten.period, ten.line, end.p) == (10, -1, pytest.approx(nine.ends[1].p, rel=1e-9))


# --- the stage ------------------------------------------------------------------------------------

SMALL = {"parameter": "energy", "span": [0.005, 0.012], "period": 6, "levels": 25}


@pytest.mark.slow
def test_a_killed_search_continues_and_gives_the_same_dataset(tmp_path):
    whole = families(PAPER, 0.01, **SMALL)
    folder = tmp_path / "kept"
    shares = []

    def killed(share, text):
        shares.append(share)
        if share > 0.42:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        families(PAPER, 0.01, **SMALL, progress=killed, folder=folder)
    assert json.loads((folder / "families.json").read_text())["done"] == 20
    again = []
    data = families(PAPER, 0.01, **SMALL, progress=lambda *it: again.append(it), folder=folder)
    levels = [share for share, text in again if text.endswith(" families")]
    assert len(levels) == SMALL["levels"] - 20 and levels[-1] == 0.5
    assert content_hash(data) == content_hash(whole) and not folder.exists()


def test_families_against_k_cross_those_against_the_energy():
    """At k = 0.2 and E/g^2 = 6.25 both searches hold the three period-six orbits."""
    by_k = search.Search(Parameter(INERTIA, 6.25, 0.19, 0.21), 6)
    for _ in by_k.sweep([0.195, 0.205]):
        pass
    held = sorted(
        point.data.time
        for family in by_k.families
        if family.period == 6
        for point in crossings(family, 0.2)
    )
    times = symmetric_orbits(PAPER, 0.01, 6)["total_time"].values
    assert held == pytest.approx(sorted(times.tolist()), abs=1e-9)
