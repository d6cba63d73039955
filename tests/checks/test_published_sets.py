"""Missing, broken and stale manifests and checksum lists, and accept, which renews them."""

import hashlib
import shutil

import pytest
from runs import contents
from verdicts import accepting, commit, verified

from pipeline.checks.published_sets import committed_state, edited_lists
from pipeline.records.sources import syntax_hash

FIG3 = "paper_figures/fig3.png"


def test_a_deleted_figure_differs_in_the_layer_file(moved):
    (moved.path / FIG3).unlink()
    found = verified(moved)
    assert found.wrong == {"fig3.png": [f"file: {FIG3} is missing: ./reproduce makes it"]}
    assert found.findings == []


@pytest.mark.parametrize("content", [b"", b"\x89PNG\r\n\x1a\n", b"garbage"])
def test_a_file_that_is_no_figure_differs_in_the_layer_drawing(moved, content):
    for name in ("fig3.png", "fig3.svg"):
        (moved.path / "paper_figures" / name).write_bytes(content)
    found = verified(moved)
    assert (set(found.wrong), found.findings) == ({"fig3.png", "fig3.svg"}, [])
    for name, (words,) in found.wrong.items():
        assert words.startswith(f"drawing: paper_figures/{name}: damaged, or not")


def without(word):
    """Return a function that removes the first line with a word from a text."""

    def change(text):
        lines = text.splitlines(keepends=True)
        lines.remove(next(line for line in lines if word in line))
        return "".join(lines)

    return change


@pytest.mark.parametrize(
    "change",
    [*map(without, ("{", '"matplotlib"', '"pixels"')), "", "[]", "null", "{}", "{", "\0"],
)
def test_a_broken_or_edited_manifest_is_a_finding(moved, change):
    path = moved.path / "paper_figures" / "MANIFEST.json"
    path.write_text(change(path.read_text()) if callable(change) else change)
    found = verified(moved)
    (words,) = found.findings
    assert words.startswith("paper_figures/MANIFEST.json: ")
    assert (found.status, found.wrong) == (1, {})


def test_sums_with_a_missing_or_broken_line_are_renewed(moved):
    path = moved.path / "paper_figures" / "SHA256SUMS"
    text = path.read_text()
    edited = [without("fig3.svg")(text), text.replace(text[:64], "0" * 64)]
    for content in (None, *edited, "not a sum\n", f"{text}not a sum\n"):
        path.unlink(missing_ok=True)
        if content:
            path.write_text(content)
        found, words = verified(moved), "is not as MANIFEST.json has it" if content else "missing"
        assert (found.status, found.wrong) == (1, {})
        assert found.findings == [f"paper_figures/SHA256SUMS: {words}"]
    assert accepting(moved)[0] == 0
    assert path.read_text() == text
    assert verified(moved).status == 0


def test_the_pictures_of_a_removed_scene_are_listed(moved):
    document = moved.document()
    del document["scenes"]["fig7"]
    moved.write(document)
    left = "no scene of config.yaml makes it: delete it, or put its scene back"
    lines = [f"paper_figures/fig7.{kind}: {left}" for kind in ("png", "svg")]
    listed = "lists fig7.png, which config.yaml does not publish: ./reproduce accept takes it out"
    found = verified(moved)
    assert found.status == 1
    assert {f"paper_figures/MANIFEST.json: {listed}", *lines} <= {*found.findings}
    status, said = accepting(moved)
    assert status == 0 and {"fig7.png  gone", *lines} <= {*said}
    assert verified(moved).findings == lines
    assert (moved.path / "paper_figures" / "fig7.png").is_file()


def of_the_paper(lines):
    """Return the lines of accept about the paper's figures."""
    return [line for line in lines if not line.startswith("more_figures/")]


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
    assert found.lines[-1] == "14 of 15 figures identical; 1 note"
    status, lines = accepting(moved)
    assert status == 0
    assert of_the_paper(lines) == [
        "again.png  new",
        "paper_figures/SHA256SUMS and paper_figures/MANIFEST.json renewed: 15 figures",
    ]
    assert verified(moved)[:4] == (0, {}, [], [])


def test_a_file_is_the_committed_one_by_its_bytes(tmp_path):
    (tmp_path / "figures").mkdir()
    for name in ("same.png", "other.png", "new.png"):
        (tmp_path / "figures" / name).write_text(name)
    digest = hashlib.sha256(b"same.png").hexdigest()
    lines = [f"{digest}  {name}.png\n" for name in ("same", "other", "gone")]
    (tmp_path / "figures" / "SHA256SUMS").write_text("".join(lines))
    for name, words in {
        "same": "identical to the committed one",
        "other": "differs from the committed one",
        "new": "not committed",
        "gone": "missing",
    }.items():
        assert committed_state(tmp_path, f"figures/{name}.png") == words


@pytest.mark.parametrize("with_git", [True, False])
def test_a_list_that_was_edited_with_its_file_is_not_the_committed_one(tmp_path, with_git):
    folder = tmp_path / "inside another repository" / "paper_figures"
    folder.mkdir(parents=True)
    sums = folder / "SHA256SUMS"

    def write(text):
        (folder / "fig2.png").write_text(text)
        sums.write_text(f"{hashlib.sha256(text.encode()).hexdigest()}  fig2.png\n")

    write("true")
    if with_git:
        commit(tmp_path, ".")

    def state():
        edited_lists.cache_clear()
        return committed_state(folder.parent, "paper_figures/fig2.png")

    assert state() == "identical to the committed one"
    write("edited")
    words = "SHA256SUMS, which is not as committed" if with_git else "the committed one"
    assert state() == f"identical to {words}"
    (folder / "fig2.png").write_text("true")
    assert state() == f"differs from {words}"


# ---- accept ----


def test_accept_says_what_changed_and_repeats_itself(moved, edited):
    status, lines = accepting(moved)
    assert (status, of_the_paper(lines)) == (0, ["paper_figures: nothing changed"])
    moved.edit("fig7", records=5)
    status, (refusal,) = accepting(moved)
    assert status == 1
    assert "made from another config: records 6 -> 5" in refusal
    with_scenes(moved, edited, "fig7")
    assert set(verified(moved).wrong) == {"fig7.png", "fig7.svg"}
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
