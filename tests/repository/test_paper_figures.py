"""The paper's figures, from the shipped scenes, have the committed bytes."""

import paper_probe
import pytest
from project import ROOT, SHIPPED, run

SUMS = "paper_figures/SHA256SUMS"


@pytest.fixture(scope="module")
def committed():
    """File -> sha256 of the figures as committed, or a line on why they are not looked at."""
    git = ("git", "-C", ROOT, "show")
    sums, scenes = (run(*git, f"HEAD:./{file}") for file in (SUMS, "config.yaml"))
    if sums.returncode:
        pytest.skip(f"the paper's figures are not compared: git does not say what {SUMS} was")
    if scenes.stdout != SHIPPED.read_text(encoding="utf-8"):
        pytest.skip("the paper's figures are not compared: other scenes are committed")
    return dict(reversed(line.split("  ")) for line in sums.stdout.splitlines())


def test_a_figure_drawn_in_a_second(committed, tmp_path):
    found = dict(paper_probe.paper(tmp_path, ["fig3"]))
    assert found == {name: committed[name] for name in ("fig3.png", "fig3.svg")}


@pytest.mark.slow
def test_all_of_them(committed, tmp_path):
    assert dict(paper_probe.paper(tmp_path)) == committed
