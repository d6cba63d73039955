"""The archive: one file, the same to the byte, with which a tree verifies."""

import hashlib
import os
import shutil
import subprocess
import tarfile

import pytest

from pipeline import config
from pipeline.checks import archive

FILE = "results/archive/pseudorigid.tar"


def written(tree, path):
    return archive.write(tree.path, config.load(tree.config), path)


def compared(tree, path, capsys):
    """(exit status, file -> word, all lines) of verify --against."""
    capsys.readouterr()
    status = archive.verify(tree.path, config.load(tree.config), path)
    lines = capsys.readouterr().out.splitlines()
    rows = (line.split(maxsplit=1) for line in lines if line[:1].strip() and "/" in line[:20])
    return status, {name: word for name, word in rows}, lines


@pytest.fixture(scope="module")
def packed(accepted, tmp_path_factory):
    path = tmp_path_factory.mktemp("archive") / "a.tar"
    written(accepted, path)
    return path


def test_what_is_in_it(accepted, packed, tmp_path):
    with tarfile.open(packed) as tar:
        entries = tar.getmembers()
    subprocess.run(["tar", "-xf", packed, "-C", tmp_path], check=True)
    assert all(
        (e.mtime, e.uid, e.gid, e.uname, e.gname, e.mode, e.type)
        == (0, 0, 0, "", "", 0o644, tarfile.REGTYPE)
        for e in entries
    )
    names = [e.name.removeprefix("pseudorigid/") for e in entries]
    assert names[:-1] == sorted(names[:-1]) and names[-1] == "SHA256SUMS"
    assert {"README.txt", "config.yaml", "paper_figures/MANIFEST.json"} < set(names)
    assert any(name.endswith("certificates/twist-six.toml") for name in names)
    folder = tmp_path / "pseudorigid"
    for name in names:
        if (accepted.path / name).exists() and "/provenance/" not in name:
            assert (folder / name).read_bytes() == (accepted.path / name).read_bytes()
    data = {p.name for p in (accepted.path / "results" / "paper").glob("*.nc")}
    assert data and {name[14:] for name in names if name.endswith(".nc")} == data
    figures = {p.name for p in (accepted.path / "paper_figures").iterdir()}
    assert {name[14:] for name in names if name.startswith("paper_figures/")} == figures
    assert (
        f"{len(data)} of {len(data)} datasets of ./reproduce" in (folder / "README.txt").read_text()
    )
    for place in (folder, folder / "paper_figures"):
        subprocess.run(["sha256sum", "--quiet", "-c", "SHA256SUMS"], cwd=place, check=True)


def test_nothing_of_one_machine_is_in_it(accepted, packed):
    text = packed.read_bytes()
    for word in (str(accepted.path), '"commit"', '"dirty"', '"python"'):
        assert word.encode() not in text


def test_the_same_bytes_elsewhere_and_with_other_settings(accepted, packed, tmp_path):
    other = accepted.copy(tmp_path / "another folder")
    for record in (other.path / "results" / "paper" / "provenance").glob("*.json"):
        text = record.read_text().replace('"commit": ', '"commit": "made elsewhere", "was": ')
        record.write_text(text)
        os.utime(record, (1e9, 1e9))
    settings = {"TZ": "Pacific/Chatham", "LC_ALL": "tr_TR.UTF-8", "PYTHONHASHSEED": "7"}
    result = other.run("archive", OMP_NUM_THREADS="3", **settings)
    assert result.returncode == 0, result.stdout
    digest = hashlib.sha256(packed.read_bytes()).hexdigest()
    assert result.stdout.split()[:2] == [digest, FILE]
    assert (other.path / FILE).read_bytes() == packed.read_bytes()


def test_a_tree_verifies_with_its_archive(moved, packed, capsys):
    status, rows, lines = compared(moved, packed, capsys)
    assert status == 0 and set(rows.values()) == {"identical"}
    assert len(rows) >= 30 and lines[-1] == f"{len(rows) + 1} identical"  # and config.yaml


