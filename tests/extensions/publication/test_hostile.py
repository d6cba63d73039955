"""Archives, records and manifests that somebody else wrote are refused or harmless."""

import gzip
import hashlib
import io
import json
import os
import re
import shutil
import subprocess
import tarfile
from contextlib import redirect_stdout, suppress
from pathlib import Path

import netCDF4
import pytest
from archives import DATA, against, forge
from hypothesis import given, settings
from hypothesis import strategies as st
from project import Tree
from random_documents import FUZZ, JSON, PATHS, edited, spoilt
from slowly import slowly
from verdicts import accepting, verified

from extensions.publication import archive
from pipeline import config
from pipeline.checks import manifest
from pipeline.checks.freshness import Freshness
from pipeline.checks.verify import verify
from pipeline.cli.arguments import Arguments
from pipeline.cli.commands import clean
from pipeline.config.build_specs import build_specs
from pipeline.records.files import FileError
from pipeline.records.record import log_path, record_path, refusal_path

DRAWING = "results/paper/figures/fig3.png"
FIG3 = "paper_figures/fig3.png"


# ---- archives ----


def entry(name, data=b"x", kind=tarfile.REGTYPE, form=tarfile.USTAR_FORMAT, size=None):
    """Return the bytes of one entry of a tar."""
    about = tarfile.TarInfo(name)
    about.type, about.linkname = kind, "/etc/passwd" if kind in b"12" else ""
    about.size = len(data) if size is None else size
    return about.tobuf(form) + data + bytes(-len(data) % 512)


def whole(*entries):
    """Return a tar of entries with a correct end."""
    data = b"".join(entries) + bytes(1024)
    return data + bytes(-len(data) % tarfile.RECORDSIZE)


def with_sums(*names):
    """Return a tar with files of these names and correct checksums."""
    digest = hashlib.sha256(b"x").hexdigest()
    sums = "".join(f"{digest}  {name}\n" for name in names).encode()
    files = [entry(f"pseudorigid/{name}") for name in names]
    return whole(*files, entry("pseudorigid/SHA256SUMS", sums))


HOSTILE = {
    "absolute": with_sums("//tmp/absolute.txt"),
    "above": with_sums("../above.txt"),
    "dots": with_sums("a/../../above.txt"),
    "control characters": with_sums("a\x1b[2J\nb"),
    "a long name": whole(entry(f"pseudorigid/{'n' * 300}", form=tarfile.GNU_FORMAT)),
    "a name of pax": whole(entry("pseudorigid/ä" + "n" * 300, form=tarfile.PAX_FORMAT)),
    "huge": whole(entry("pseudorigid/x", size=10**12, form=tarfile.GNU_FORMAT)),
    "large": whole(entry("pseudorigid/x", size=8 * 10**9)),
    "negative": whole(entry("pseudorigid/x", size=-512, form=tarfile.GNU_FORMAT)),
    "a huge header": entry("x", size=10**12, kind=tarfile.XHDTYPE, form=tarfile.GNU_FORMAT),
    "many": b"".join(entry(f"pseudorigid/{i}", b"") for i in range(10_050)),
    "compressed": gzip.compress(whole(entry("pseudorigid/x"))),
    "no text": whole(entry("pseudorigid/x").replace(b"pseudorigid/x", b"pseudorigid/\xff")),
    "zeros": bytes(10240),
    "another folder": whole(entry("a")),
    "no sums": whole(entry("pseudorigid/a")),
    **{
        f"of type {kind}": whole(entry("pseudorigid/x", b"", kind))
        for kind in (b"\0", b"1", b"2", b"3", b"4", b"5", b"6", b"7", b"S", b"L", b"x")
    },
}


@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_archive_is_one_line(accepted, tmp_path, name):
    path = tmp_path / "h.tar"
    path.write_bytes(HOSTILE[name])
    with pytest.raises(archive.ArchiveError, match=r"^\S+h.tar: [^\n\x1b]{10,200}$"):
        against(accepted, path)


