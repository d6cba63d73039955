"""Figures of the paper, from the shipped scenes, have the committed bytes."""

import paper_probe
import pytest
from project import ROOT, SHIPPED, run

SUMS = "paper_figures/SHA256SUMS"


QUICK = "fig3", "fig6", "fig7", "fig8"  # each kind but that of Figure 5, in two seconds


def test_figures_that_are_drawn_in_a_second_have_the_committed_bytes(tmp_path):
    git = ("git", "-C", ROOT, "show")
    sums, scenes = (run(*git, f"HEAD:./{file}") for file in (SUMS, "config.yaml"))
    if sums.returncode:
        pytest.skip(f"the paper's figures are not compared: git does not say what {SUMS} was")
    if scenes.stdout != SHIPPED.read_text(encoding="utf-8"):
        pytest.skip("the paper's figures are not compared: other scenes are committed")
    committed = dict(reversed(line.split("  ")) for line in sums.stdout.splitlines())
    found = dict(paper_probe.paper(tmp_path, QUICK))
    assert found == {
        f"{name}.{form}": committed[f"{name}.{form}"] for name in QUICK for form in ("png", "svg")
    }
