"""./reproduce compare: config, data, reported quantities, and the picture."""

import re

import numpy as np
import pytest

from pipeline import config
from pipeline.checks import compare as comparison
from pipeline.cli import arguments
from pipeline.cli.commands import compare
from pipeline.cli.session import CommandLineError
from pipeline.records.pictures import pixels


def test_a_comparison_prints_every_difference(variants):
    output = (variants.path / "said of paper and low").read_text().partition("\npaper | low\n")[2]
    fig3, fig4, fig7 = (" ".join(part.split()) for part in re.split(r"\n(?=fig)", output.strip()))
    for words in (
        "energy: 0.01 | 0.0017",
        "other numbers in periodic, motion paper low orbit elliptic, period 1 elliptic, period 1",
        "side by side: results/compare/paper..low/fig3.png",
    ):
        assert words in fig3
    assert re.search(r"rotation number 0\.17\d+ 0\.128\d+ ", fig3)
    assert "low: cannot exist: no elliptic orbit of period 6 at energy 0.0017" in fig4
    assert "other numbers" not in fig4
    assert re.search("largest exponent 0.*, .* 0.*, ", fig7)


def test_a_figure_of_the_same_config_has_the_same_numbers(variants, capsys):
    blocks = config.load(variants.config)["variants"]
    blocks["again"] = blocks["low"]
    comparison.compare(variants.path, blocks, ("again", "again"), ["fig3"])
    assert "\n  the same config\n  again: missing\n" in capsys.readouterr().out
    names = ("low", "again")  # they share their data
    line, *_ = comparison._data_differences(variants.path, blocks, names, "fig3")
    assert line == "the same numbers"


def test_both_figures_are_side_by_side(variants):
    results = variants.path / "results"

    def figure(folder, name):
        return pixels(results / folder / f"{name}.png")

    for name in ("fig3", "fig7"):
        both = figure("compare/paper..low", name)
        paper, low = figure("paper/figures", name), figure("low/figures", name)
        high, wide, _ = paper.shape
        assert both.shape == (high + 75, 2 * wide, 3)
        assert np.array_equal(both[75:, :wide], paper)
        assert np.array_equal(both[75:, wide:], low)
        assert (both[:75, :wide] < 128).any()
    drawn = figure("paper/figures", "fig4")  # the other one cannot exist
    assert np.array_equal(figure("compare/paper..low", "fig4")[75:, : drawn.shape[1]], drawn)


@pytest.mark.slow
def test_a_damaged_dataset_is_recomputed_first(variants, tmp_path):
    tree = variants.copy(tmp_path / "damaged")
    file = tree.path / "results" / "low" / "lyapunov_fig7.nc"
    whole = file.read_bytes()
    file.write_bytes(whole[:3000])
    result = tree.run("compare", "paper", "low")
    assert (result.returncode, file.read_bytes()) == (0, whole)
    assert "results/low/lyapunov_fig7.nc: changed after it was made" in result.stdout


@pytest.mark.parametrize(
    ("names", "words"),
    [
        ((), "two names of paper, low, doubled"),
        (("low", "low"), "two names of paper, low, doubled"),
        (("low", "lo"), "no variant lo: did you mean low?"),
        (("low", "-n"), "two names of paper, low, doubled"),
    ],
)
def test_wrong_names_are_refused_in_one_line(variants, names, words):
    args = arguments.read(["compare", *names])
    args.config = config.load(variants.config)
    with pytest.raises(CommandLineError, match=rf"^[^\n]*{re.escape(words)}[^\n]*$"):
        compare.run(args)
