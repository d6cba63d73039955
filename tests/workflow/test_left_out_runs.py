"""Figures that cannot be made: accept and archive say so and go on with the others."""

import pytest
from project import Tree
from runs import contents
from verdicts import accepting, verified

from pipeline import config

REASON = "left out: energy: 0.0017 is not allowed: expected a number below k/2 - g = -0.015"
CANNOT = "cannot exist: axes.t.limits"


@pytest.fixture
def small(variants, tmp_path):
    """A tree in which one variant cannot have one scene."""
    tree = variants.copy(tmp_path / "small")
    document = tree.document()
    document["scenes"]["small"] = document["scenes"]["fig7"] | {
        "ball": {"k": 0.05, "g": 0.04}, "energy": -0.0155,
    }  # fmt: skip
    tree.write(document)
    return tree


@pytest.mark.slow
def test_a_scene_that_a_variant_cannot_have_is_named_with_the_reason(small):
    old = small.path / "results/low/figures/small.png"
    old.write_bytes(b"from another config")
    assert f"small: {REASON}" in small.succeed("variant", "low", "-n")
    assert f"low      {REASON}" in small.succeed("list")
    lines = small.succeed("variant", "low", "small").splitlines()
    assert any(line.startswith("small   results/low/figures/small.png") for line in lines)
    assert any(line.startswith(f"results/low/figures/small.png: {REASON}") for line in lines)
    assert not old.exists()
    output = small.succeed("compare", "low", "doubled", "small")
    assert f"  low: {REASON}" in output and "side by side: results/compare/low..doubled" in output
    assert small.run("variant", "low", "smal").returncode == 2


@pytest.fixture(scope="module")
def refused(shared, finished):
    """A tree with a scene whose axes show nothing, which was tried."""

    def make(path):
        tree = finished.copy(path)
        document = tree.document()
        away = {"limits": [-2, -1], "ticks": [-1]}
        document["scenes"]["away"] = document["scenes"]["fig3"] | {
            "axes": {"t": away}, "formats": ["png"],
        }  # fmt: skip
        tree.write(document)
        with pytest.raises(ValueError):
            tree.make_here("results/paper/figures/away.png")

    return Tree(shared("with a figure that cannot be made", make))


def test_accept_and_archive_go_on_without_a_figure_that_cannot_be_made(refused, tmp_path, capsys):
    tree = refused.copy(tmp_path / "accepted")
    status, lines = accepting(tree)
    assert status == 0 and lines[0].startswith(f"away is left out, {CANNOT}")
    assert "away.png" not in (tree.path / "paper_figures/SHA256SUMS").read_text()
    found = verified(tree)
    assert found.status == 0 and found.notes[0].startswith(f"away is left out, {CANNOT}")
    archive = pytest.importorskip("extensions.publication.archive")
    archive.write(tree.path, config.load(tree.config), tmp_path / "a.tar")
    assert capsys.readouterr().out.startswith(f"away is left out, {CANNOT}")


def test_a_stray_picture_is_named_by_archive_and_by_accept(refused, tmp_path):
    tree, name = refused.copy(tmp_path / "stray"), "FIG2.png"
    accepting(tree)
    (tree.path / "paper_figures" / name).write_bytes(contents(tree)["fig3.png"])
    words = f"paper_figures/{name}: no scene makes it: delete it, or put its scene back"
    status, lines = accepting(tree)
    assert (status, lines[1:]) == (0, ["paper_figures: nothing changed", words])
    archive = pytest.importorskip("extensions.publication.archive")
    with pytest.raises(archive.ArchiveError) as error:
        archive.write(tree.path, config.load(tree.config), tmp_path / "a.tar")
    assert str(error.value) == words
