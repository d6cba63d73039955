"""Names and paths on the command line select figures, set by set; nothing is made."""

from contextlib import nullcontext

import pytest

from helpers.project import ROOT, SHIPPED
from pipeline.cli import arguments, running
from pipeline.cli.commands import figures
from pipeline.cli.errors import CommandLineError
from pipeline.config import load
from pipeline.config.results import Range
from pipeline.declaration import ONLY_SET, parts


@pytest.fixture
def selected(monkeypatch):
    """Return a function from words to the exit status and the figures of each set.

    All sets are made in one run, which ends with `status`.
    """

    def run(*words, status=0, start=ROOT):
        made = {}

        def make(config, targets, args):
            assert not made
            made.update({group: [*drawings] for group, drawings in targets.items()})
            return status

        monkeypatch.setattr(figures.publishing, "make", make)
        monkeypatch.setattr(figures, "locked", nullcontext)
        monkeypatch.setenv(ONLY_SET, "")  # so that it is removed again
        monkeypatch.delenv(ONLY_SET)
        args = arguments.read([*words])
        args.start, args.config = start, load(SHIPPED)
        return figures.run(args), made

    return run


def test_names_and_paths_select_figures_of_their_sets(selected):
    three, seven = ([f"paper_figures/fig{n}.{form}" for form in ("png", "svg")] for n in (3, 7))
    assert selected("fig3", "fig7") == (0, {"paper": [*three, *seven]})
    assert selected("paper_figures/fig3.png", "fig7") == (0, {"paper": [three[0], *seven]})
    assert selected("../fig3.svg", start=ROOT / "paper_figures/x")[1] == {"paper": [three[1]]}
    assert selected("paper/fig3")[1] == {"paper": three}
    data = "results/paper/orbits_fig2.nc"
    assert selected(data)[1] == selected("orbits_fig2.nc", start=ROOT / "results/paper")[1]
    assert selected(data)[1] == {"paper": [data]}
    for whole in (selected(), selected("all")):
        assert len(whole[1]["paper"]) == 14 and [*whole[1]] == ["paper"]


def test_the_name_of_a_range_is_no_figure():
    config = load(SHIPPED)
    config.ranges["gravity"] = Range("ball.g", {})
    with pytest.raises(CommandLineError, match=r"run \./reproduce variant gravity$"):
        figures._results_among({"gravity"}, "gravity", arguments.Arguments(config=config))


@pytest.mark.skipif("study" not in parts(), reason="by the part study")
def test_several_sets_are_made_in_one_run_whose_status_is_returned(selected):
    for status in (0, 1, running.INTERRUPTED):
        ended, made = selected("fig3", "study/edges", status=status)
        assert ended == status and [*made] == ["paper", "study"]
