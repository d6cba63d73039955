"""Scenes with a `method`: their data count what it missed, and nothing else changes."""

import pytest
from project import Tree, fresh_tree, of_scenes

from pipeline.records.artifacts import load

RESULTS = ("figures/fig3.png", "figures/fig7.png", "orbits_fig2.nc", "manifolds_fig6.nc")
FINE = {"scan": 0.1, "tolerance": 1e-12}


def make(folder):
    """Make figures 3 and 7, orbits and manifolds of small scenes by scan and bisection."""
    document = of_scenes("fig2", "fig3", "fig6", "fig7")
    for scene in ("fig2", "fig3", "fig6"):
        document["scenes"][scene]["method"] = FINE
    document["scenes"]["fig7"] |= {"method": {"scan": 1, "tolerance": 1e-3}, "impacts": 3000}
    tree = fresh_tree(folder, document)
    tree.make_here(*(f"results/paper/{name}" for name in RESULTS))
    (folder / "output").write_text(tree.succeed("fig3", "fig7"))


@pytest.fixture(scope="module")
def published(shared):
    return Tree(shared("by the paper's method", make))


def attributes(tree, name):
    return load(tree.path / "results" / "paper" / f"{name}.nc").attrs


def test_the_data_of_a_method_say_what_it_missed(published, finished):
    for name in ("motion_fig3", "orbits_fig2", "manifolds_fig6", "lyapunov_fig7"):
        attrs = attributes(published, name)
        assert '"method":{"scan":' in attrs["config"]
        assert 0 <= attrs["impacts_missed"] < attrs["impacts"]
    assert attributes(published, "lyapunov_fig7")["impacts"] == 9000
    assert attributes(published, "lyapunov_fig7")["impacts_missed"] > 0
    # Periodic points are those of the certified map.
    for tree, name in ((published, "periodic_fig3"), (finished, "motion_fig3")):
        assert not {"impacts", "impacts_missed"} & set(attributes(tree, name))
        assert "method" not in attributes(tree, name)["config"]


def test_the_run_prints_missed_impacts(published):
    output = (published.path / "output").read_text()
    lines = [line for line in output.splitlines() if "fell through the floor" in line]
    missed = attributes(published, "lyapunov_fig7")["impacts_missed"]
    assert lines[-1] == (
        f"fig7: {missed} of 9,000 impacts fell through the floor (scan 1, tolerance 0.001)"
    )
    assert [line.split(":")[0] for line in lines] == ["fig3", "fig7"]


def test_a_method_makes_its_own_data_alone(published, tmp_path):
    tree = published.copy(tmp_path / "without")
    tree.edit("fig3", method=None)
    (planned,) = tree.run("fig3", "-n").stdout.splitlines()
    assert planned.startswith("fig3: method")
    assert planned.endswith(": motion, drawing")
