"""The paper's figures, from the shipped scenes, have the committed bytes."""

import subprocess

import paper_probe
import pytest
from project import ROOT, SHIPPED

SUMS = "paper_figures/SHA256SUMS"


@pytest.fixture(scope="module")
def committed():
    """File -> sha256 of the figures as committed, or a line on why they are not looked at."""
    command = ["git", "-C", str(ROOT), "show", f"HEAD:./{SUMS}"]
    try:
        result = subprocess.run(command, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        result = None
    if result is None or result.returncode:
        pytest.skip(f"the paper's figures are not compared: git does not say what {SUMS} was")
    shipped = subprocess.run([*command[:-1], "HEAD:./config.yaml"], capture_output=True, check=True)
    if shipped.stdout != SHIPPED.read_bytes():
        pytest.skip("the paper's figures are not compared: other scenes are committed")
    return dict(reversed(line.split("  ")) for line in result.stdout.splitlines())


def test_a_figure_drawn_in_a_second(committed, tmp_path):
    found = dict(paper_probe.paper(tmp_path, ["fig3"]))
    assert found == {name: committed[name] for name in ("fig3.png", "fig3.svg")}


@pytest.mark.slow
def test_all_of_them(committed, tmp_path):
    assert dict(paper_probe.paper(tmp_path)) == committed
