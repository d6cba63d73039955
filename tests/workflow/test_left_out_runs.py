"""Figures that cannot be made: accept and archive say so and go on with the others."""

import pytest

from helpers.project import Tree
from helpers.runs import contents
from helpers.verdicts import accepting, verified
from pipeline import config

REASON = "left out: energy: 0.0017 is not allowed: expected a number below k/2 - g = -0.015"
CANNOT = "cannot exist: axes.t.limits"


@pytest.mark.slow
def test_a_scene_that_a_variant_cannot_have_is_named_and_its_old_picture_goes(variants, tmp_path):
    tree = variants.copy(tmp_path / "small")
    document = tree.document()
    ball = {"ball": {"k": 0.05, "g": 0.04}, "energy": -0.0155}
    document["scenes"]["small"] = document["scenes"]["fig7"] | ball
    tree.write(document)
    old = tree.path / "results/low/figures/small.png"
    old.write_bytes(b"from another config")
    assert f"low: small: {REASON}" in tree.succeed("list")
    lines = tree.succeed("variant", "low", "small").splitlines()
    assert any(line.startswith(f"results/low/figures/small.png: {REASON}") for line in lines)
    assert not old.exists()


@pytest.fixture(scope="module")
def refused(shared, finished):
    """An accepted tree with a scene whose axes show nothing; `said` is what accept has printed."""

    def make(path):
        tree = finished.copy(path)
        document = tree.document()
        axes = {"t": {"limits": [-2, -1], "ticks": [-1]}}
        document["scenes"]["away"] = document["scenes"]["fig3"] | {"axes": axes, "formats": ["png"]}
        tree.write(document)
        with pytest.raises(ValueError):
            tree.make_here("results/paper/figures/away.png")
        status, lines = accepting(tree)
        assert status == 0
        (path / "said").write_text("\n".join(lines))

    return Tree(shared("with a figure that cannot be made", make))


def test_accept_and_archive_go_on_without_a_figure_that_cannot_be_made(refused, tmp_path, capsys):
    left_out = f"away is left out, because it {CANNOT}"
    assert (refused.path / "said").read_text().startswith(left_out)
    assert "away.png" not in (refused.path / "paper_figures/SHA256SUMS").read_text()
    found = verified(refused)
    assert found.status == 0 and found.notes[0].startswith(left_out)
    archive = pytest.importorskip("extensions.publication.archive")
    archive.write(refused.path, config.load(refused.config), tmp_path / "a.tar")
    assert capsys.readouterr().out.startswith(left_out)


@pytest.mark.slow
def test_a_published_picture_whose_scene_cannot_exist_is_named_with_the_reason(finished, tmp_path):
    tree, file = finished.copy(tmp_path / "left"), "paper_figures/fig3.png"
    assert accepting(tree)[0] == 0
    document = tree.document()
    document["scenes"]["fig3"]["axes"]["t"] = {"limits": [-2, -1], "ticks": [-1]}
    tree.write(document)
    drawing = "results/paper/figures/fig3.png"
    (tree.path / drawing).unlink()
    with pytest.raises(ValueError):
        tree.make_here(drawing)
    found = verified(tree)
    listed = "lists fig3.png, whose scene cannot exist: ./reproduce accept takes it out"
    assert f"paper_figures/MANIFEST.json: {listed}" in found.findings
    (line,) = [line for line in found.findings if line.startswith(file)]
    assert line.startswith(f"{file}: its scene {CANNOT}")
    assert line.endswith(": delete it, or change its scene")
    status, lines = accepting(tree)
    assert status == 0 and line in lines
    archive = pytest.importorskip("extensions.publication.archive")
    with pytest.raises(archive.ArchiveError) as error:
        archive.write(tree.path, config.load(tree.config), tmp_path / "a.tar")
    assert str(error.value) == line
    for picture in (tree.path / "paper_figures").glob("fig3.*"):
        picture.unlink()
    archive.write(tree.path, config.load(tree.config), tmp_path / "a.tar")


@pytest.mark.slow
def test_a_stray_picture_is_named_by_archive_and_by_accept(refused, tmp_path):
    tree, file = refused.copy(tmp_path / "stray"), "paper_figures/FIG2.png"
    (tree.path / file).write_bytes(contents(tree)["fig3.png"])
    words = f"{file}: no scene makes it: delete it, or put its scene back"
    status, lines = accepting(tree)
    assert (status, lines[1:]) == (0, ["paper_figures: nothing changed", words])
    archive = pytest.importorskip("extensions.publication.archive")
    with pytest.raises(archive.ArchiveError) as error:
        archive.write(tree.path, config.load(tree.config), tmp_path / "a.tar")
    assert str(error.value) == words
