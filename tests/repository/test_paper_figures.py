"""A figure of the paper, from the shipped scenes, has the committed bytes."""

import paper_probe
import pytest
from project import ROOT, SHIPPED, run

SUMS = "paper_figures/SHA256SUMS"


def test_a_figure_drawn_in_a_second(tmp_path):
    git = ("git", "-C", ROOT, "show")
    sums, scenes = (run(*git, f"HEAD:./{file}") for file in (SUMS, "config.yaml"))
    if sums.returncode:
        pytest.skip(f"the paper's figures are not compared: git does not say what {SUMS} was")
    if scenes.stdout != SHIPPED.read_text(encoding="utf-8"):
        pytest.skip("the paper's figures are not compared: other scenes are committed")
    committed = dict(reversed(line.split("  ")) for line in sums.stdout.splitlines())
    found = dict(paper_probe.paper(tmp_path, ["fig3"]))
    assert found == {name: committed[name] for name in ("fig3.png", "fig3.svg")}
