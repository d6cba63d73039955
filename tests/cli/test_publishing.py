"""The table, the messages and the status at the end of a run, without the run."""

import hashlib
import os

import pytest
from project import fresh_tree, of_scenes

from pipeline.cli import publishing, running
from pipeline.cli.arguments import Arguments
from pipeline.cli.errors import CommandLineError
from pipeline.config import load
from pipeline.records import sources


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Four small figures that are made and published, and the first one committed."""
    document = of_scenes("fig7")
    document["scenes"] |= {f"fig7{letter}": document["scenes"]["fig7"] for letter in "abc"}
    tree = fresh_tree(tmp_path_factory.mktemp("publishing") / "tree", document)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sources, "ROOT", tree.path)
        patch.setattr(sources, "SRC", tree.path / "src")
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
    monkeypatch.setattr(sources, "ROOT", tree.path)
    monkeypatch.setattr(sources, "SRC", tree.path / "src")
    return tree


@pytest.fixture
def make(tree, monkeypatch, capsys):
    """Return a function that ends a run: its status, its stdout and its stderr.

    The run makes nothing and ends with the status `ran`, or is expected not to start.
    """
    for module in (publishing, running):
        monkeypatch.setattr(module, "ROOT", tree.path)

    def run(*names, ran=None, options=(), **how):
        def make(freshness, results, args):
            assert ran is not None
            return ran

        with monkeypatch.context() as patch:
            patch.setattr(running, "make", make) if ran is not None else None
            config, args = load(tree.config), Arguments(options=[*options])
            drawings = publishing.drawings_of(config, "paper", names)
            status = publishing.make(config, "paper", drawings, args, **how)
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
    names, said = [*load(tree.config).scenes], []
    for name in names:
        (tree.path / f"results/paper/figures/{name}.png").unlink()
        status, out, err = make(ran=0)
        assert status == 1 and out.count("not made") == 1 + names.index(name)
        said.append(err.removeprefix("reproduce: ").rstrip())
    assert said == [
        f"{count} of 4 results not made, or not current: {listed}"
        for count, listed in enumerate((
            "fig7.png", "fig7.png, fig7a.png", "fig7.png, fig7a.png, fig7b.png",
            "fig7.png, fig7a.png, fig7b.png and 1 more",
        ), start=1)
    ]  # fmt: skip


def test_the_status_of_a_run_that_failed_or_was_interrupted_is_kept(make):
    assert make("fig7", ran=2)[0] == 2
    assert make("fig7", ran=running.INTERRUPTED) == (running.INTERRUPTED, "", "")
    assert make("fig7", ran=3, options=["--dag"]) == (3, "", "")  # snakemake has printed it


def test_a_brief_table_leaves_out_what_was_current(make, tree):
    assert "fig7a" not in make(brief=True)[1]
    (tree.path / "paper_figures/fig7a.png").unlink()
    out = make(brief=True)[1]
    assert "fig7a" in out and "fig7b" not in out


def test_a_name_that_is_no_figure_is_refused(make):
    with pytest.raises(CommandLineError, match="no figure fig77: did you mean fig7"):
        make("fig77")


def test_a_picture_without_a_scene_is_named_below_the_table(make, tree):
    (tree.path / "paper_figures/fig9.png").write_bytes(b"")
    assert "paper_figures/fig9.png: no scene makes it: delete it" in make("fig7")[1]