# ---- folders ----


def test_the_files_of_a_folder_are_compared(accepted, packed, tmp_path):
    other = accepted.copy(tmp_path / "other")
    assert against(accepted, other.path)[0] == 0
    subprocess.run(["tar", "-xf", packed, "-C", tmp_path], check=True)
    status, rows, lines = against(accepted, tmp_path / "pseudorigid")
    assert (status, lines[-1]) == (0, f"{len(rows)} identical")
    for file in (DATA, FIG3):
        (other.path / file).write_text("garbage")
    with netCDF4.Dataset(other.path / "results/paper/motion_fig4.nc", "a") as dataset:
        dataset["strain"][3] = 0.5
    (other.path / "paper_figures" / "fig7.svg").unlink()
    status, rows, lines = against(accepted, other.path)
    assert status == 1
    assert rows[FIG3] == rows[DATA] == rows["results/paper/motion_fig4.nc"] == "differs"
    assert rows["paper_figures/fig7.svg"] == "not in the folder"
    text = "\n".join(lines)
    assert f"drawing: the other {FIG3}: damaged, or not a picture" in text
    assert f"data: the other {DATA}: damaged, or not netCDF" in text
    assert re.search(r"strain differs from block 0 on .*; numbers differ by at most 0\.\d+", text)


def test_a_folder_that_is_no_tree_is_one_line(accepted, tmp_path):
    folder = tmp_path / "garbage"
    shutil.copytree(accepted.path / "paper_figures", folder / "paper_figures")
    (folder / "x.nc").write_text("garbage")
    for content in ("garbage", "{}", None):
        path = folder / "paper_figures" / "MANIFEST.json"
        path.unlink()
        if content:
            path.write_text(content)
        else:
            os.mkfifo(path)
        with pytest.raises(
            archive.ArchiveError, match=r"garbage is no tree of this project, [^\n]+$"
        ):
            against(accepted, folder)


# ---- results that were changed together with their records ----


@pytest.mark.parametrize(
    ("path", "like", "wrong", "words"),
    [
        (
            DATA,
            None,
            {"fig3.png", "fig3.svg"},
            f"data: {DATA}: variable strain differs from block 0",
        ),
        (DRAWING, "paper_figures/fig4.png", {"fig3.png"}, f"drawing: {DRAWING}: "),
    ],
)
def test_a_result_with_a_fitting_record_differs_in_its_layer(moved, path, like, wrong, words):
    forge(moved, path, like and (moved.path / like).read_bytes())
    specs = build_specs(config.load(moved.config), ["paper"])
    assert path not in Freshness(moved.path, specs).outdated()
    found = verified(moved)
    assert (found.status, set(found.wrong)) == (1, wrong)
    assert all(lines[0].startswith(words) for lines in found.wrong.values())


@pytest.mark.slow
def test_another_source_explains_other_data(moved):
    """New data can be accepted if the code that makes them changed."""
    half = "found = _MOTION(*a, **b); found['strain'] *= 0.5; return found"
    edit = f"_MOTION = scene_motion\n\n\ndef scene_motion(*a, **b):\n    {half}\n"
    moved.append("pseudorigid/dynamics/motion.py", edit)
    moved.warm()
    assert moved.run().returncode == 0
    assert "fig3.png" in verified(moved).wrong
    status, lines = accepting(moved)
    assert status == 0 and any(line.startswith("fig3.png  data: ") for line in lines)
    assert verified(moved).status == 0


# ---- special files ----

OTHERS = {
    "a FIFO": os.mkfifo,
    "a folder": os.mkdir,
    "a device": lambda p: os.symlink("/dev/zero", p),
}


READ = [FIG3, DATA, DRAWING, record_path(DATA), "paper_figures/MANIFEST.json"]


