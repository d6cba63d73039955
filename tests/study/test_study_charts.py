"""The study's charts: marks lie where the numbers are, in the method's colour."""

import numpy as np
import pytest
import xarray as xr

from helpers.keys import texts
from helpers.legible import assert_legible
from study import charts as study

FAMILIES = ("certified march", "scan 0.1 + bisection")


def scene(states):
    return {"states": ("uniform", "grazing")[states]}


def named():
    return {name: ("method", np.array(FAMILIES, dtype=object)) for name in ("name", "family")}


def marks(figure, family):
    """Return (across, up) of the marks in a family's colour, in pixels, in the order drawn."""
    color, mark, *_ = study.STYLES[family]
    lines = [a for a in figure.artists if a.get_marker() == mark and a.get_linestyle() == "None"]
    lines = [a for a in lines if color in (a.get_markeredgecolor(), a.get_markerfacecolor())]
    return np.concatenate([np.column_stack(line.get_data()) for line in lines]) * figure.dpi


def work_data(cost=10.0, worst=1e-6, wrong=0.0, names=FAMILIES):
    """Return a method of each family; the numbers given are the second one's, in the second set."""
    table = {}
    for name, value in {"worst": worst, "wrong": wrong, "timed_flight": cost}.items():
        rows = np.full((2, 2), {"worst": 5e-16, "wrong": 0.0, "timed_flight": 1.0}[name])
        rows[1, 1] = value
        table[name] = ("timed" if name == "timed_flight" else "method", "set"), rows
    of_methods = {name: ("method", np.array(names, dtype=object)) for name in ("name", "family")}
    return xr.Dataset(of_methods | table | {"timed_name": ("timed", [*names])})


def moved(before, after):
    """Return by how many pixels each mark in the panels moved; the key's do not move."""
    return np.round(after - before, 1)


def test_work_is_drawn_where_its_numbers_are():
    def drawn(states=1, **change):
        return marks(study.work(scene(states), work_data(**change)), FAMILIES[1])

    before = drawn()
    for cost, wanted in ((100.0, 440 / 5), (1e4, 3 * 440 / 5)):
        (step,) = moved(before, drawn(cost=cost))
        assert step == pytest.approx([wanted, 0], abs=0.2)
    for change, wanted in (
        ({"worst": 1e-4}, 2 * 435 / 19),  # 19 decades in 435 pixels
        ({"wrong": 0.009}, 6 * 435 / 19),  # to 1
    ):
        (step,) = moved(before, drawn(**change))
        assert step == pytest.approx([0, wanted], abs=0.2)
    assert not np.array_equal(drawn(states=0), before)


def test_fast_methods_are_drawn_in_a_panel_of_their_own():
    names = "certified march", "inflections"

    def drawn(cost, worst):
        return marks(study.work(scene(1), work_data(cost, worst, names=names)), names[1])

    before = drawn(1.0, 5e-16)
    assert moved(before, drawn(1.2, 5e-16))[0] == pytest.approx([0.2 / 0.6 * 325, 0], abs=0.2)
    assert moved(before, drawn(1.0, 4e-16))[0] == pytest.approx([0, -435 / 10], abs=0.2)
    figure = study.work(scene(1), work_data(1.04, 5e-16, names=names))
    assert {"march", "inflections"} <= {*texts(figure)}
    assert_legible(figure, slack=4)


def failing(near, touch):
    """Return shares of failures, (method, side, distance from grazing or from a touch)."""
    exponents = {"distance": ("distance", [0, 6, 12]), "depth": ("depth", [2, 8, 14])}
    near, touch = (("method", "side", "distance"), near), (("method", "side", "depth"), touch)
    return xr.Dataset(named() | exponents | {"near": near, "touch": touch})


def cells(figure):
    """Return (left, right, height, colour) of the cells of the tables, in pixels."""
    lines = [a for a in figure.artists if a.get_solid_capstyle() == "butt" and a.get_lw() > 5]
    return {(*(a.get_xdata() * figure.dpi).round(1), round(a.get_ydata()[0] * figure.dpi, 1)):
            a.get_color() for a in lines}  # fmt: skip


