"""Names and paths on the command line select figures, set by set; nothing is made."""

from contextlib import nullcontext

import pytest
from project import ROOT, SHIPPED

from pipeline.cli import arguments, running
from pipeline.cli.commands import figures
from pipeline.config import load
from pipeline.declaration import ONLY_SET, parts


@pytest.fixture
def selected(monkeypatch):
    """Return a function from words to the exit status and the figures of each set in turn.

    `statuses` are those with which the sets end.
    """

    def run(*words, statuses=(), start=ROOT):
        made, ends = {}, iter(statuses)

        def make(config, group, drawings, args):
            made[group] = [*drawings]
            return next(ends, 0)

        monkeypatch.setattr(figures.publishing, "make", make)
        monkeypatch.setattr(figures, "locked", nullcontext)
        monkeypatch.delenv(ONLY_SET, raising=False)
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


@pytest.mark.skipif("study" not in parts(), reason="by the part study")
def test_the_first_failure_of_several_sets_stays_and_an_interrupt_ends(selected):
    words = "fig3", "study/edges"
    assert [*selected(*words)[1]] == ["paper", "study"]
    assert selected(*words, statuses=(1, 0))[0] == 1
    interrupted, made = selected(*words, statuses=(running.INTERRUPTED, 0))
    assert interrupted == running.INTERRUPTED and [*made] == ["paper"]
