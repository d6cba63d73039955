"""./reproduce clean deletes generated files, and nothing else."""

import io
import json
import shutil
from contextlib import nullcontext

import pytest
import yaml
from project import ROOT, of_scenes
from verdicts import commit

from pipeline import config
from pipeline.cli import arguments
from pipeline.cli.commands import clean
from pipeline.cli.session import CommandLineError, UsageError
from pipeline.records.record import SHAPE, git, record_path

DOCUMENT = of_scenes("fig3", variants={"near": {"energy": 0.009}})
RECORDED = [
    *("results/paper/motion_fig3.nc", "results/paper/figures/fig3.png"),
    "results/gone/figures/fig9.png",
]
# File -> whether it is deleted.
FILES = {
    "results/paper/motion_fig3.nc": True,
    "results/paper/periodic_fig3.nc": True,  # without a record: its job was killed
    "results/paper/logs/motion_fig3.nc.log": True,
    "results/paper/figures/.fig3.png.77.part": True,
    "results/near/logs/fig4.png.json": True,
    "results/near/why/fig4.png.txt": True,
    "results/gone/figures/fig9.png": True,  # its variant is not in config.yaml
    "results/page/page.html": True,
    "results/pairs/paper..near/fig3.png": True,
    "results/paper/differences/fig3.png": True,
    "results/paper/fig3.png": False,  # a user's copy, beside the folder of the recorded one
    "results/paper/notes.txt": False,
    "results/paper/figures/mine.png": False,
    "results/mine/orbits.nc": False,
    ".snakemake/log/x.log": True,
    "paper_figures/fig3.png": False,
}
OF_COMMANDS = ("page.html", "page/page.html", "pairs/*..*/*.png")  # as parts declare them
KEPT = {name for name, goes in FILES.items() if not goes}


def write(file, text="made"):
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text)


def write_record(root, result):
    write(
        root / record_path(result),
        json.dumps({key: {"sha256": ""} for key in SHAPE}),
    )


def write_files(root):
    for name in FILES:
        write(root / name)
    for name in RECORDED:
        write_record(root, name)


def left(root):
    return {name for name in FILES if (root / name).exists()}


@pytest.fixture
def root(tmp_path, monkeypatch):
    """A folder with a config and FILES, which `clean` takes for the project's root."""
    root = tmp_path / "a clone"
    root.mkdir()
    (root / "config.yaml").write_text(yaml.safe_dump(DOCUMENT, sort_keys=False))
    write_files(root)
    monkeypatch.setattr(clean, "ROOT", root)
    monkeypatch.setattr(clean, "RESULTS", root / "results")
    monkeypatch.setattr(clean, "locked", nullcontext)
    monkeypatch.setattr(clean, "_OF_COMMANDS", OF_COMMANDS)
    return root


def run(*words, root):
    """Run `clean` with further words."""
    args = arguments.read(["clean", *words])
    args.config = config.load(root / "config.yaml")
    return clean.run(args)


def test_generated_files_are_deleted(root, capsys):
    assert run("--yes", root=root) == 0
    assert left(root) == KEPT
    assert not list((root / "results").rglob("*.json"))
    assert not (root / "results" / "gone").exists()  # empty folders are deleted
    assert capsys.readouterr().out.startswith("deleted 13 files, ")
    assert run("--yes", root=root) == 0
    assert capsys.readouterr().out == "nothing to delete\n"


def test_only_named_folders_are_cleaned(root):
    assert run("near", "--yes", root=root) == 0
    generated = {"results/near/logs/fig4.png.json", "results/near/why/fig4.png.txt"}
    assert left(root) == set(FILES) - generated
    with pytest.raises(CommandLineError, match="no folder results/pape: did you mean paper"):
        run("pape", root=root)


@pytest.mark.parametrize("answer", ["", "n\n", "y\n"])
def test_nothing_is_deleted_without_a_yes(root, monkeypatch, capsys, answer):
    monkeypatch.setattr("sys.stdin", io.StringIO(answer))
    goes = set()
    if answer == "y\n":
        assert run("paper", root=root) == 0
        goes = {name for name in FILES if name.startswith("results/paper/")} - KEPT
    else:
        with pytest.raises(UsageError, match="nothing was deleted"):
            run("paper", root=root)
    assert "delete 7 files, 0.0 MB, in results/paper? [y/N]" in capsys.readouterr().err
    assert left(root) == set(FILES) - goes