def test_each_difference_is_named(moved, packed, capsys):
    data = moved.path / "results" / "paper" / "motion_fig3.nc"
    shutil.copy(moved.path / "results" / "paper" / "motion_fig4.nc", data)
    figure = moved.path / "paper_figures" / "fig3.png"
    figure.write_bytes((moved.path / "paper_figures" / "fig4.png").read_bytes())
    (moved.path / "paper_figures" / "fig7.svg").unlink()
    (moved.path / "LICENSE").write_text("ours")
    status, rows, lines = compared(moved, packed, capsys)
    assert status == 1
    assert (
        rows.pop("results/paper/motion_fig3.nc") == rows.pop("paper_figures/fig3.png") == "differs"
    )
    assert rows.pop("paper_figures/fig7.svg") == "missing here"
    assert set(rows.values()) == {"identical"}
    text = "\n".join(lines)
    assert "  data: results/paper/motion_fig3.nc: variable " in text
    assert "  drawing: paper_figures/fig3.png: " in text
    assert lines[-1].endswith("2 differs, 1 missing here, 1 not in the archive")


@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (
            lambda p: (p / "results/paper/motion_fig3.nc").unlink(),
            "results/paper/motion_fig3.nc is missing: run ./reproduce",
        ),
        (
            lambda p: (p / "results/paper/motion_fig3.nc").write_bytes(b"x"),
            "results/paper/motion_fig3.nc: changed after it was made: run ./reproduce",
        ),
        (
            lambda p: (p / "paper_figures/fig3.png").write_bytes(b"x"),
            "paper_figures/fig3.png is not the one that was drawn: run ./reproduce",
        ),
        (
            lambda p: (p / "paper_figures/SHA256SUMS").write_text(f"{'0' * 64}  fig3.png\n"),
            "paper_figures/fig2.png is not as in paper_figures/SHA256SUMS: run ./reproduce accept",
        ),
        (
            lambda p: (p / "paper_figures/MANIFEST.json").write_text("{}"),
            "was edited: its content does not fit its own checksum: run ./reproduce accept",
        ),
    ],
)
def test_nothing_stale_or_missing_is_archived(moved, tmp_path, spoil, words):
    spoil(moved.path)
    with pytest.raises(archive.ArchiveError) as raised:
        written(moved, tmp_path / "new" / "a.tar")
    assert str(raised.value).endswith(words)
    assert not list((tmp_path / "new").glob("*")) or not (tmp_path / "new").exists()


def test_another_file_of_the_users_stays(accepted, packed, tmp_path):
    mine = tmp_path / "notes.tar"
    mine.write_text("mine")
    with pytest.raises(archive.ArchiveError, match="no archive, or damaged"):
        written(accepted, mine)
    assert mine.read_text() == "mine"
    with pytest.raises(archive.ArchiveError, match="is a folder"):
        written(accepted, tmp_path)
    shutil.copy(packed, tmp_path / "old.tar")
    assert (
        written(accepted, tmp_path / "old.tar") == hashlib.sha256(packed.read_bytes()).hexdigest()
    )


def foreign(path, names):
    with tarfile.open(path, "w") as tar:
        for name in names:
            tar.addfile(tarfile.TarInfo(name))


def test_damaged_and_foreign_archives_are_one_line(accepted, packed, tmp_path):
    good = packed.read_bytes()
    found = tmp_path / "found.tar"
    place = good.index(b"\x89HDF")
    for content in (b"", b"text", good[: len(good) // 2], good[:-12000]):
        found.write_bytes(content)
        with pytest.raises(archive.ArchiveError, match=r"found.tar: (no archive|not made by)"):
            archive.read(found)
    found.write_bytes(good[: place + 9000] + b"!" + good[place + 9001 :])
    with pytest.raises(
        archive.ArchiveError, match=r"found.tar: damaged: results/paper/\S+ does not"
    ):
        archive.read(found)
    for names in (["a"], ["pseudorigid/../a"], ["/pseudorigid/a"], ["pseudorigid/a"], []):
        foreign(found, names)
        with pytest.raises(archive.ArchiveError, match=r"found.tar: not made by"):
            archive.read(found)
    result = accepted.run("verify", "--against", str(found))
    assert result.returncode == 1 and len(result.stdout.splitlines()) == 1
    result = accepted.run("verify", "--against", str(tmp_path / "none.tar"))
    assert result.stdout == f"reproduce: verify: no archive or folder {tmp_path}/none.tar\n"
    (tmp_path / "empty").mkdir()
    result = accepted.run("verify", "--against", str(tmp_path / "empty"))
    said = (
        f"reproduce: verify: {tmp_path}/empty is no tree of this project, and no archive of it "
        "that was unpacked: paper_figures/MANIFEST.json: missing\n"
    )
    assert (result.returncode, result.stdout) == (1, said)
    result = accepted.run("verify", "--against", "")
    assert (result.returncode, result.stdout) == (2, "reproduce: verify: no archive or folder ''\n")