@pytest.mark.parametrize(
    ("file", "what"),
    [
        (DATA, "a FIFO"),
        *slowly(*((f, "a FIFO") for f in READ if f != DATA)),
        (FIG3, "a folder"),
        *slowly((DATA, "a device")),
    ],
)
def test_a_special_file_hangs_nothing(moved, tmp_path, file, what):
    (moved.path / file).unlink()
    OTHERS[what](moved.path / file)
    said = f"{file}: {what} stands in its place, move it away"
    if file == record_path(DATA):
        said = f"{DATA}: its record {file} cannot be read: run ./reproduce"
    found = verified(moved)
    assert found.status == 1 and any(said in line for line in found.lines)
    if file != "paper_figures/MANIFEST.json":
        status, (line,) = accepting(moved)
        assert status == 1 and line.startswith(f"reproduce accept: {said}")
    with pytest.raises(archive.ArchiveError, match=f"^{said}"):
        archive.write(moved.path, config.load(moved.config), tmp_path / "a.tar")


@pytest.mark.slow
def test_a_run_goes_on_beside_special_files(moved):
    """The table names them, and the other figures are published."""
    for name, make in (("fig3.png", os.mkdir), ("fig4.png", os.mkfifo), ("fig7.png", os.unlink)):
        (moved.path / "paper_figures" / name).unlink()
        if make is not os.unlink:
            make(moved.path / "paper_figures" / name)
    result = moved.run()
    assert result.returncode == 1
    rows = dict(line.split(maxsplit=2)[1:] for line in result.stdout.splitlines() if ".png" in line)
    for file, kind in ((FIG3, "folder"), ("paper_figures/fig4.png", "FIFO")):
        words = f"not published: a {kind} stands in its place, move it away"
        assert f"{file}: {words}" in result.stdout.splitlines()
    assert "identical" in rows["paper_figures/fig7.png"]
    (moved.path / DRAWING).unlink()
    os.mkfifo(moved.path / DRAWING)
    result = moved.run()
    line = f"reproduce: {DRAWING}: a FIFO stands in its place, move it away\n"
    assert (result.returncode, result.stdout) == (1, line)


@pytest.mark.slow
def test_a_folder_in_place_of_a_figure_that_cannot_exist_is_left(moved):
    moved.edit("fig3", type="inverse hyperbolic")
    assert moved.run("fig3").returncode == 1
    (moved.path / DRAWING / "mine").mkdir(parents=True)
    result = moved.run("fig3")
    assert result.returncode == 1 and "fig3.svg: cannot exist: " in result.stdout
    assert (moved.path / DRAWING / "mine").is_dir()


@pytest.mark.parametrize(
    ("file", "what"),
    [(record_path(DATA), "a FIFO"), (log_path(DATA), "a folder"), ("config.yaml", "a FIFO")],
)
def test_a_special_file_beside_a_result_or_as_config_is_one_line(moved, file, what):
    for path in (DATA, file):
        (moved.path / path).unlink(missing_ok=True)
    (moved.path / file).parent.mkdir(exist_ok=True)
    OTHERS[what](moved.path / file)
    result = moved.run("fig3")
    said = f"{file}: {what} stands in its place, move it away\n"
    assert result.returncode == 1 and result.stdout.removeprefix("reproduce: ") == said


def test_a_folder_whose_name_is_no_text_is_one_line(moved):
    folder = os.fsdecode(os.fsencode(moved.path.parent) + b"/\xff")
    moved.path.rename(folder)
    result = Tree(Path(folder)).run("list")
    said = f"reproduce: {folder!a}: this folder's name is not UTF-8: rename it\n"
    assert (result.returncode, result.stdout) == (1, said)


