"""The study's charts: marks lie where the numbers are, in the method's colour."""

import numpy as np
import pytest
import xarray as xr
from keys import texts
from legible import assert_legible

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


def work_data(cost, median=1e-10, worst=1e-6, wrong=0.0, of="evaluations"):
    """Return a method of each family; the numbers given are the second one's, in the second set."""
    values = {"evaluations": 100.0, "median": median, "worst": worst, "wrong": wrong, of: cost}
    table = {}
    for name, value in values.items():
        other = {"wrong": 0.3, "evaluations": 100.0}.get(name, 1e-8)
        rows = np.full((2, 2), other)
        rows[1, 1] = value
        table[name] = ("method", "set"), rows
    return xr.Dataset(named() | table | timed(FAMILIES))


def timed(names, march=2e-7):
    """Return recorded seconds of methods, of which the first takes `march`, and others 1e-7."""
    seconds = np.full((len(names), 2), 1e-7)
    seconds[0] = march
    return {"timed_name": ("timed", [*names]), "timed_seconds": (("timed", "set"), seconds)}


def moved(before, after):
    """Return by how many pixels each mark in the panels moved; the key's do not move."""
    return np.round(after - before, 1)


@pytest.mark.parametrize(("of", "base"), [("evaluations", 10.0), ("seconds", 1e-5)])
def test_work_is_drawn_where_its_numbers_are(of, base):
    def drawn(states=1, cost=base, **change):
        return marks(study.work(scene(states), work_data(cost, of=of, **change)), FAMILIES[1])

    before = drawn()
    decade = moved(before, drawn(cost=10 * base))
    assert set(decade[:, 1]) == {0.0}
    right = decade[:, 0].max()
    assert sorted(decade[:, 0]) == [0.0] * (len(before) - 2) + [right] * 2
    assert right > 50
    assert np.abs(moved(before, drawn(cost=1000 * base))[:, 0].max() - 3 * right) < 0.2
    height = 480 / 18  # 18 decades in 480 pixels
    for change, wanted in (
        ({"median": 1e-14}, -4 * height),
        ({"worst": 1e-4}, 2 * height),
        ({"wrong": 0.009}, 6 * height),  # to the top
    ):
        up = moved(before, drawn(**change))
        assert up[up != 0] == pytest.approx([wanted], abs=0.2)
    assert not np.array_equal(drawn(states=0), before)


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


def test_labels_have_evaluations_and_times_relative_to_the_march():
    data = work_data(48.7)
    data["name"] = data["family"] = "method", np.array(["certified march", "inflections"])
    data = data.assign(timed(["certified march", "inflections"]))
    assert texts(study.work(scene(1), data)).count("inflections: 49, 0.5") == 1
    assert texts(study.work(scene(1), data)).count("march: 100, 1") == 1


def test_zeros_are_drawn_at_an_end_named_zero():
    zeros = study.work(scene(1), work_data(100.0, 0.0, 0.0, 0.0))
    tiny = marks(study.work(scene(1), work_data(100.0, 1e-30, 1e-30)), FAMILIES[1])
    assert np.min(tiny[:, 1]) == np.min(marks(zeros, FAMILIES[1])[:, 1])
    assert texts(zeros).count("0") >= 2


@pytest.mark.parametrize("wrong", [0.0, 0.3])
def test_wrong_roots_are_named_if_there_are_any(wrong):
    data = work_data(100.0, wrong=wrong)
    data["wrong"] = ("method", "set"), np.full((2, 2), wrong)
    figure = study.work(scene(1), data)
    assert ("at the top: some roots are wrong" in texts(figure)) == (wrong > 0)


def test_methods_as_usually_written_have_hollow_marks_and_those_with_care_full_ones():
    figure = study.work(scene(1), work_data(100.0))
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
