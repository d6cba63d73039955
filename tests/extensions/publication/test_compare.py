"""./reproduce compare: config, norms, orbits, exponents and the picture, and ranges."""

import csv
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr
from matplotlib.lines import Line2D

from extensions.publication.compare import datasets, picture, quantities
from helpers.commands import mistake
from helpers.legible import assert_legible, frames_of
from helpers.project import fresh_tree, of_scenes
from pipeline.config.results import Range
from pipeline.records.pictures import pixels
from pseudorigid import Ball, symmetric_orbits
from pseudorigid.dynamics.orbits import scene_orbits
from pseudorigid.figures.canvas import style

NAMES = ("one", "two")


def test_two_known_names_are_compared(capsys):
    message = mistake(capsys, "compare paper douled fig2")
    assert message == ": no variant or figure douled: did you mean doubled?"
    for words in ("paper", "paper paper", "paper low doubled fig3", "paper fig2"):
        message = mistake(capsys, f"compare {words}".replace("low", "below"))
        assert message == ": compare takes two variants (paper is one), or one range"
    assert mistake(capsys, "compare").startswith(": compare needs a name:")


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
    pairs, _, _ = datasets.match(periodic(0.01), periodic(0.0025, g=0.02))
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
    head = 2 * round(2 * wide / 30)  # two lines, each 11 pixels high where the sheet has 335
    assert both.shape == (high + head, 2 * wide, 3)
    assert np.array_equal(both[head:, :wide], paper)  # whose axes hold the other one
    labels = slice(150, None), slice(0, 175)
    assert np.array_equal(both[head:, wide:][labels], paper[labels])
    assert not np.array_equal(low[labels], paper[labels])
    assert (both[:head, :wide] < 128).any()
    drawn = figure("paper/figures", "fig4")  # the other one cannot exist
    assert np.array_equal(figure("compare/paper..low", "fig4")[head:, : drawn.shape[1]], drawn)


@pytest.mark.parametrize(("shift", "words"), [
    (0.01, ", on the same axes"),
    (0.3, ", each on its own axes: they have nothing in common along x"),
])  # fmt: skip
def test_windows_that_have_nothing_in_common_keep_their_axes(monkeypatch, shift, words):
    def draw(scene, data):
        scene.get("completed", {}).update(scene.get("axes") or {"x": data})
        return data if "axes" not in scene else "again"

    monkeypatch.setattr(picture, "imported", lambda _: draw)
    monkeypatch.setattr(picture, "drawing", lambda block: {})
    monkeypatch.setattr(picture.render, "pixels", lambda figure: figure)
    windows = [{"limits": [low, low + 0.1], "ticks": [low]} for low in (0.0, shift)]
    blocks = [SimpleNamespace(drawn_by="")] * 2
    drawn, said = picture.on_same_axes(blocks, [[window] for window in windows])
    assert said == words and (drawn == windows) == (shift > 0.1)


@pytest.mark.parametrize(("text", "number"), [
    ("0.2311, standard deviation 0.0013", (0.2311, 0.0013)),
    ("45,000", (45000.0, None)),
    ("-1.5e-07", (-1.5e-07, None)),
    ("0.0096", (0.0096, None)),
    ("-0.2 to 0.5", None),
    ("0.2296, 0.2317", None),
    ("elliptic, period 6", None),
])  # fmt: skip
def test_reported_texts_are_numbers_with_a_standard_deviation_or_none(text, number):
    assert quantities.number(text) == number


RANGE = Range("ball.g", {"a": 0.02, "b": 0.03, "c": 0.05})
REPORTED = {
    "a": {"orbits": "8", "mean": "0.25, standard deviation 0.01", "x": "0 to 1"},
    "c": {"orbits": "8", "mean": "0.15, standard deviation 0.02", "x": "0 to 2"},
}


def test_a_table_of_one_variant_says_for_each_of_none_and_the_value_once():
    energies = Range("energy", {"a": 0.01})
    found = [*quantities.table(energies, {"a": {"energy": "0.01", "orbits": "8"}})]
    assert found == ["energy", "0.01", "orbits: 8"]
    both = {"a": {"energy": "0.01", "x": "1"}, "b": {"energy": "0.02", "x": "2"}}
    found = [*quantities.table(Range("energy", {"a": 0.01, "b": 0.02}), both)]
    assert found == ["energy  x", "0.01    1", "0.02    2"]