def test_an_archive_cannot_be_written_where_there_are_no_files(accepted, tmp_path):
    with pytest.raises(FileError, match=r"^/proc/x.tar: cannot be written: No such file [^\n]+$"):
        archive.write(accepted.path, config.load(accepted.config), "/proc/x.tar")
    with pytest.raises(FileError, match=r"File name too long$"):
        archive.write(accepted.path, config.load(accepted.config), tmp_path / ("n" * 300))
    os.mkfifo(tmp_path / "fifo")
    with pytest.raises(archive.ArchiveError, match="it is no regular file"):
        archive.write(accepted.path, config.load(accepted.config), tmp_path / "fifo")


# ---- random content ----


@pytest.fixture
def around(moved, monkeypatch):
    """List the files beside a copy of the project, of which `clean` takes the copy for its own."""
    monkeypatch.setattr(clean, "ROOT", moved.path)
    monkeypatch.setattr(clean, "RESULTS", moved.path / "results")
    (moved.path.parent / "victim.nc").write_text("mine")

    def listed():
        files = sorted(moved.path.parent.rglob("*"))
        return [(str(f), f.lstat().st_size) for f in files if not f.is_relative_to(moved.path)]

    return listed


def everything(tree, checked):
    """Run each command that reads records and manifests, and list what clean would delete."""
    for findings in verify(tree.path, checked):
        assert all(isinstance(line, str) for line in findings.report())
    with redirect_stdout(io.StringIO()):
        accepting(tree)
        with suppress(archive.ArchiveError, FileError):
            archive.write(tree.path, checked, tree.path / "a.tar")
    (tree.path / "a.tar").unlink(missing_ok=True)
    given = Arguments(folder=[], yes=True)
    given.config = checked
    for file in clean._generated_files(given, ["paper"]):
        assert file.resolve().is_relative_to(tree.path / "results" / "paper")


@pytest.mark.slow
def test_any_archive(packed, accepted, tmp_path):
    before, path = packed.read_bytes(), tmp_path / "a.tar"

    @settings(FUZZ, max_examples=200)
    @given(data=spoilt(before) | st.binary(max_size=2000))
    def trial(data):
        path.write_bytes(data)
        try:
            status, *_ = against(accepted, path)
        except archive.ArchiveError as error:
            assert re.fullmatch(r"[^\n]+", str(error))
        else:
            assert status == 0  # whatever stands between its files, the files are the same

    trial()
    assert [*tmp_path.iterdir()] == [path]


def fitting(document):
    """Give a manifest the checksum that fits: anybody can compute it."""
    if isinstance(document, dict):
        document.pop("checksum", None)
        with suppress(ValueError):
            document["checksum"] = manifest._checksum(document)
    return document


def of_json(text):
    """Return the texts of edited documents and of other ones."""
    return (edited(json.loads(text)) | JSON).map(json.dumps)


def of_manifest(text):
    documents = edited(json.loads(text)) | JSON
    return (documents | documents.map(fitting)).map(json.dumps)


def of_sums(text):
    digest = hashlib.sha256(b"mine").hexdigest()
    names = st.sampled_from([*PATHS[:4], "../../victim.nc", "a\x1bb"])
    return spoilt(text.encode()) | names.map(lambda name: f"{text}{digest}  {name}\n".encode())


@pytest.mark.slow
@pytest.mark.parametrize(
    ("place", "like", "contents"),
    [
        (record_path(DATA), record_path(DATA), of_json),
        (record_path(DRAWING), record_path(DRAWING), of_json),
        (refusal_path(DRAWING), record_path(DRAWING), of_json),  # which this tree has not
        ("paper_figures/MANIFEST.json", "paper_figures/MANIFEST.json", of_manifest),
        ("paper_figures/SHA256SUMS", "paper_figures/SHA256SUMS", of_sums),
    ],
)
def test_any_content(moved, around, place, like, contents):
    checked, outside, path = config.load(moved.config), around(), moved.path / place
    strategy = contents((moved.path / like).read_text())
    path.parent.mkdir(exist_ok=True)

    @FUZZ
    @given(content=strategy)
    def trial(content):
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        everything(moved, checked)
        assert around() == outside

    trial()
