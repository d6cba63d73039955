"""The study's charts: marks lie where the numbers are, in the method's colour."""

import numpy as np
import pytest
import xarray as xr

from pseudorigid.figures import study
from pseudorigid.figures.axes import panel

FAMILIES = ("certified march", "scan 0.1 + bisection")


def named(families=FAMILIES):
    return {
        "name": ("method", np.array(families, dtype=object)),
        "family": ("method", np.array(families, dtype=object)),
    }


def marks(figure, family):
    """(across, up) of the marks in a family's colour, in pixels, in the order drawn."""
    color = study.STYLES[family][0]
    lines = [a for a in figure.artists if a.get_marker() == "o" and a.get_linestyle() == "None"]
    lines = [a for a in lines if color in (a.get_markeredgecolor(), a.get_markerfacecolor())]
    places = [np.column_stack(line.get_data()) for line in lines]
    return np.concatenate(places) * figure.dpi


def work_data(cost, median, worst, wrong):
    """A method of each family; the second one's numbers are given, for the second set."""
    values = {
        "evaluations": cost, "seconds": cost, "seconds_low": cost, "seconds_high": cost,
        "median": median, "worst": worst, "wrong": wrong,
    }  # fmt: skip
    table = {}
    for name, value in values.items():
        rows = np.full((2, 2), 0.3 if name == "wrong" else 1e-8)
        rows[:, :] = 100.0 if name == "evaluations" else rows
        rows[1, 1] = value
        table[name] = ("method", "set"), rows
    return xr.Dataset(named() | table)


def moved(before, after):
    """By how many pixels each mark in the panels is moved; the key's do not move."""
    return np.round(after - before, 1)


@pytest.mark.parametrize("cost", ["evaluations", "seconds"])
def test_work_is_drawn_where_its_numbers_are(cost):
    base = {"evaluations": 100.0, "seconds": 1e-5}[cost]
    start = work_data(base, 1e-10, 1e-6, 0.0)
    at = marks(study.work(start, 1, cost), FAMILIES[1])

    def shift(**change):
        fields = {"cost": base, "median": 1e-10, "worst": 1e-6, "wrong": 0.0} | change
        return moved(at, marks(study.work(work_data(**fields), 1, cost), FAMILIES[1]))

    decade = shift(cost=10 * base)
    assert set(decade[:, 1]) == {0.0}
    right = decade[:, 0].max()
    assert sorted(decade[:, 0]) == [0.0] * (len(at) - 3) + [right] * 3
    assert right > 50
    assert np.abs(shift(cost=1000 * base)[:, 0].max() - 3 * right) < 0.2
    for name, factor, steps in (("median", 1e-4, -4), ("worst", 100.0, 2)):
        up = shift(**{name: {"median": 1e-10, "worst": 1e-6}[name] * factor})
        assert np.count_nonzero(up) == 1
        assert up[up != 0] == pytest.approx(steps * 560 / 18, abs=0.2)  # 18 decades in 560 pixels
    up = shift(wrong=0.009)
    assert up[up != 0] == pytest.approx([0.009 / 0.6 * 200], abs=0.2)
    # with many wrong roots the worst right one is what counts as wrong, and is not drawn
    many = marks(study.work(work_data(base, 1e-10, 1e-6, 0.4), 1, cost), FAMILIES[1])
    assert np.isfinite(many).all() and len(many) == len(at) - 1
    # the other set's numbers are not in this chart
    other = study.work(start, 0, cost)
    assert not np.array_equal(marks(other, FAMILIES[1]), at)


def edges_data(near, touch):
    return xr.Dataset(
        named()
        | {
            "near": (("method", "side", "distance"), near),
            "touch": (("method", "side", "depth"), touch),
            "distance": ("distance", [0, 6, 12]),
            "depth": ("depth", [2, 8, 14]),
        }
    )


def test_failing_shares_are_heights():
    zero = np.zeros((2, 2, 3))
    at = marks(study.edges(edges_data(zero, zero)), FAMILIES[0])
    for name in ("near", "touch"):
        for side in range(2):
            for place in range(3):
                for share in (0.5, 1.0):
                    changed = {"near": zero.copy(), "touch": zero.copy()}
                    changed[name][0, side, place] = share
                    off = moved(at, marks(study.edges(edges_data(**changed)), FAMILIES[0]))
                    assert np.count_nonzero(off) == 1
                    assert off.max() == pytest.approx(share * 300, abs=0.2)  # of 300 pixels
    # nearer to grazing is further to the left
    across = at[:3, 0]
    assert across[0] > across[1] > across[2]


def test_zeros_are_drawn_at_an_end_named_zero():
    zeros = study.work(work_data(100.0, 0.0, 0.0, 0.0), 1, "evaluations")
    least = marks(zeros, FAMILIES[1])[:, 1]
    bottom = marks(study.work(work_data(100.0, 1e-30, 1e-6, 0.0), 1, "evaluations"), FAMILIES[1])
    assert np.min(bottom[:, 1]) == np.min(least)
    assert [text.get_text() for text in zeros.texts].count("0") >= 2


def test_scans_that_differ_in_their_step_have_one_entry():
    names = [
        *(f"scan {step}, 1e-12" for step in (0.5, 0.1, 0.01)),
        "scan 0.1, 1e-06",
        "engine 1e-03",
    ]
    families = ["scan 0.5 + bisection"] * 4 + ["time stepping"]
    data = xr.Dataset(
        {
            "name": ("method", np.array(names, dtype=object)),
            "family": ("method", np.array(families, dtype=object)),
            "apart": (("method", "impact"), np.full((5, 3), 1e-9)),
            "impact": ("impact", [1, 2, 3]),
        }
    )
    texts = [text.get_text() for text in study.separation(data).texts]
    assert texts[-3:] == ["scan 0.5 to 0.01, $10^{-12}$", "scan 0.1, $10^{-6}$", "engine $10^{-3}$"]


def test_decades_are_placed_by_our_own_logarithm():
    assert panel.log10([1e-12, 1.0, 1e3]) == pytest.approx([-12, 0, 3], abs=1e-14)
    assert np.isnan(panel.log10([0.0, -1.0])).all()


def test_the_worst_right_root_is_in_the_key_where_it_is_drawn():
    for wrong, there in ((0.0, True), (0.3, False)):
        figure = study.work(work_data(100.0, 1e-10, 1e-6, wrong), 1, "evaluations")
        words = [text.get_text() for text in figure.texts if "worst" in text.get_text()]
        assert bool(words) is there
        if there:
            assert words == ["hollow: the worst right root, if at most 1 % are wrong"]
