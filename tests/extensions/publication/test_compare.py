"""./reproduce compare: config, norms, periodic orbits, exponents, and the picture."""

import numpy as np
import pytest
import xarray as xr
from commands import mistake

from extensions.publication.compare import datasets
from pipeline.records.pictures import pixels
from pseudorigid import Ball, symmetric_orbits
from pseudorigid.dynamics.orbits import scene_orbits

NAMES = ("one", "two")


def test_two_known_names_are_compared(capsys):
    message = mistake(capsys, "compare paper douled fig2")
    assert message == ": no variant douled: did you mean doubled?"
    message = mistake(capsys, "compare paper paper")
    assert message.startswith(": compare needs two names of paper, ")  # and the variants


def dataset(values):
    return xr.Dataset({name: (f"{name}_i", np.asarray(v)) for name, v in values.items()})


SAME = {"same": [5.0]}
MANY = SAME | {"x": [3.0, 4.0], "y": [1.0], "n": [1], "z": [1.0, 2.0]}


@pytest.mark.parametrize(("first", "second", "line"), [
    (MANY, MANY, "the same data"),
    (SAME | {"x": [1.0, np.nan]}, SAME | {"x": [2.0, np.nan]},
     "1 of 2 variables differ, x the most: by 1 of its norm"),
    (
        MANY,
        SAME | {"x": [3.0, 4.5], "y": [1.01], "n": [9], "z": [1.0]},
        "4 of 5 variables differ, x the most: by 0.1 of its norm; "
        "1 of other lengths or in one only",
    ),
])  # fmt: skip
def test_variables_that_differ_are_counted_and_the_most_different_is_named(first, second, line):
    assert datasets.norms(dataset(first), dataset(second)) == line


def test_the_first_impact_at_which_orbits_differ_is_named():
    near = [scene_orbits(Ball(k=0.2, g=0.04), 0.01, [0.3], [100]) for _ in range(2)]
    for data in near:
        data.attrs |= {"k": 0.2, "g": 0.04, "energy": 0.01}
    assert datasets.orbits(*near) == ["all 1 orbits stay within 0 section radii"]
    near[1]["x"][41] += 0.1
    (line,) = datasets.orbits(*near)
    assert line.endswith("from impact 42 on")


def periodic(energy, g=0.04, period=6):
    return symmetric_orbits(Ball(k=0.2, g=g), energy, period)


def test_orbits_of_a_little_more_energy_and_of_a_scaled_copy_are_kept():
    pairs, lost, gained = datasets.match(periodic(0.01), periodic(0.0101))
    assert [(i, j) for i, j, _ in pairs] == [(0, 0), (1, 1), (2, 2)]
    assert all(0.0 < distance < 0.02 for _, _, distance in pairs)
    assert lost == gained == []
    pairs, _, _ = datasets.match(periodic(0.01), periodic(0.04, g=0.08))
    assert [distance for _, _, distance in pairs] == [0.0, 0.0, 0.0]


def test_orbits_are_lost_gained_and_changed():
    some, none = periodic(0.01), periodic(0.001)
    assert datasets.match(some, none) == ([], [0, 1, 2], [])
    assert datasets.match(none, some) == ([], [], [0, 1, 2])
    lines = datasets.periodic_orbits(some, none, NAMES)
    assert lines[0] == "period 6: lost: elliptic (rotation 0.1794)"
    other = some.copy()
    other["type"] = ("orbit", np.array(["inverse hyperbolic", "hyperbolic", "elliptic"], object))
    lines = datasets.periodic_orbits(some, other, NAMES)
    assert lines[0].startswith("period 6: changed in type: elliptic")
    assert datasets.periodic_orbits(none, none, NAMES) == ["period 6: none in either"]
    lines = datasets.periodic_orbits(periodic(0.01, period=1), some, NAMES)
    assert lines[0] == "one: period 1: elliptic (rotation 0.179)"


def test_the_spread_is_the_standard_deviation_between_orbits():
    assert datasets.spread(np.array([0.1, 0.3])) == "0.2000 ± 0.1414 (0.1000 to 0.3000)"


def test_a_comparison_prints_every_difference(variants):
    output = (variants.path / "said of paper and low").read_text().partition("\npaper | low\n")[2]
    assert "  energy: 0.01 | 0.0017\n" in output
    assert "  low: cannot exist: no elliptic orbit of period 6 at energy 0.0017" in output
    assert "  motion      5 of 5 variables differ; 5 of other lengths" in output
    kept = "  periodic    period 1: kept: elliptic (rotation 0.179) | elliptic (rotation 0.1281)"
    lost = "  periodic    period 6: lost: elliptic (rotation 0.1794)"
    assert kept in output and lost in output
    assert "  impacts           3 of 60 " in output and "lambda 1" in output


def test_both_figures_are_side_by_side_on_the_same_axes(variants):
    results = variants.path / "results"

    def figure(folder, name):
        return pixels(results / folder / f"{name}.png")

    both = figure("compare/paper..low", "fig3")
    paper, low = figure("paper/figures", "fig3"), figure("low/figures", "fig3")
    high, wide, _ = paper.shape
    assert both.shape == (high + 75, 2 * wide, 3)
    assert np.array_equal(both[75:, :wide], paper)  # whose axes hold the other one
    labels = slice(150, None), slice(0, 175)
    assert np.array_equal(both[75:, wide:][labels], paper[labels])
    assert not np.array_equal(low[labels], paper[labels])
    assert (both[:75, :wide] < 128).any()
    drawn = figure("paper/figures", "fig4")  # the other one cannot exist
    assert np.array_equal(figure("compare/paper..low", "fig4")[75:, : drawn.shape[1]], drawn)