def test_the_table_has_a_row_for_each_value_and_says_once_what_is_alike():
    assert [*quantities.table(RANGE, REPORTED)] == [
        "ball.g  mean         x",
        "0.02    0.25 ± 0.01  0 to 1",
        "0.05    0.15 ± 0.02  0 to 2",
        "orbits: 8, for each",
    ]
    rows = [*quantities.rows(RANGE, "fig7", REPORTED)]
    assert rows[1] == ("fig7", "mean", "a", 0.02, 0.25, 0.01, "0.25, standard deviation 0.01")
    assert rows[5] == ("fig7", "x", "c", 0.05, None, None, "0 to 2") and len(rows) == 6


def test_curves_are_drawn_of_numbers_that_differ_with_their_deviations():
    figure = quantities.curves(RANGE, REPORTED)
    assert_legible(figure)
    assert len(frames_of(figure)) == 1
    texts = {text.get_text() for text in figure.texts}
    assert {"mean and standard deviation", "ball.g"} <= texts and "orbits" not in texts
    (_, bottom), (_, top) = frames_of(figure)[0].get_points() / figure.dpi
    lines = [line for line in figure.findobj(Line2D) if line.get_color() == style.BLUE]
    bars = [line.get_xydata() for line in lines if line.get_marker() != "o"]
    (dots,) = (line.get_xydata() for line in lines if line.get_marker() == "o")
    apart = dots[0, 1] - dots[1, 1]  # of 0.25 and 0.15
    assert [np.ptp(bar[:, 1]) / apart for bar in bars] == pytest.approx([0.2, 0.4], rel=0.01)
    assert dots[0, 1] > dots[1, 1] and bottom < dots[:, 1].min() < dots[:, 1].max() < top
    assert quantities.curves(RANGE, {"a": REPORTED["a"]}) is None  # one value makes no curve


def test_curves_over_texts_have_these_below_them():
    words = Range("scenes.fig4.type", {"a": "elliptic", "b": "hyperbolic"})
    figure = quantities.curves(words, {"a": {"impacts": "4"}, "b": {"impacts": "6"}})
    assert_legible(figure)
    assert {"elliptic", "hyperbolic"} <= {text.get_text() for text in figure.texts}


def test_a_sheet_of_many_pictures_is_no_wider_than_four(tmp_path):
    picture_ = np.full((600, 1050, 3), 200, dtype=np.uint8)
    drawings = {f"g = {i}": picture_ for i in range(9)} | {"g = 9": None}
    picture.side_by_side(drawings, tmp_path / "sheet.png", quantities.curves(RANGE, REPORTED))
    high, wide, _ = pixels(tmp_path / "sheet.png").shape
    assert 4 * 1050 - 10 <= wide <= 4 * 1050
    head, curves = 2 * round(wide / 30), 450 * wide / 1050
    assert high == pytest.approx(head + 600 * wide / 10500 + curves, abs=3)
    sheet = pixels(tmp_path / "sheet.png")
    assert (sheet[:head] < 128).any() and (sheet[head + 300 :] < 128).any()


@pytest.mark.slow
def test_a_range_with_a_faulty_value_is_made_and_compared_by_one_command(finished, tmp_path):
    given = {"gravity": {"values": {"ball.g": [0.03, 0.3, 0.05]}}}
    document = of_scenes("fig3", "fig4", "fig7", variants=given)
    tree = fresh_tree(tmp_path / "range", document, finished)
    result = tree.run("compare", "gravity")
    assert result.returncode == 2
    assert "variants.gravity.values.ball.g[1]: 0.3 is not allowed" in result.stdout
    assert "gravity-0p3: not made" in result.stdout
    assert "  gravity-0p05: cannot exist: no elliptic orbit of period 6" in result.stdout
    folder = tree.path / "results/compare/gravity"
    assert {path.name for path in folder.iterdir()} == {
        "fig3.png", "fig7.png", "quantities.csv", "quantities.txt"
    }  # fmt: skip
    with (folder / "quantities.csv").open() as file:
        table = [*csv.DictReader(file)]
    rotation = {
        float(row["value"]): float(row["number"])
        for row in table
        if row["quantity"] == "rotation number"
    }
    orbits = {g: symmetric_orbits(Ball(k=0.2, g=g), 0.01, 1) for g in (0.03, 0.05)}
    for g, found in orbits.items():
        assert rotation[g] == pytest.approx(float(found["rotation_number"][0]), abs=1e-6)
    figures = {path.parent.parent.name for path in tree.path.glob("results/*/figures/fig3.png")}
    assert {"gravity-0p03", "gravity-0p05"} <= figures and "gravity-0p3" not in figures
    assert tree.run("compare", "gravity", "fig7").returncode == 2
    assert {path.name for path in folder.glob("*.png")} == {"fig7.png"}
    assert tree.run("variant", "gravity-0p03", "fig3").returncode == 0
    assert tree.run("variant", "gravity-0p03", "gravity-0p3", "fig3").returncode == 2