def test_a_result_that_is_committed_stays(root):
    commit(root, "results/paper/motion_fig3.nc")
    assert run("--yes", root=root) == 0
    assert left(root) == KEPT | {"results/paper/motion_fig3.nc"}


def test_nothing_is_deleted_if_git_does_not_say_what_is_committed(root, monkeypatch):
    """As in a tree of another user, whose repository git refuses to read."""
    commit(root, "results/paper/motion_fig3.nc")
    monkeypatch.setenv("GIT_TEST_ASSUME_DIFFERENT_OWNER", "1")
    with pytest.raises(UsageError, match="git does not say which files in results are committed"):
        run("--yes", root=root)
    assert left(root) == {*FILES}


def test_records_that_do_not_name_a_result_delete_nothing(root):
    """A folder that no set or variant has may have files of such names."""
    for name, text in {"x.txt": "{}", "orbits.nc": "mine"}.items():
        write(root / f"results/mine/provenance/{name}.json", text)
    before = sorted((root / "results/mine").rglob("*"))
    assert run("--yes", root=root) == 0
    assert sorted((root / "results/mine").rglob("*")) == before
    assert left(root) == KEPT


def test_results_may_be_a_link(root, tmp_path, capsys):
    """As on a cluster; git may track files of the folder elsewhere."""
    outside = tmp_path / "scratch" / "of mine"
    outside.parent.mkdir()
    (root / "results").rename(outside)
    (root / "results").symlink_to(outside)
    write(outside / "page.html")
    (outside / "mine" / "link").symlink_to("orbits.nc")
    commit(outside.parent, "of mine/paper/motion_fig3.nc")
    assert run("--yes", root=root) == 0
    assert left(root) == KEPT | {"results/paper/motion_fig3.nc"}
    assert (root / "results").is_symlink() and not (outside / "page.html").exists()
    first, *others = capsys.readouterr().out.splitlines()
    assert first.startswith("deleted 13 files, ")
    kept = {f"stays: {name}" for name in left(root) if name.startswith("results/")}
    assert {*others} == kept | {"stays: results/mine/link"}


def test_files_of_others_stay_behind_a_link(root, tmp_path, monkeypatch):
    """A folder that has more than results may have folders of such names."""
    home = tmp_path / "home"
    names = ["paper/logs/build.log", "report/index.html", "logs/a.nc.log", "other/logs/a.nc.log"]
    names += ["paper/why.txt", "compare/a/b.png", ".x.part", "other/.x.part"]
    for name in names:
        write(home / name)
    results = (root / "results").rename(root / "kept")
    (root / "results").symlink_to(home)
    assert run("--yes", root=root) == 0
    assert all((home / name).exists() for name in names)
    monkeypatch.setenv("HOME", str(home))
    for folder in (home, root, root.parent, "/"):
        (root / "results").unlink()
        (root / "results").symlink_to(folder)
        with pytest.raises(UsageError, match=r"^results is a link to .*, which has other files"):
            run("--yes", root=root)
    assert results.is_dir() and all((home / name).exists() for name in names)


def test_a_link_in_the_place_of_results_is_ignored_by_git(root):
    shutil.copy(ROOT / ".gitignore", root)
    commit(root, "config.yaml")
    for name in ("results", ".snakemake"):
        (root / name).rename(root.parent / name)
        (root / name).symlink_to(root.parent / name)
    untracked = git("status", "--porcelain", "--untracked-files=all", root=root)
    assert b"results" not in untracked and b".snakemake" not in untracked


@pytest.mark.parametrize("name", ["results/paper", "results/paper/logs", ".snakemake"])
def test_no_other_link_is_followed(root, tmp_path, name):
    outside, link = tmp_path / "outside", root / name
    link.rename(outside)
    link.symlink_to(outside)
    (outside / "empty").mkdir()
    before = sorted(outside.rglob("*"))
    assert run("--yes", root=root) == 0
    assert sorted(outside.rglob("*")) == before
    assert link.is_symlink()
