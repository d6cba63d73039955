"""Missing, broken and stale manifests and checksum lists, and accept, which renews them."""

import hashlib
import shutil
import subprocess

import pytest

from helpers.runs import contents
from helpers.verdicts import accepting, commit, verified
from pipeline.checks.published_sets import committed_state, edited_lists
from pipeline.records.sources import syntax_hash


def without(word, text):
    """Return a text without its first line that has a word."""
    lines = text.splitlines(keepends=True)
    lines.remove(next(line for line in lines if word in line))
    return "".join(lines)


def test_a_broken_or_edited_manifest_is_a_finding(moved):
    path = moved.path / "paper_figures" / "MANIFEST.json"
    text = path.read_text()
    edited = [without(word, text) for word in ("{", '"matplotlib"', '"drawing"')]
    for content in (*edited, "[]", "{"):
        path.write_text(content)
        found = verified(moved)
        (words,) = found.findings
        assert words.startswith("paper_figures/MANIFEST.json: ")
        assert (found.status, found.wrong) == (1, {})


def test_sums_with_a_missing_or_broken_line_are_renewed(moved):
    path = moved.path / "paper_figures" / "SHA256SUMS"
    text = path.read_text()
    for content in (None, text.replace(text[:64], "0" * 64)):
        path.unlink()
        if content:
            path.write_text(content)
        found, words = verified(moved), "is not as MANIFEST.json has it" if content else "missing"
        assert (found.status, found.wrong) == (1, {})
        assert found.findings == [f"paper_figures/SHA256SUMS: {words}"]
        path.touch()
    path.unlink()
    status, lines = accepting(moved)
    assert status == 0 and lines[0] == "paper_figures/SHA256SUMS: missing"
    assert path.read_text() == text
    assert verified(moved).status == 0


def test_the_pictures_of_a_removed_scene_are_listed(moved):
    document = moved.document()
    del document["scenes"]["fig7"]
    moved.write(document)
    left = "no scene makes it: delete it, or put its scene back"
    lines = [f"paper_figures/fig7.{kind}: {left}" for kind in ("png", "svg")]
    listed = "lists fig7.png, which config.yaml does not publish: ./reproduce accept takes it out"
    found = verified(moved)
    assert found.status == 1
    assert {f"paper_figures/MANIFEST.json: {listed}", *lines} <= {*found.findings}
    status, said = accepting(moved)
    assert status == 0 and {"fig7.png  gone", *lines} <= {*said}
    assert verified(moved).findings == lines
    assert (moved.path / "paper_figures" / "fig7.png").is_file()


@pytest.mark.slow
def test_a_picture_of_a_scene_that_is_gone_is_removed_if_it_was_published_here(moved):
    """What git tracks, what another hand drew, and what an unknown repository has stay."""
    figures, drawn = moved.path / "paper_figures", moved.path / "results/paper/figures"
    for name in ("gone", "tracked", "other"):
        (drawn / f"{name}.png").write_bytes(name.encode())
        (figures / f"{name}.png").write_bytes(name.encode())
    (figures / "other.png").write_bytes(b"edited")
    removes = "no scene makes it: ./reproduce accept removes it, or put its scene back"
    by_hand = "no scene makes it: delete it, or put its scene back"
    assert [by_hand] * 3 == [line.partition(": ")[2] for line in verified(moved).findings]
    accepting(moved)
    assert (figures / "gone.png").exists()
    commit(moved.path, *(f"paper_figures/{f.name}" for f in figures.iterdir() if f.stem != "gone"))
    untrack = ["git", "-C", moved.path, "rm", "-q", "--cached", "paper_figures/other.png"]
    subprocess.run(untrack, check=True)
    lines = [f"paper_figures/{name}.png: {by_hand}" for name in ("other", "tracked")]
    assert verified(moved).findings == [f"paper_figures/gone.png: {removes}", *lines]
    status, said = accepting(moved)
    assert status == 0 and said[0] == "paper_figures/gone.png: removed: no scene makes it"
    assert not (figures / "gone.png").exists()
    assert (figures / "tracked.png").exists() and (figures / "other.png").exists()
    assert verified(moved).findings == lines


