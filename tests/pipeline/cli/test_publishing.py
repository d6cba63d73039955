"""The table, the messages and the status at the end of a run, without the run."""

import hashlib
import os

import pytest

from helpers.project import fresh_tree, of_scenes
from pipeline.cli import publishing, running
from pipeline.cli.arguments import Arguments
from pipeline.cli.errors import CommandLineError
from pipeline.config import load


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Four small figures that are made and published, and the first one committed."""
    document = of_scenes("fig7")
    document["scenes"] |= {f"fig7{letter}": document["scenes"]["fig7"] for letter in "abc"}
    tree = fresh_tree(tmp_path_factory.mktemp("publishing") / "tree", document)
    with pytest.MonkeyPatch.context() as patch:
        tree.is_here(patch)
        tree.make_here(*(file for _, file in load(tree.config).figures().values()))
    for drawing in (tree.path / "results/paper/figures").glob("*.png"):
        (tree.path / "paper_figures" / drawing.name).write_bytes(drawing.read_bytes())
    checksum = hashlib.sha256((tree.path / "paper_figures/fig7.png").read_bytes()).hexdigest()
    (tree.path / "paper_figures/SHA256SUMS").write_text(f"{checksum}  fig7.png\n")
    return tree


@pytest.fixture
def tree(made, tmp_path, monkeypatch):
    """A copy for one test."""
    tree = made.copy(tmp_path / "tree")
    tree.is_here(monkeypatch)
    return tree


@pytest.fixture
def make(tree, monkeypatch, capsys):
    """Return a function that ends a run: its status, its stdout and its stderr.

    The run makes nothing and ends with the status `ran`, or is expected not to start.
    """
    for module in (publishing, running):
        monkeypatch.setattr(module, "ROOT", tree.path)
    monkeypatch.setenv("COLUMNS", "1000")

    def run(*names, ran=None, options=(), **how):
        with monkeypatch.context() as patch:
            if ran is not None:
                patch.setattr(running, "make", lambda *given: ran)
            config, args = load(tree.config), Arguments(options=[*options])
            drawings = publishing.drawings_of(config, "paper", names)
            status = publishing.make(config, {"paper": drawings}, args, **how)
        return status, *capsys.readouterr()

    return run


def test_the_table_of_current_figures_says_whether_they_are_as_committed(make, tree):
    status, out, err = make("fig7", "fig7a")
    assert (status, err) == (0, "")
    header, *rows = [line.split() for line in out.splitlines() if line.startswith("fig")]
    assert header == ["figure", "files", "state", "as", "committed"]
    assert rows[0][0] == "fig7" and rows[0][-2:] == ["current", "identical"]
    assert rows[1][0] == "fig7a" and rows[1][-1] != "identical"


def test_a_published_figure_that_is_not_its_drawing_is_published_again(make, tree):
    path = "paper_figures/fig7.png"
    published, words = tree.path / path, f"{path}: published again"
    content = published.read_bytes()
    published.unlink()
    status, out, _ = make("fig7")
    assert status == 0 and f"{words}: it was missing\n" in out
    published.write_text("x")
    os.utime(published, (4e9, 4e9))
    status, out, _ = make("fig7")
    assert status == 0 and f"{words}: it differed from results/paper/figures/fig7.png\n" in out
    assert published.read_bytes() == content
    published.unlink()
    published.mkdir()
    status, out, _ = make("fig7", "fig7a")
    words = "not published: a folder is in its place: move it away"
    assert status == 1 and f"{path}: {words}\n" in out and "fig7a" in out


def test_results_that_were_not_made_are_counted_and_the_first_three_named(make, tree):
    three = "fig7.png, fig7a.png, fig7b.png"
    listed = ("fig7.png", "fig7.png, fig7a.png", three, f"{three} and 1 more")
    for count, (scene, names) in enumerate(zip(load(tree.config).scenes, listed, strict=True), 1):
        (tree.path / f"results/paper/figures/{scene}.png").unlink()
        status, out, err = make(ran=0)
        assert status == 1 and out.count("not made") == count
        words = f"{count} of 4 results not made, or not current: {names}"
        assert err == f"reproduce: {words}\n"


def test_the_status_of_a_run_that_failed_or_was_interrupted_is_kept(make):
    assert make("fig7", ran=2)[0] == 2
    assert make("fig7", ran=running.INTERRUPTED) == (running.INTERRUPTED, "", "")
    assert make("fig7", ran=3, options=["--dag"]) == (3, "", "")  # snakemake has printed it


def test_a_brief_table_leaves_out_what_was_current(make, tree):
    assert "fig7a" not in make(brief=True)[1]
    (tree.path / "paper_figures/fig7a.png").unlink()
    out = make(brief=True)[1]
    assert "fig7a" in out and "fig7b" not in out


def test_names_without_a_figure_are_refused_and_pictures_without_a_scene_named(make, tree):
    with pytest.raises(CommandLineError, match="no figure fig77: did you mean fig7"):
        make("fig77")
    (tree.path / "paper_figures/fig9.png").write_bytes(b"")
    assert "paper_figures/fig9.png: no scene makes it: delete it" in make("fig7")[1]