def test_failing_shares_are_colours():
    few = np.full((2, 2, 3), 0.1)
    before = cells(study.edges({}, failing(few, few)))
    assert len(before) == 2 * 2 * 2 * 3 and set(before.values()) == {study._shade(0.1)}
    places = {}
    for row in range(2):
        for method, side, place in np.ndindex(2, 2, 3):
            shares = [few.copy(), few.copy()]
            shares[row][method, side, place] = 1.0
            after = cells(study.edges({}, failing(*shares)))
            ((cell, color),) = set(after.items()) - set(before.items())
            assert color == study._shade(1.0)
            places[row, method, side, place] = cell
    assert len(set(places.values())) == len(places)
    left, _, height = places[0, 0, 0, 2]
    assert left < places[0, 0, 0, 0][0] and left < places[0, 0, 1, 2][0]  # a smaller s; x < -g
    assert height > places[0, 1, 0, 2][2]  # the march is in the first row
    assert height < places[1, 0, 0, 2][2]  # touches are above


def test_shares_have_colours_in_order_and_zero_has_its_own():
    light = [sum(bytes.fromhex(study._shade(share)[1:])) for share in (0.0, 0.001, 0.2, 0.7, 1.0)]
    assert light == sorted(light, reverse=True) and len(set(light)) == 5


def test_zeros_are_drawn_at_an_end_named_zero():
    zeros = study.work(scene(1), work_data(worst=0.0))
    tiny = marks(study.work(scene(1), work_data(worst=1e-30)), FAMILIES[1])
    assert np.min(tiny[:, 1]) == np.min(marks(zeros, FAMILIES[1])[:, 1])
    assert texts(zeros).count("0") >= 2


@pytest.mark.parametrize("wrong", [0.0, 0.3])
def test_wrong_roots_are_named_if_there_are_any(wrong):
    figure = study.work(scene(1), work_data(wrong=wrong))
    assert ("at $10^0$: wrong roots" in texts(figure)) == (wrong > 0)


def test_methods_as_commonly_written_have_hollow_marks_and_tuned_ones_full_ones():
    figure = study.work(scene(1), work_data())
    for family, fill in zip(FAMILIES, (study.STYLES[FAMILIES[0]][0], "white"), strict=True):
        color, mark, *_ = study.STYLES[family]
        dots = [a for a in figure.artists if a.get_marker() == mark and len(a.get_xdata())]
        own = [a for a in dots if color in (a.get_markeredgecolor(), a.get_markerfacecolor())]
        assert own and {a.get_markerfacecolor() for a in own} == {fill}


def test_missed_impacts_are_drawn_at_their_numbers():
    def drawn(missed, failed):
        names = np.array(["certified march", "scan 0.1, 1e-12"], dtype=object)
        of = np.array(FAMILIES, dtype=object)
        count = np.array([[0, 0], [1, missed]])
        data = xr.Dataset({
            "name": ("method", names), "family": ("method", of),
            "flights": ("flights", [1000, 10_000]),
            "missed": (("method", "flights"), count), "long_name": ("long", names),
            "long_flights": ("long_flights", [100_000]),
            "long_missed": (("long", "long_flights"), [[0], [100]]),
            "searched_name": ("searched", names),
            "families": ("drawn", ["near_the_rim", "touches", "touches_within_rounding"]),
            "tried": (("searched", "drawn"), np.full((2, 3), 1000)),
            "failed": (("searched", "drawn"), [[0, 0, 0], [failed, 10, 10]]),
        })  # fmt: skip
        figure = study.misses({}, data)
        assert_legible(figure, slack=4)
        own = [a for a in figure.artists if a.get_linestyle() == "None"]
        return np.concatenate([np.column_stack(a.get_data()) for a in own]) * figure.dpi

    before = drawn(10, 10)
    up = moved(before, drawn(100, 10))
    assert up[up != 0] == pytest.approx([470 / 5.3], abs=0.2)
    right = moved(before, drawn(10, 100))
    assert right[right != 0] == pytest.approx([(1000 - 365) / 7], abs=0.2)


@pytest.mark.parametrize("least", [0.5, 0.0])
def test_the_key_covers_no_text_in_a_panel_without_failures_or_below_all(least):
    shares = np.full((2, 2, 3), least)
    some = shares.copy()
    some[:, 1] = 0.0
    figure = study.edges({}, failing(shares, some))
    assert_legible(figure, slack=4)  # letters stand close to labels