def with_scenes(tree, other, *names):
    """Give a tree some scenes of another one, with its results as if this tree had made them."""
    document = tree.document()
    document["scenes"] |= {name: other.document()["scenes"][name] for name in names}
    tree.write(document)
    module = "src/pseudorigid/dynamics/orbits.py"  # which the other tree has edited
    edited, own = (syntax_hash(each.path / module) for each in (other, tree))
    for name in names:
        tree.take(other, name)
        for record in (tree.path / "results/paper/provenance").glob(f"*{name}*.json"):
            record.write_text(record.read_text().replace(edited, own))


def test_an_added_scene_is_a_note_until_it_is_accepted(moved, edited):
    with_scenes(moved, edited, "again")
    found = verified(moved)
    assert found.notes == ["again.png: new: ./reproduce accept adds it to the manifest"]
    assert (found.status, found.findings) == (0, [])
    assert found.wrong == {}
    assert found.lines[-1] == "14 of 15 files identical; 1 note"
    status, lines = accepting(moved)
    assert status == 0
    assert [line for line in lines if not line.startswith("more_figures/")] == [
        "again.png  new",
        "paper_figures/SHA256SUMS and paper_figures/MANIFEST.json renewed: 15 figures",
    ]
    assert verified(moved)[:4] == (0, {}, [], [])


@pytest.mark.parametrize("with_git", [True, False])
def test_a_file_is_the_committed_one_by_its_bytes_and_a_list_as_git_says(
    tmp_path, monkeypatch, with_git
):
    folder = tmp_path / "inside another repository" / "paper_figures"
    folder.mkdir(parents=True)
    digest = hashlib.sha256(b"true").hexdigest()
    sums, figure = folder / "SHA256SUMS", folder / "fig2.png"
    sums.write_text(f"{digest}  fig2.png\n{digest}  gone.png\n")
    for file in (figure, folder / "new.png"):
        file.write_text("true")
    if with_git:
        commit(tmp_path, ".")

    def state(name):
        edited_lists.cache_clear()
        return committed_state(folder.parent, f"paper_figures/{name}.png")

    assert state("new") == "not committed"
    assert state("gone") == "missing"
    assert state("fig2") == "identical"
    figure.write_text("edited")
    assert state("fig2") == "differs"
    sums.write_text(f"{hashlib.sha256(b'edited').hexdigest()}  fig2.png\n")
    words = "unknown: {} by SHA256SUMS, which is " * with_git + "{}"
    edited = "not the committed one, see git diff"
    assert state("fig2") == words.format("identical", edited)
    figure.write_text("true")
    assert state("fig2") == words.format("differs", edited)
    # As if the repository were of another user, so that git refuses to read it.
    monkeypatch.setenv("GIT_TEST_ASSUME_DIFFERENT_OWNER", "1")
    unknown = "not known to be the committed one, see git status"
    assert state("fig2") == words.format("differs", unknown)


# ---- accept ----


def test_accept_says_what_changed(moved, edited):
    moved.edit("fig7", records=5)
    status, (refusal,) = accepting(moved)
    assert status == 1
    assert "made from another config: records 6 -> 5" in refusal
    with_scenes(moved, edited, "fig7")
    status, lines = accepting(moved)
    assert status == 0
    assert lines[0] == "fig7.png  config: records: 6 in the manifest, 5 in config.yaml"
    assert any(line.startswith("fig7.png  data: results/paper/lyapunov_fig7.nc") for line in lines)
    assert any(line.startswith("fig7.svg  drawing: ") for line in lines)
    assert not any(line.startswith("fig2.png") for line in lines)
    assert verified(moved).status == 0


def test_accept_without_results_is_one_line(moved):
    shutil.rmtree(moved.path / "results")
    before = contents(moved)
    status, (line,) = accepting(moved)
    assert status == 1
    assert line.endswith("is missing: run ./reproduce first")
    assert contents(moved) == before
