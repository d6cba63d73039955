"""The archive: one file, the same to the byte, with which a tree verifies."""

import hashlib
import os
import shutil
import subprocess
import tarfile

import pytest

from extensions.explorer import page
from extensions.publication import archive
from extensions.publication.archive import EXPLORER
from extensions.publication.commands import against as command
from helpers.parts.archives import against
from helpers.project import SHIPPED
from pipeline import config
from pipeline.checks.published_sets import committed_sets
from pipeline.cli.arguments import Arguments
from pipeline.cli.errors import UsageError
from pipeline.records.files import FileError, write_whole

FILE = "results/archive/pseudorigid.tar"


def written(tree, path):
    return archive.write(tree.path, config.load(tree.config), path)


def sha256(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


def test_contents_of_an_archive(accepted, packed, tmp_path):
    with tarfile.open(packed) as tar:
        entries = tar.getmembers()
    assert {(e.mtime, e.uid, e.gid, e.uname, e.gname, e.mode, e.type) for e in entries} == {
        (0, 0, 0, "", "", 0o644, tarfile.REGTYPE)
    }
    names = [e.name.removeprefix("pseudorigid/") for e in entries]
    assert names[:-1] == sorted(names[:-1]) and names[-1] == "SHA256SUMS"
    assert {"README.txt", "config.yaml", "paper_figures/MANIFEST.json"} < set(names)
    assert any(name.endswith("certificates/twist-six.toml") for name in names)
    subprocess.run(["tar", "-xf", packed, "-C", tmp_path], check=True)
    folder = tmp_path / "pseudorigid"
    for name in names:
        if (accepted.path / name).exists() and "/provenance/" not in name:
            assert (folder / name).read_bytes() == (accepted.path / name).read_bytes()
    data = {p.name for p in (accepted.path / "results" / "paper").glob("*.nc")}
    assert data and {name[14:] for name in names if name.endswith(".nc")} == data
    figures = {p.name for p in (accepted.path / "paper_figures").iterdir()}
    assert {name[14:] for name in names if name.startswith("paper_figures/")} == figures
    assert (folder / EXPLORER).read_text() == page.render(config.load(accepted.config), folder)
    assert f"{len(data)} of {len(data)} datasets" in (folder / "README.txt").read_text()
    for place in (folder, folder / "paper_figures"):
        subprocess.run(["sha256sum", "--quiet", "-c", "SHA256SUMS"], cwd=place, check=True)


def test_datasets_are_archived_with_what_they_are_made_from(tmp_path, monkeypatch):
    """Else the unpacked archive of a tree with an atlas does not verify."""
    checked = config.load(SHIPPED)
    specs = {p: s for each in committed_sets(checked) for p, s in each.build_specs.items()}
    datasets = {path for path in specs if path.endswith(".nc")}
    lists = [f"{each.folder}/SHA256SUMS" for each in committed_sets(checked)]
    for path in (*datasets, *lists):
        write_whole(tmp_path / path, "")
    monkeypatch.setattr(archive, "_explorer_page", lambda *_: {})
    archived = archive.contents(tmp_path, checked)
    made = [path for path in specs if path in archived]
    assert any(specs[path].inputs for path in made)
    assert {used for path in made for used in specs[path].inputs} <= archived.keys()


def test_an_archive_does_not_depend_on_machine_and_settings(accepted, packed, tmp_path):
    other = accepted.copy(tmp_path / "another folder")
    for record in (other.path / "results" / "paper" / "provenance").glob("*.json"):
        text = record.read_text().replace('"commit": ', '"commit": "made elsewhere", "was": ')
        record.write_text(text)
        os.utime(record, (1e9, 1e9))
    settings = {"TZ": "Pacific/Chatham", "LC_ALL": "tr_TR.UTF-8", "PYTHONHASHSEED": "7"}
    result = other.run("archive", OMP_NUM_THREADS="3", **settings)
    assert result.returncode == 0, result.stdout
    assert result.stdout.split()[:2] == [sha256(packed), FILE]
    data = packed.read_bytes()
    assert (other.path / FILE).read_bytes() == data
    for word in (str(accepted.path), '"commit"', '"dirty"', '"python"'):
        assert word.encode() not in data


def test_each_difference_from_an_archive_is_named(moved, packed):
    status, rows, lines = against(moved, packed)
    assert status == 0 and set(rows.values()) == {"identical"}
    assert len(rows) >= 31 and lines[-1] == f"{len(rows)} identical"
    data = moved.path / "results" / "paper" / "motion_fig3.nc"
    shutil.copy(moved.path / "results" / "paper" / "motion_fig4.nc", data)
    figures = moved.path / "paper_figures"
    shutil.copy(figures / "fig4.png", figures / "fig3.png")
    (figures / "fig7.svg").unlink()
    (moved.path / "LICENSE").write_text("ours")
    status, rows, lines = against(moved, packed)
    assert status == 1
    assert rows.pop("results/paper/motion_fig3.nc") == rows.pop("paper_figures/fig3.png")
    assert rows.pop("paper_figures/fig7.svg") == "missing here"
    assert rows.pop("LICENSE") == "not in the archive" and set(rows.values()) == {"identical"}
    text = "\n".join(lines)
    assert "  data: results/paper/motion_fig3.nc: variable " in text
    assert "  drawing: paper_figures/fig3.png: " in text
    assert lines[-1].endswith("2 differs, 1 missing here, 1 not in the archive")


@pytest.mark.parametrize(("name", "data", "problem", "command"), [
    ("results/paper/motion_fig3.nc", None, "is missing", "./reproduce"),
    ("paper_figures/fig3.png", "x", "is not results/paper/figures/fig3.png", "./reproduce"),
    ("paper_figures/SHA256SUMS", f"{'0' * 64}  ../../x\n", "is not as", "./reproduce accept"),
    ("paper_figures/MANIFEST.json", "{}", "was edited", "./reproduce accept"),
])  # fmt: skip
def test_nothing_stale_or_missing_is_archived(moved, tmp_path, name, data, problem, command):
    (moved.path / name).unlink()
    if data is not None:
        (moved.path / name).write_text(data)
    with pytest.raises(archive.ArchiveError) as raised:
        written(moved, tmp_path / "new" / "a.tar")
    line = str(raised.value)
    assert name in line and problem in line and line.endswith(f": run {command}")
    assert not list((tmp_path / "new").glob("*"))


def test_only_another_archive_is_replaced(accepted, packed, tmp_path):
    notes = tmp_path / "notes.tar"
    notes.write_text("mine")
    with pytest.raises(archive.ArchiveError, match="no archive, or damaged"):
        written(accepted, notes)
    assert notes.read_text() == "mine"
    with pytest.raises(FileError, match=r"^/proc/x.tar: cannot be written: No such file [^\n]+$"):
        written(accepted, "/proc/x.tar")
    shutil.copy(packed, tmp_path / "old.tar")
    assert written(accepted, tmp_path / "old.tar") == sha256(packed)


def test_a_damaged_archive_is_refused_in_one_line(packed, tmp_path):
    good, path = packed.read_bytes(), tmp_path / "a.tar"
    in_data = good.index(b"\x89HDF") + 9000
    for content, words in (
        (good[: len(good) // 2], "(no archive|not made by)"),
        (good[:in_data] + b"!" + good[in_data + 1 :], "damaged: results/paper/"),
    ):
        path.write_bytes(content)
        with pytest.raises(archive.ArchiveError, match=rf"a.tar: {words}[^\n]+$"):
            archive.read(path)


@pytest.mark.parametrize(("argument", "status", "words"), [
    ("text.tar", 1, "no archive, or damaged"),
    ("empty", 1, "no tree of this project"),
    ("", 2, "no archive or folder ''"),
    ("x" * 300, 2, "no archive or folder"),
])  # fmt: skip
def test_what_is_no_archive_is_refused_in_one_line(accepted, tmp_path, argument, status, words):
    (tmp_path / "text.tar").write_text("text")
    (tmp_path / "empty").mkdir()
    args = Arguments(
        against=argument, start=tmp_path, config=config.load(accepted.config), json=False
    )
    with pytest.raises(UsageError) as raised:
        command.run(args)
    line = str(raised.value)
    assert (raised.value.status, line.count("\n")) == (status, 0)
    assert line.startswith("verify: ") and argument in line and words in line


def test_a_comparison_is_not_printed_as_json():
    with pytest.raises(UsageError, match=r"^verify: --json is not used with --against$"):
        command.run(Arguments(against="an archive", json=True))
