"""Figures of the paper, from the shipped scenes, have the committed bytes."""

import pytest
import yaml

from helpers import paper_probe
from helpers.project import ROOT, SHIPPED, run

SUMS = "paper_figures/SHA256SUMS"


@pytest.mark.parametrize("names", [("fig3", "fig4", "fig6", "fig7", "fig8"), ("fig2", "fig5")])
def test_figures_have_the_committed_bytes(tmp_path, names):
    """Those whose scenes are as committed: other scenes may be added or edited."""
    git = ("git", "-C", ROOT, "show")
    sums, before = (run(*git, f"HEAD:./{file}") for file in (SUMS, "config.yaml"))
    if sums.returncode:
        pytest.skip(f"the paper's figures are not compared: git does not say what {SUMS} was")
    now, before = map(yaml.safe_load, (SHIPPED.read_text(encoding="utf-8"), before.stdout))
    same = [
        name
        for name in names
        if now["ball"] == before["ball"] and now["scenes"].get(name) == before["scenes"][name]
    ]
    if not same:
        pytest.skip("the paper's figures are not compared: other scenes are committed")
    committed = dict(reversed(line.split("  ")) for line in sums.stdout.splitlines())
    assert dict(paper_probe.paper(tmp_path, same)) == {
        f"{name}.{form}": committed[f"{name}.{form}"] for name in same for form in ("png", "svg")
    }
