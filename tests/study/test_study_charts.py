"""The study's charts: marks lie where the numbers are, in the method's colour."""

import numpy as np
import pytest
import xarray as xr
from keys import texts
from legible import assert_legible, pixels_in_frames

from study import charts as study

FAMILIES = ("certified march", "scan 0.1 + bisection")
# families of different colours; black is that of letters, too, and CyRK stands in other charts
DISTINCT = [*{c: name for name, (c, *_) in study.STYLES.items() if c != "#000000"}.values()]
DISTINCT = [name for name in DISTINCT if not name.startswith("CyRK")]


def scene(states):
    return {"states": ("uniform", "grazing")[states]}


def named():
    return {name: ("method", np.array(FAMILIES, dtype=object)) for name in ("name", "family")}


def marks(figure, family):
    """Return (across, up) of the marks in a family's colour, in pixels, in the order drawn."""
    color = study.STYLES[family][0]
    lines = [a for a in figure.artists if a.get_marker() == "o" and a.get_linestyle() == "None"]
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
    return xr.Dataset(named() | table)


def moved(before, after):
    """Return by how many pixels each mark in the panels moved; the key's do not move."""
    return np.round(after - before, 1)


@pytest.mark.parametrize(("of", "base"), [("evaluations", 100.0), ("seconds", 1e-5)])
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


def test_failing_shares_are_heights():
    few = np.full((2, 2, 3), 0.1)  # no panel has room for the key
    before = marks(study.edges({}, failing(few, few)), FAMILIES[0])
    for row in range(2):
        for side, place in np.ndindex(2, 3):
            for share in (0.5, 1.0):
                shares = [few.copy(), few.copy()]
                shares[row][0, side, place] = share
                off = moved(before, marks(study.edges({}, failing(*shares)), FAMILIES[0]))
                assert off[off != 0] == pytest.approx([(share - 0.1) * 360], abs=0.2)
    assert before[0, 0] > before[1, 0] > before[2, 0]  # nearer to grazing is further left


def test_zeros_are_drawn_at_an_end_named_zero():
    zeros = study.work(scene(1), work_data(100.0, 0.0, 0.0, 0.0))
    tiny = marks(study.work(scene(1), work_data(100.0, 1e-30)), FAMILIES[1])
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
        color = study.STYLES[family][0]
        dots = [a for a in figure.artists if a.get_marker() == "o" and len(a.get_xdata())]
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
            "families": ("drawn", ["near_the_rim", "touches"]),
            "tried": (("searched", "drawn"), np.full((2, 2), 1000)),
            "failed": (("searched", "drawn"), [[0, 0], [failed, 10]]),
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


@pytest.mark.parametrize("count", [2, 3, 6])
@pytest.mark.parametrize("points", [1, 3])
def test_methods_with_equal_numbers_are_all_seen_in_each_panel(count, points):
    families = DISTINCT[:count]
    cost = np.repeat(10.0 ** np.arange(1, 1 + points)[:, None], 2, axis=1)
    equal = {"median": 1e-10, "worst": 1e-6, "wrong": 0.0}
    table = {n: (("method", "set"), np.full((count * points, 2), v)) for n, v in equal.items()}
    names = np.repeat(np.array(families, dtype=object), points)
    table |= {"evaluations": (("method", "set"), np.tile(cost, (count, 1)))}
    table |= {name: ("method", names) for name in ("name", "family")}
    figure = study.work(scene(1), xr.Dataset(table))
    for family in families:
        assert min(pixels_in_frames(figure, study.STYLES[family][0])) > 20


@pytest.mark.slow
@pytest.mark.parametrize("count", [2, 5, 8])
def test_methods_that_fail_alike_take_turns_in_front(count):
    families = DISTINCT[:count]
    shares = np.full((count, 2, 13), 0.4)
    names = {n: ("method", np.array(families, dtype=object)) for n in ("name", "family")}
    of = {"distance": ("distance", np.arange(13)), "depth": ("depth", 2 + np.arange(13))}
    of |= {
        v: (("method", "side", d), shares) for v, d in (("near", "distance"), ("touch", "depth"))
    }
    figure = study.edges({}, xr.Dataset(names | of))
    for family in families:
        assert min(pixels_in_frames(figure, study.STYLES[family][0])) > 20
