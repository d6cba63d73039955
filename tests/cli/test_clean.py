"""./reproduce clean deletes what was made, and nothing else."""

import json
import subprocess
from contextlib import nullcontext

import pytest
from project import Tree, fresh_tree, of_scenes

from pipeline import config
from pipeline.cli.arguments import Arguments
from pipeline.cli.commands import clean


@pytest.fixture
def tree(tmp_path):
    """A copy with files in results/, of which a line in FILES says whether they go."""
    document = of_scenes("fig3", variants={"near": {"energy": 0.009}})
    tree = fresh_tree(tmp_path / "a fresh clone", document)
    for name in FILES:
        file = tree.path / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text("made")
    for name in RECORDED:
        _, folder, *_, file = name.split("/")
        record = tree.path / "results" / folder / "provenance" / f"{file}.json"
        record.parent.mkdir(exist_ok=True)
        record.write_text(json.dumps({"output": {"file": name}}))
    return tree


RECORDED = ["results/paper/motion_fig3.nc", "results/gone/figures/fig9.png"]
FILES = {
    "results/paper/motion_fig3.nc": True,
    "results/paper/periodic_fig3.nc": True,  # its job was killed before it wrote a record
    "results/paper/logs/motion_fig3.nc.log": True,
    "results/paper/figures/.fig3.png.77.part": True,
    "results/near/logs/fig4.png.json": True,
    "results/gone/figures/fig9.png": True,  # of a variant that config.yaml no longer has
    "results/report/report.html": True,
    "results/compare/paper..near/fig3.png": True,
    "results/paper/differences/fig3.png": True,
    "results/paper/notes.txt": False,
    "results/paper/figures/mine.png": False,
    "results/mine/orbits.nc": False,
    ".snakemake/log/x.log": True,
    "paper_figures/fig3.png": False,
}


def left(tree):
    return {name for name in FILES if (tree.path / name).exists()}


def test_all_that_was_made_goes_and_only_that(tree):
    result = tree.run("clean", "--yes")
    assert result.returncode == 0, result.stdout
    assert left(tree) == {name for name, goes in FILES.items() if not goes}
    assert not list((tree.path / "results").rglob("*.json"))
    assert not (tree.path / "results" / "gone").exists()  # empty folders go too
    assert result.stdout.startswith("deleted 11 files, ")
    assert tree.run("clean", "--yes").stdout == "nothing to delete\n"


def test_of_a_variant_alone(tree):
    assert tree.run("clean", "near", "--yes").returncode == 0
    assert left(tree) == set(FILES) - {"results/near/logs/fig4.png.json"}
    result = tree.run("clean", "pape")
    said = "reproduce: no folder results/pape: did you mean paper?\n"
    assert (result.returncode, result.stdout) == (2, said)


def test_it_asks(tree):
    before = left(tree)
    result = tree.run("clean")  # its stdin is empty
    assert result.returncode == 1
    assert result.stdout.splitlines()[-1] == "reproduce: nothing was deleted"
    assert left(tree) == before
    for answer, status in (("n\n", 1), ("y\n", 0)):
        said = subprocess.run(
            Tree.command(tree, "clean", "paper"),
            env=tree.environment(),
            input=answer,
            capture_output=True,
            text=True,
            check=False,
        )
        assert said.returncode == status
        assert "delete 6 files, 0.0 MB, in results/paper? [y/N]" in said.stderr
    assert before - left(tree) == {
        name for name, goes in FILES.items() if goes and name.startswith("results/paper/")
    }


def test_a_result_that_is_committed_stays(tree):
    git = ["git", "-C", str(tree.path), "-c", "user.name=x", "-c", "user.email=x@x"]
    subprocess.run([*git, "init", "-q"], check=True)
    subprocess.run([*git, "add", "-f", "results/paper/motion_fig3.nc"], check=True)
    assert tree.run("clean", "--yes").returncode == 0
    assert "results/paper/motion_fig3.nc" in left(tree)
    assert "results/paper/periodic_fig3.nc" not in left(tree)


@pytest.fixture
def cleaned(tree, monkeypatch):
    """A function that deletes without asking, in this process."""
    monkeypatch.setattr(clean, "ROOT", tree.path)
    monkeypatch.setattr(clean, "RESULTS", tree.path / "results")
    monkeypatch.setattr(clean, "locked", nullcontext)
    given = Arguments(folder=[], yes=True, config=config.load(tree.config))
    return lambda: clean.run(given)


@pytest.fixture
def victim(tree):
    """A user's file beside the tree."""
    path = tree.path.parent / "victim.nc"
    path.write_text("mine")
    return path


@pytest.mark.parametrize(
    "output",
    [
        "results/paper/../../../victim.nc",
        "results/paper/../../../../victim.nc",
        "../victim.nc",
        "results/paper/notes.txt/../../../../victim.nc",
        "results/paper/figures/../notes.txt",
        "VICTIM",
        ["results/paper/victim.nc"],
        {},
        None,
        "\0",
    ],
)
def test_no_path_of_a_record_is_followed(tree, victim, cleaned, output):
    output = str(victim) if output == "VICTIM" else output
    for name in ("victim.nc", "notes.txt"):
        record = tree.path / "results" / "paper" / "provenance" / f"{name}.json"
        record.write_text(json.dumps({"output": {"file": output}}))
    assert cleaned() == 0
    assert victim.read_text() == "mine"
    assert left(tree) == {name for name, goes in FILES.items() if not goes}


@pytest.mark.parametrize("name", ["results", "results/paper", "results/paper/logs", ".snakemake"])
def test_no_link_is_followed(tree, tmp_path, cleaned, capsys, name):
    outside, link = tmp_path / "outside", tree.path / name
    link.rename(outside)
    link.symlink_to(outside)
    (outside / "empty").mkdir()
    before = sorted(outside.rglob("*"))
    assert cleaned() == 0
    assert sorted(outside.rglob("*")) == before
    assert link.is_symlink()
    if name == "results/paper":
        line = "reproduce: results/paper leads out of this folder: what is there stays"
        assert line in capsys.readouterr().err.splitlines()
